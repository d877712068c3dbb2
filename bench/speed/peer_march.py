"""Our sky passes against marching every pixel: in NumPy, and as a fragment shader on our driver.

The peer (``march.glsl``, ``march.py``) takes 32 steps a ray and 8 from each towards the sun, spaced
as ours are, at the same four wavelengths. It needs no table and is simpler, but stops at the first
order of scattering; ours holds all of them, and the sun's disc and glare. Errors are those of
radiance, root mean square over the sky of the picture, each against a converged march of the orders
that it claims.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import sunwidget as sw
from sunwidget.analysis.fit.fit import view_angles
from sunwidget.atmosphere.multiple import SHADER, Quality
from sunwidget.atmosphere.optics import camera_height
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.sky import SkyTable
from sunwidget.renderer.gl_thread import on_gl_thread
from sunwidget.renderer.shader_source import EGL_HEADER, FULL_SCREEN_TRIANGLE, resolve_includes

from .effort import Effort
from .march import march
from .passes import Passes
from .pictures import analysed
from .rows import Row, Rows, of_times
from .thesis import look_up
from .timing import Times, clock, in_turn, ratio

KEYS = ("march as a shader", "march in NumPy")
ELEVATION = 8.0  # of the sun where radiances are compared, degrees
SAMPLES = 400  # directions in which they are


class Rays(NamedTuple):
    """Azimuth and elevation (H, W) in degrees, and the air and the sun's azimuth of a scene."""

    azimuth: np.ndarray
    elevation: np.ndarray
    air: Atmosphere
    sun_azimuth: float

    def cosines(self, sun_elevation: float) -> tuple[np.ndarray, np.ndarray]:
        """Return mu and nu (H, W)."""
        mu = np.sin(np.radians(self.elevation))
        s, turn = np.radians(sun_elevation), np.radians(self.azimuth - self.sun_azimuth)
        nu = mu * np.sin(s) + np.cos(np.radians(self.elevation)) * np.cos(s) * np.cos(turn)
        return mu, np.clip(nu, -1, 1)


