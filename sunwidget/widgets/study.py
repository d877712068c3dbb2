"""Study: which of two pictures looks more realistic? For raters in a notebook or in a page."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import traitlets

from sunwidget.export.sheet import sheet
from sunwidget.formats.png import encode_small_png
from sunwidget.photo.photo import open_photo
from sunwidget.study import (
    Answer,
    BradleyTerry,
    StudyError,
    bradley_terry,
    by_rater,
    read_csv,
    write_csv,
)
from sunwidget.study.bradley_terry import PRIOR
from sunwidget.widgets.kernel.front_end import front_end
from sunwidget.widgets.kernel.output import with_picture
from sunwidget.widgets.kernel.payload import encode_jpeg, encode_preview
from sunwidget.widgets.page.framed import StaticPage
from sunwidget.widgets.page.saved_state import SavedLight
from sunwidget.widgets.page.standalone import widget_state, write_page

_MOST_REPEATS = 100
_SMALL_EDGE = 400  # pixels of each picture in the static one
_NOTES = ("Save your answers at the end: they stay in this window, and nothing leaves it.",)


class Study(SavedLight):
    """Show pictures in pairs and let people choose, as in the thesis' user study (section 6.3).

    Each rater sees every pair of methods of every photo, in an order and on sides randomized by
    seed and rater, and chooses by click or arrow key. The screen does not show which method made a
    picture. Answering needs no kernel.

    Parameters
    ----------
    pictures : mapping
        Picture by method, ``{"ratio": a, "thesis": b}``; or such a mapping for each of several
        photos, ``{"coast": {"ratio": a, "thesis": b}, "meadow": {...}}``. A picture is any source
        for ``sunwidget.open``; it is shown with a long edge of at most 2048 pixels.
    question : str
    rater : str, optional
        The rater's name; raters can also enter it themselves.
    repeats : int, default 1
        How often each rater sees a pair, with sides swapped each time.
    ties : bool, default False
        Whether "cannot decide" is an answer. It counts as half a win for each method.
    seed : int, default 0

    Raises
    ------
    StudyError
        For fewer than two pictures of a photo, or names that are not strings.
    PhotoError
        For a picture that cannot be opened.

    Examples
    --------
    >>> study = sw.Study({"coast": compare.render()}, rater="anna")
    >>> study.to_csv("anna.csv")
    >>> study.results()
    """

    _esm, _css = front_end("study", "Study")

    rater = traitlets.Unicode("", help="Who answers.").tag(sync=True)
    _pictures: traitlets.List = traitlets.List().tag(sync=True, echo_update=False)
    # The only picture that a saved notebook keeps.
    _thumbnail = traitlets.Bytes().tag(sync=True, echo_update=False)
    _groups: traitlets.List = traitlets.List().tag(sync=True)
    _answers: traitlets.List = traitlets.List().tag(sync=True)
    _question = traitlets.Unicode().tag(sync=True)
    _repeats = traitlets.Int(1).tag(sync=True)
    _ties = traitlets.Bool(False).tag(sync=True)
    _seed = traitlets.Int(0).tag(sync=True)

    def __init__(
        self,
        pictures: Mapping[str, Any],
        *,
        question: str = "Which picture looks more realistic?",
        rater: str = "",
        repeats: int = 1,
        ties: bool = False,
        seed: int = 0,
    ) -> None:
        if not 1 <= repeats <= _MOST_REPEATS:
            raise StudyError(f"repeats must be from 1 to {_MOST_REPEATS}, not {repeats!r:.80}.")
        groups, files = _read(pictures)
        super().__init__(
            _pictures=files,
            _groups=groups,
            _question=question,
            _repeats=repeats,
            _ties=ties,
            _seed=seed,
            rater=rater,
        )

    def __repr__(self) -> str:
        return f"<Study of {', '.join(self.methods)}: {len(self._answers)} answers>"

    @property
    def answers(self) -> list[Answer]:
        """All answers so far, of all raters, in order of arrival."""
        return [Answer.from_row(row) for row in self._answers]

    def to_csv(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> Path:
        """Write one row per answer; see ``sunwidget.study.Answer`` for the columns.

        Parameters
        ----------
        path : path
            The file to write.
        overwrite : bool
            Replace an existing file.

        Returns
        -------
        Path
            The written file.

        Raises
        ------
        FileExistsError
            When ``path`` exists and ``overwrite`` is false.
        """
        return write_csv(self.answers, path, overwrite=overwrite)

    def to_html(
        self,
        path: str | os.PathLike[str] | None = None,
        *,
        title: str = "Study",
        overwrite: bool = False,
    ) -> Path | str:
        """Write a page for raters elsewhere: one file, no kernel, no network.

        The page has no answers at first. Raters save theirs to a file at the end, and ``read_csv``
        pools the files.

        Parameters
        ----------
        path : path, optional
            The file to write. Default: return the page as text.
        title : str
            Title of the page.
        overwrite : bool
            Replace an existing file.

        Returns
        -------
        Path or str
            The written file, or the page.

        Raises
        ------
        FileExistsError
            When ``path`` exists and ``overwrite`` is false.
        """
        return write_page(lambda: self._page(title), path, overwrite=overwrite)

    def render_static(self, *, title: str = "Study") -> StaticPage:
        """Return the page of ``to_html`` as a cell's output, which people answer without a kernel.

        For exported notebooks. The page has no answers at first; raters save theirs to a file. The
        notebook grows by all pictures, at most 2048 pixels each.

        Parameters
        ----------
        title : str
            Title of the page.
        """
        return StaticPage(self._page(title), title)

    def _page(self, title: str) -> str:
        from sunwidget.widgets.page.html import Still, page

        embedded = widget_state(self)
        embedded["state"] |= {"_answers": [], "rater": "", "_thumbnail": None}
        embedded["buffers"] = [b for b in embedded["buffers"] if b["path"] != ["_thumbnail"]]
        first = self._pictures[0]
        still = Still(first, open_photo(first).size, self._question)
        return page(embedded, still, title=title, notes=_NOTES)

    def _light_state(self) -> dict[str, Any]:
        return {"_pictures": []}

    @traitlets.default("_thumbnail")
    def _default_thumbnail(self) -> bytes:
        return encode_jpeg(self._first_pair())

    def _first_pair(self) -> np.ndarray:
        """Return two pictures of the first photo, small, under the question."""
        pair = [open_photo(data).preview(_SMALL_EDGE) for data in self._pictures[:2]]
        height = min(len(picture) for picture in pair)
        width = min(picture.shape[1] for picture in pair)
        first, second = (picture[:height, :width] for picture in pair)
        return np.asarray(sheet({self._question: first, "": second}))

    def _repr_mimebundle_(self, **kwargs: Any) -> Any:
        bundle = super()._repr_mimebundle_(**kwargs)
        return with_picture(bundle, lambda: encode_small_png(self._first_pair()))

    @staticmethod
    def read_csv(*paths: str | os.PathLike[str]) -> list[Answer]:
        """Return the answers of the files at ``paths``; see ``sunwidget.study.read_csv``."""
        return read_csv(*paths)

    def results(self, *, prior: float = PRIOR) -> BradleyTerry:
        """Return the methods' strengths after Bradley and Terry, pooled over raters and photos.

        Parameters
        ----------
        prior : float
            Number of additional wins, and losses, assumed for every method.

        Returns
        -------
        BradleyTerry
            Prints as a table.

        Raises
        ------
        StudyError
            When there are no answers.

        See Also
        --------
        sunwidget.study.bradley_terry : the computation and the meaning of ``prior``.
        """
        return bradley_terry(self.answers, prior=prior, methods=self.methods)

    def results_by_rater(self, *, prior: float = PRIOR) -> dict[str, BradleyTerry]:
        """Return the strengths for each rater's answers alone; ``prior`` as for ``results``."""
        return by_rater(self.answers, prior=prior)

    @property
    def methods(self) -> tuple[str, ...]:
        """Names of the compared methods."""
        names = (method["name"] for group in self._groups for method in group["methods"])
        return tuple(dict.fromkeys(names))


