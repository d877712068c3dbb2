"""The air of SkyExplorer: as an ``Atmosphere``, as a preset, or by turbidity or visibility."""

from __future__ import annotations

import traitlets

from sunwidget.atmosphere.constants import (
    MESOSPHERE_ALTITUDE,
    MESOSPHERE_SCALE_HEIGHT,
    RAYLEIGH_SCALE_HEIGHT,
    rayleigh_optical_depth,
)
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.presets import PRESETS
from sunwidget.explorer import table
from sunwidget.widgets.explorer.parameters import ExplorerParameters

ALIASES = ("turbidity", "visibility")


class ExplorerAir(ExplorerParameters):
    """A widget with the explorer's parameters whose air can be set as a whole."""

    _aliases: traitlets.Dict = traitlets.Dict(read_only=True).tag(sync=True)
    _presets: traitlets.Dict = traitlets.Dict(read_only=True).tag(sync=True)

    @traitlets.default("_aliases")
    def _default_aliases(self) -> dict[str, float]:
        # The constants to convert turbidity and visibility to aerosol optical depth and back
        # without the kernel, as ``Atmosphere`` does.
        standard = Atmosphere(aerosol_optical_depth=0)
        return {
            "air_optical_depth_550": float(rayleigh_optical_depth(550.0)),
            "air_extinction_550": standard.extinction_550,
            "koschmieder": standard.visibility * standard.extinction_550,
            "mesosphere_altitude": MESOSPHERE_ALTITUDE,
            "mesosphere_share": MESOSPHERE_SCALE_HEIGHT / RAYLEIGH_SCALE_HEIGHT,
        }

    @traitlets.default("_presets")
    def _default_presets(self) -> dict[str, dict[str, float]]:
        return {name: air.parameters() for name, air in PRESETS.items()}

    @property
    def atmosphere(self) -> Atmosphere:
        """The air as drawn, without parts that are switched off. Assign one to set the air."""
        values = self.values()["edit"]
        return Atmosphere(**{name: values[name] for name in table.AIR})

    @atmosphere.setter
    def atmosphere(self, value: Atmosphere) -> None:
        with self.hold_sync():
            for name, number in value.parameters().items():
                setattr(self, name, number)

    @property
    def turbidity(self) -> float:
        """Ratio of the optical depth with haze to that of air alone, at 550 nm; settable."""
        return self._air().turbidity

    @turbidity.setter
    def turbidity(self, value: float) -> None:
        self._set_haze("turbidity", value)

    @property
    def visibility(self) -> float:
        """Meteorological visibility at sea level in metres; settable."""
        return self._air().visibility

    @visibility.setter
    def visibility(self, value: float) -> None:
        self._set_haze("visibility", value)

    def preset(self, name: str) -> None:
        """Set the air to the preset ``name`` of ``atmosphere.presets.PRESETS``, in one step.

        Raises
        ------
        ValueError
            For an unknown name.
        """
        if name not in PRESETS:
            raise ValueError(f"There is no preset {name!r:.80}. Choose among {', '.join(PRESETS)}.")
        self.atmosphere = PRESETS[name]

    def _air(self) -> Atmosphere:
        """Return the air as set by the sliders, including parts that are switched off."""
        return Atmosphere(**{name: getattr(self, name) for name in table.AIR})

    def _set_haze(self, name: str, value: float) -> None:
        make = Atmosphere.with_turbidity if name == "turbidity" else Atmosphere.with_visibility
        row = table.parameter("aerosol_optical_depth")
        try:
            depth = make(self._air(), value).aerosol_optical_depth
            self.aerosol_optical_depth = table.checked(row, depth)
        except ValueError as error:
            raise traitlets.TraitError(f"{name} = {value!r:.80} cannot be set: {error}") from None
