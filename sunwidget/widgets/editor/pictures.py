"""Output of an editor: pictures, files, pages, and the picture for static viewers."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import Any

from sunwidget.analysis.scene import Scene
from sunwidget.edit.recipe import edit_of
from sunwidget.edit.table import Edit
from sunwidget.formats.png import encode_small_png
from sunwidget.progress import Progress
from sunwidget.widgets.editor.detail import detail
from sunwidget.widgets.editor.history import EditHistory
from sunwidget.widgets.editor.snapshot import SNAPSHOT_EDGE, Snapshot
from sunwidget.widgets.kernel.analysed import Analysed
from sunwidget.widgets.kernel.output import with_picture
from sunwidget.widgets.kernel.payload import THUMBNAIL_EDGE, encode_picture, thumbnail
from sunwidget.widgets.kernel.requests import Answer
from sunwidget.widgets.page.framed import StaticPage
from sunwidget.widgets.page.standalone import editor_page, write_page

_SUFFIXES = {"JPEG": ".jpg", "PNG": ".png", "TIFF": ".tif", "WEBP": ".webp"}
_TYPES = {
    ".jpg": "image/jpeg",
    ".png": "image/png",
    ".tif": "image/tiff",
    ".webp": "image/webp",
}


class Pictures(EditHistory, Analysed):
    """A widget that renders its edit of a photo."""

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of {self.photo.name!r}: {self.edit!r}>"

    def render(self, **options: Any) -> Any:
        """Return the current picture; ``options`` as in ``sunwidget.render``."""
        return self._render(self.edit, **options)

    def save(self, path: Any, **options: Any) -> Path:
        """Save the picture at full size to ``path``; ``options`` as in ``sunwidget.save``.

        Returns
        -------
        Path
            The saved file.
        """
        return self._save(self.edit, path, **options)

    def snapshot(self, long_edge: int = SNAPSHOT_EDGE) -> Snapshot:
        """Return the current picture as a cell's output, which later edits do not change.

        Waits for the analysis.

        Parameters
        ----------
        long_edge : int, default 1024
            Pixels of the longer side, at most the photo's.

        Raises
        ------
        ValueError
            For a ``long_edge`` that is not a positive integer.

        Examples
        --------
        >>> editor.snapshot()
        """
        if isinstance(long_edge, bool) or not isinstance(long_edge, int) or long_edge < 1:
            raise ValueError(f"long_edge must be a whole number above 0, not {long_edge!r:.40}.")
        edit = self.edit
        pixels = self.render(size=self.photo.size_within(long_edge))
        return Snapshot(pixels, edit, self.photo)

    def to_html(
        self,
        path: str | os.PathLike[str] | None = None,
        *,
        title: str | None = None,
        overwrite: bool = False,
    ) -> Path | str:
        """Write a page in which the sun can be moved: one file, no kernel, no network.

        Waits for the analysis. ``path``, ``title``, ``overwrite`` and errors as for
        ``sunwidget.to_html``; without a path the page is returned as text.
        """
        return write_page(lambda: self._page(self.edit, title), path, overwrite=overwrite)

    def render_static(self, *, title: str | None = None) -> StaticPage:
        """Return the page of ``to_html`` as a cell's output; its sun moves without a kernel.

        For exported notebooks: it stays live in ``nbconvert --to html``, without a network. Waits
        for the analysis. The notebook grows by the page, 2 to 8 MB.

        Parameters
        ----------
        title : str, optional
            Title of the page. Default: the photo's name.

        Examples
        --------
        >>> editor.render_static()
        """
        name = self.photo.name if title is None else title
        return StaticPage(self._page(self.edit, title), name)

    def _render(self, edit: Edit, **options: Any) -> Any:
        from sunwidget.renderer.offscreen import render

        return render(self._base_scene(), edit, **options)

    def _save(self, edit: Edit, path: Any, **options: Any) -> Path:
        from sunwidget.export.stills import save

        return save((self._base_scene(), edit), path, **options)

    def _page(self, edit: Edit, title: str | None = None) -> str:
        kept = self.whole_state(("_versions", "key_frames"))
        session = self._source["session"]
        return editor_page(self._base_scene(), edit, session=session, kept=kept, title=title)

    def _base_scene(self) -> Scene:
        # The renderer applies the edit's corrections to the scene without them.
        analyst = self._analyst  # may be replaced by another photo's while this one works
        analyst.wait()
        base = analyst.base
        assert base is not None
        return base

    def _requested_edit(self, content: dict[str, Any]) -> Edit:
        """Return the edit of a browser's request.

        The request contains it: while the kernel is busy, hosts delay traits but not requests, so
        that the kernel's traits may be older than the displayed picture.
        """
        if content.get("photo") not in {None, self._source["fingerprint"]}:
            raise ValueError("Another photo has been opened since this request.")
        recipe = content.get("recipe")
        return self.edit if recipe is None else edit_of(recipe)

    def _save_for_browser(self, content: dict[str, Any], progress: Progress) -> Answer:
        edit = self._requested_edit(content)
        progress(0.02, "Rendering at full size …")
        suffix = _SUFFIXES.get(self.photo.format or "", ".png")
        name = f"{Path(self.photo.name).stem}-sun{suffix}"
        with tempfile.TemporaryDirectory() as folder:
            path = self._save(edit, Path(folder) / f"picture{suffix}", progress=progress)
            progress(1.0, "Sending the picture …")
            data = path.read_bytes()
        return {"name": name, "type": _TYPES[suffix]}, [data]

    def _detail_for_browser(self, content: dict[str, Any], progress: Progress) -> Answer:
        edit = self._requested_edit(content)
        box, pixels = detail(
            self._base_scene(), edit, content.get("box"), content.get("size"), progress
        )
        return {"box": box}, [encode_picture(pixels)]

    def _page_for_browser(self, content: dict[str, Any], progress: Progress) -> Answer:
        edit = self._requested_edit(content)
        progress(0.05, "Writing the page …")
        data = self._page(edit).encode("utf-8")
        progress(1.0, "Sending the page …")
        return {"name": f"{Path(self.photo.name).stem}-sun.html", "type": "text/html"}, [data]

    def _thumbnail(self) -> bytes:
        """Return a small PNG: the edit if the scene is ready, otherwise the photo."""
        from sunwidget.errors import RendererError

        # The first frame of a session takes a second, which an unedited photo does not need.
        if self.edit != Edit() and self._can_show_edits():
            try:
                return encode_small_png(self.render(size=self.photo.size_within(THUMBNAIL_EDGE)))
            except RendererError:
                pass
        return thumbnail(self.photo)

    def _repr_mimebundle_(self, **kwargs: Any) -> Any:
        return with_picture(super()._repr_mimebundle_(**kwargs), self._thumbnail)
