"""The panels of Compare: edits, or names of methods and presets, by label."""

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
        An edit, "photo", or the name of a method or a preset.
    base : Edit
        The edit that ``what`` overrides.
    """

    label: str
    what: Edit | str
    base: Edit

    @property
    def is_photo(self) -> bool:
        """Whether it is the original photo, whose sun does not move."""
        return self.what == PHOTO

    @property
    def sun(self) -> Sun | None:
        """Azimuth and elevation of its edit; None if they depend on the photo."""
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


def variants(choices: Any, base: Edit) -> tuple[Variant, ...]:
    """Return the panels of a comparison.

    Parameters
    ----------
    choices : mapping or iterable
        ``{label: what}`` or a list of ``what``: an ``Edit``, a recipe, a method's or a preset's
        name, or "photo". In a list, names are their own labels and edits are numbered.
    base : Edit
        The edit that each overrides.

    Raises
    ------
    EditError
        For fewer than two or more than nine, an unknown name (with the nearest one), or an unusable
        recipe.
    """
    if isinstance(choices, Mapping):
        pairs = list(choices.items())
    elif isinstance(choices, Iterable) and not isinstance(choices, (str, bytes)):
        pairs = [
            (what if isinstance(what, str) else f"Edit {i}", what)
            for i, what in enumerate(choices, 1)
        ]
    else:
        raise EditError(
            "Compare takes a list or a mapping of edits and names, such as "
            f'["ratio", "thesis"] or {{"warm": edit}}, not {type(choices).__name__}.'
        )
    if not 2 <= len(pairs) <= MOST:
        raise EditError(f"Compare shows 2 to {MOST} pictures side by side, not {len(pairs)}.")
    found = tuple(Variant(str(label), _what(what), base) for label, what in pairs)
    labels = [variant.label for variant in found]
    if len(set(labels)) < len(labels):
        raise EditError("Two pictures have the same label. Pass a mapping with distinct labels.")
    return found


def common_sun(found: Iterable[Variant]) -> Sun | None:
    """Return the sun of all panels except the photo; None if they differ."""
    suns = {variant.sun for variant in found if not variant.is_photo}
    return suns.pop() if len(suns) == 1 else None


def corrections(edit: Edit) -> tuple[Any, ...]:
    """Return the parameters that the photo's maps depend on: equal edits share their maps."""
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
    hint = f"Did you mean {near[0]!r}?" if near else f"Choose one of {', '.join(names)}."
    raise EditError(f"{what[:80]!r} is neither a method nor a preset. {hint}")
