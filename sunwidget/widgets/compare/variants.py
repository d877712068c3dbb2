"""What Compare shows side by side: edits, or names of methods and presets, by label."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from sunwidget import presets
from sunwidget.analysis.scene import Scene
from sunwidget.edit.table import CORRECTIONS, METHODS, Edit
from sunwidget.errors import EditError

PHOTO = "photo"
MOST = 9

Sun = tuple[float | None, float | None]


class Variant(NamedTuple):
    """One panel of a comparison.

    Parameters
    ----------
    label : str
    what : Edit or str
        An edit; or "photo", or the name of a method or a preset.
    base : Edit
        What ``what`` is laid over.
    """

    label: str
    what: Edit | str
    base: Edit

    @property
    def is_photo(self) -> bool:
        """Whether it is the photo as it was, which no sun moves."""
        return self.what == PHOTO

    @property
    def sun(self) -> Sun | None:
        """Azimuth and elevation that it asks for; None where that depends on the photo."""
        if isinstance(self.what, str) and self.what in presets.NAMES:
            return None
        edit = self.base if isinstance(self.what, str) else _over(self.base, self.what)
        return edit.sun_azimuth, edit.sun_elevation

    def edit(self, scene: Scene) -> Edit:
        """Return its edit of this photo."""
        if isinstance(self.what, Edit):
            return _over(self.base, self.what)
        if self.is_photo:
            return Edit(**{name: getattr(self.base, name) for name in CORRECTIONS})
        if self.what in METHODS:
            return self.base.replace(method=self.what)
        return presets.edit(self.what, scene, self.base)


def variants(given: Any, base: Edit) -> tuple[Variant, ...]:
    """Return the panels of a comparison.

    Parameters
    ----------
    given : mapping or iterable
        ``{label: what}`` or a list of ``what``: an ``Edit``, a recipe, a method's or a preset's
        name, or "photo". In a list names are their own labels, and edits are numbered.
    base : Edit
        What each is laid over.

    Raises
    ------
    EditError
        For fewer than two or more than nine, an unknown name (the nearest is suggested), or a
        recipe that cannot be used.
    """
    if isinstance(given, Mapping):
        pairs = list(given.items())
    elif isinstance(given, Iterable) and not isinstance(given, (str, bytes)):
        pairs = [
            (what if isinstance(what, str) else f"Edit {i}", what)
            for i, what in enumerate(given, 1)
        ]
    else:
        raise EditError(
            "Compare takes a list or a mapping of what to show, such as "
            f'["ratio", "thesis"] or {{"warm": edit}}, not {type(given).__name__}.'
        )
    if not 2 <= len(pairs) <= MOST:
        raise EditError(f"Compare shows 2 to {MOST} pictures side by side, not {len(pairs)}.")
    found = tuple(Variant(str(label), _what(what), base) for label, what in pairs)
    labels = [variant.label for variant in found]
    if len(set(labels)) < len(labels):
        raise EditError("Two pictures have the same label. Give a mapping with a label for each.")
    return found


def common_sun(found: Iterable[Variant]) -> Sun | None:
    """Return the one sun that all panels ask for, the photo aside; None where they differ."""
    suns = {variant.sun for variant in found if not variant.is_photo}
    return suns.pop() if len(suns) == 1 else None


def corrections(edit: Edit) -> tuple[Any, ...]:
    """Return what the photo's maps follow: edits that agree in it share their maps."""
    return tuple(getattr(edit, name) for name in CORRECTIONS)


def _over(base: Edit, edit: Edit) -> Edit:
    return base.replace(**edit.changed())


def _what(what: Any) -> Edit | str:
    if isinstance(what, Edit):
        return what
    if not isinstance(what, str):
        return Edit.from_dict(what)
    names = (*METHODS, *presets.NAMES, PHOTO)
    if what in names:
        return what
    near = difflib.get_close_matches(what[:80].lower().replace(" ", "_"), names, n=1)
    hint = f"Did you mean {near[0]!r}?" if near else f"There are {', '.join(names)}."
    raise EditError(f"{what[:80]!r} is neither a method nor a preset. {hint}")