def _read(pictures: Mapping[str, Any]) -> tuple[list[dict[str, Any]], list[bytes]]:
    """Return the photos' methods with the indices of their pictures, and the encoded pictures."""
    if not isinstance(pictures, Mapping):
        raise StudyError(
            f"pictures must be a mapping by method, not {type(pictures).__name__}: "
            'sw.Study({"ratio": a, "thesis": b}).'
        )
    nested = [isinstance(item, Mapping) for item in pictures.values()]
    if any(nested) and not all(nested):
        raise StudyError(
            "Either every entry must be a picture or every entry a mapping of pictures by method; "
            "these are mixed."
        )
    by_photo = pictures if any(nested) else {"": pictures}
    groups: list[dict[str, Any]] = []
    files: list[bytes] = []
    for photo, methods in by_photo.items():
        if len(methods) < 2:
            raise StudyError(
                f"A study compares pairs of pictures, but {photo or 'it'} has {len(methods)}. "
                "Pass at least two methods."
            )
        rows = []
        for name, picture in methods.items():
            if not isinstance(name, str) or not name or not isinstance(photo, str):
                raise StudyError(f"Names of photos and methods must be strings, not {name!r:.80}.")
            rows.append({"name": name, "picture": len(files)})
            files.append(encode_preview(open_photo(picture)))
        groups.append({"name": photo, "methods": rows})
    return groups, files