def rows(effort: Effort) -> Rows:
    width, height = effort.frame
    scene = analysed(width, height)
    names = Atmosphere().parameters()
    air = Atmosphere(**{name: scene.automatic[name] for name in names})
    azimuth = scene.automatic["sun_azimuth"]
    rays = Rays(*view_angles(scene.camera, width, height), air, azimuth)
    graph, peer = Passes(scene, (width, height)), Shader(scene, rays)

    def sun(i: int) -> sw.Edit:
        return sw.Edit(sun_elevation=2 + 0.7 * i % 17, method="thesis")

    def haze(i: int) -> sw.Edit:
        return sw.Edit(sun_elevation=ELEVATION, aerosol_optical_depth=0.05 + 0.01 * i)

    ours, theirs = in_turn(
        lambda i: graph.draw(sun(i), "sky_edit"),
        lambda i: peer.draw(2 + 0.7 * i % 17),
        effort.runs,
        max(1, effort.runs // 4),
    )
    accuracy = describe_error(graph, peer, rays)
    yield beside(
        "march as a shader",
        f"sky {width}×{height} for a new sun, beside a march in a shader",
        ours,
        theirs,
        accuracy,
    )
    fresh, theirs = in_turn(
        lambda i: graph.draw(haze(i).replace(method="thesis"), "sky_edit"),
        lambda _i: peer.draw(ELEVATION),
        effort.runs,
        max(1, effort.runs // 4),
    )
    yield beside(
        "march as a shader, new air",
        f"sky {width}×{height} for new air, beside a march in a shader",
        fresh,
        theirs,
    )
    share, numpy_time = in_numpy(rays, effort)
    scaled = Times(*([t / share for t in times] for times in numpy_time))
    note = "" if share == 1 else f"NumPy on {share:.0%} of the pixels, scaled"
    yield beside(
        "march in NumPy", f"sky {width}×{height}, beside a march in NumPy", ours, scaled, note
    )


def beside(key: str, what: str, ours: Times, theirs: Times, note: str = "") -> Row:
    """Return the row of two processor times."""
    peer = 1000 * theirs.median
    return of_times(key, what, ours, "ms", peer=peer, ratio=ratio(ours, theirs), note=note)


def in_numpy(rays: Rays, effort: Effort) -> tuple[float, Times]:
    """March some rows of the picture, in parts as memory asks for; the share they are of it."""
    mu, nu = rays.cosines(ELEVATION)
    total = mu.size
    step = max(1, total // min(effort.march_pixels, total))
    mu, nu = mu.ravel()[::step], nu.ravel()[::step]
    times = Times([], [])
    with clock(times):
        for i in range(0, len(mu), 65536):
            part = slice(i, i + 65536)
            march(rays.air, mu[part], float(np.sin(np.radians(ELEVATION))), nu[part])
    return len(mu) / total, times


def describe_error(graph: Passes, peer: Shader, rays: Rays) -> str:
    """Say how far both are from the truth that they claim, and what one order leaves out."""
    shape = rays.elevation.shape
    random = np.random.default_rng(3)
    y, x = (random.integers(0, n, 8 * SAMPLES) for n in shape)
    sky = rays.elevation[y, x] > 0.5
    y, x = y[sky][:SAMPLES], x[sky][:SAMPLES]
    where = rays.elevation[y, x], rays.azimuth[y, x] - rays.sun_azimuth, ELEVATION
    fine = Quality(groups=60)
    single = SkyTable(rays.air, quality=fine, multiple_scattering=False).radiance(*where)
    every = SkyTable(rays.air, quality=SHADER).radiance(*where)
    drawn = peer.draw(ELEVATION, read=True)[y, x]
    view = graph.texels(sw.Edit(sun_elevation=ELEVATION, method="thesis"), "sky_view_edit")
    ours = look_up(view.astype(np.float64), rays.azimuth[y, x], rays.elevation[y, x])
    return (
        f"error {rms(ours / every):.1%}, march {rms(drawn / single):.1%} of the first order, "
        f"which is {np.mean(single / every):.0%} of the light"
    )


def rms(ratio: np.ndarray) -> float:
    return float(np.sqrt(np.mean((ratio - 1) ** 2)))


class Shader:
    """The peer's fragment shader and its target, of the picture's size."""

    def __init__(self, scene: Any, rays: Rays) -> None:
        self.rays = rays
        self.size = scene.camera.width, scene.camera.height
        text = EGL_HEADER + resolve_includes("atmosphere/atmosphere.glsl")
        text += Path(__file__).with_name("march.glsl").read_text("utf-8")
        camera = scene.camera
        values = {
            **rays.air.parameters(),
            "camera_right": camera.right,
            "camera_up": camera.up,
            "camera_forward": camera.forward,
            "camera_focal": camera.focal,
            "frame_size": self.size,
            "camera_height": camera_height(rays.air),
        }

        def make(context: Any) -> tuple[Any, Any, Any]:
            program = context.program(vertex_shader=FULL_SCREEN_TRIANGLE, fragment_shader=text)
            for name, value in values.items():
                if name in program:
                    program[name].value = value if np.isscalar(value) else tuple(value)
            texture = context.texture(self.size, 4, dtype="f4")
            return program, context.vertex_array(program, []), context.framebuffer([texture])

        self.program, self.array, self.target = on_gl_thread(make)

    def draw(self, sun_elevation: float, *, read: bool = False) -> Any:
        """March every pixel; its radiance (H, W, 4) where it is to be read."""
        e, a = np.radians(sun_elevation), np.radians(self.rays.sun_azimuth)
        sun = np.cos(e) * np.sin(a), np.sin(e), np.cos(e) * np.cos(a)

        def task(context: Any) -> Any:
            self.program["sun"].value = tuple(float(v) for v in sun)
            self.target.use()
            self.array.render(vertices=3)
            context.finish()
            if not read:
                return None
            data = np.frombuffer(self.target.read(components=4, dtype="f4"), np.float32)
            return data.reshape(self.size[1], self.size[0], 4)

        return on_gl_thread(task)
