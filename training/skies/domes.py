"""Skies that are known all the way round: Blender's physical sky and clouds made by seed.

Needs ``bpy`` (``pip install bpy``). A dome is as ``sw.to_dome`` writes it: the middle column is
azimuth 0, the zenith on top. Blender's sky, with scattering of all orders, is not this package's;
the clouds are a layer in a plane 1.5 km up, lit by that sun and sky.

    python -m training.skies.domes FOLDER 0 16
    python -m training.skies.domes FOLDER 0 32 moved

``bench/dome.py`` judges by the first, ``bench/dome_moved.py`` by the second.
"""

from __future__ import annotations

import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from sunwidget.dome.sphere import angles, irradiance, solid_angles
from sunwidget.formats import openexr
from sunwidget.formats.color import LUMINANCE
from sunwidget.geometry.camera import Camera

WIDTH = 1024
_HEIGHT = 1.5  # km


@dataclass
class TrueSky:
    """A dome (H, W, 3) without its disc, and what is known of it; the unit is Blender's.

    ``direct`` is the irradiance (3,) by the sun at right angles, behind its clouds.
    """

    seed: int
    light: np.ndarray
    direct: np.ndarray
    direction: tuple[float, float]
    cover: float
    albedo: np.ndarray
    camera: Camera


@dataclass(frozen=True)
class Weather:
    """Air, clouds and ground, to be seen under any sun; ``seed`` is the clouds'."""

    aerosol: float
    cover: float
    albedo: np.ndarray
    seed: int

    def under(self, sun: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
        """Return the dome (H, W, 3) without its disc, and the irradiance (3,) by its veiled sun."""
        light = _blender(sun[1], self.aerosol, disc=False)
        both = _blender(sun[1], self.aerosol, disc=True)
        where, up = angles(WIDTH)
        above = up > 0
        disc = np.maximum(both - light, 0) * above[..., None]
        peak = np.unravel_index(np.argmax(disc @ LUMINANCE), above.shape)
        direct = (disc * solid_angles(WIDTH)[..., None]).sum((0, 1))
        light = np.roll(light, round((sun[0] - where[peak]) / 360 * WIDTH), axis=1)
        light, shade = _clouded(light, direct, sun, self.cover, self.seed)
        lit = _upper(light) + np.sin(np.radians(sun[1])) * direct * shade
        light[~above] = self.albedo * lit / np.pi
        return light, direct * shade


def true_sky(seed: int) -> TrueSky:
    """Return the sky of a seed: sun 4° to 60° high, no to many clouds, clear to hazy air."""
    chance = np.random.default_rng(seed)
    elevation = float(np.exp(chance.uniform(np.log(4), np.log(60))))
    # Half of the suns stand in the picture or near it.
    azimuth = float(chance.uniform(-25, 25) if chance.random() < 0.5 else chance.uniform(-180, 180))
    aerosol, cover = float(chance.uniform(0.3, 2.5)), float(chance.choice([0, 0.2, 0.35, 0.5, 0.7]))
    albedo = np.array([0.2, 0.19, 0.12]) * chance.uniform(0.5, 1.3)
    fov, pitch = float(chance.uniform(36, 55)), float(chance.uniform(4, 13))
    sun = (azimuth, elevation)
    light, direct = Weather(aerosol, cover, albedo, seed).under(sun)
    return TrueSky(seed, light, direct, sun, cover, albedo, Camera(768, 512, fov, pitch))


@dataclass
class MovedSky:
    """One weather under two suns, with land up to 6° above the horizon.

    ``light`` (2, H, W, 3) is without discs, ``direct`` (2, 3) the irradiance by the veiled suns,
    ``directions`` (2, 2) their azimuth and elevation in degrees, ``sky`` (H, W) what is no land.
    """

    light: np.ndarray
    direct: np.ndarray
    directions: np.ndarray
    sky: np.ndarray


def moved_sky(seed: int) -> MovedSky:
    """Return the weather of a seed under two suns, each 3° to 60° high."""
    chance = np.random.default_rng(20_000 + seed)
    aerosol, cover = float(chance.uniform(0.3, 2.5)), float(chance.choice([0, 0.2, 0.35, 0.5, 0.7]))
    albedo = np.array([0.2, 0.19, 0.12]) * chance.uniform(0.5, 1.3)
    suns = [
        (float(chance.uniform(-180, 180)), float(np.exp(chance.uniform(np.log(3), np.log(60)))))
        for _ in range(2)
    ]
    where, up = angles(WIDTH)
    skyline = 1 + 5 * _noise(chance, (where / 15) % 24, 0 * where)
    grain = 0.5 + _noise(chance, (where / 6) % 60, np.sign(up) * np.sqrt(np.abs(up) + 0.1) * 6)
    low, standing = up < 0, (up >= 0) & (up < skyline)
    lights, directs = [], []
    for sun in suns:
        light, direct = Weather(aerosol, cover, albedo, seed).under(sun)
        light[low] *= grain[low, None]
        walls = albedo * _on_walls(light, direct, sun) / np.pi
        light[standing] = (walls[None] * grain[..., None])[standing]
        behind = skyline[0, round((sun[0] / 360 + 0.5) * WIDTH) % WIDTH] > sun[1]
        lights.append(light)
        directs.append(direct * (not behind))
    return MovedSky(np.array(lights), np.array(directs), np.array(suns), ~(low | standing))


def _on_walls(light: np.ndarray, direct: np.ndarray, sun: tuple[float, float]) -> np.ndarray:
    """Return the irradiance (W, 3) of walls that face the middle, by their azimuth."""
    where = np.radians(np.arange(-180, 181, 15.0))
    level = np.cos(np.radians(sun[1]))
    found = []
    for azimuth in where:
        normal = (-np.cos(azimuth), np.sin(azimuth), 0.0)
        facing = max(-level * np.cos(np.radians(sun[0]) - azimuth), 0)
        found.append(irradiance(light, normal) + facing * direct)
    columns = np.radians(angles(WIDTH)[0][0])
    walls = np.array(found)
    return np.stack([np.interp(columns, where, walls[:, i]) for i in range(3)], axis=-1)


def photo(sky: TrueSky) -> np.ndarray:
    """Return what a camera makes of it, (H, W, 3) uint8: exposed, bent, grainy, with the disc."""
    import cv2

    camera, chance = sky.camera, np.random.default_rng(1000 + sky.seed)
    rows, columns = np.mgrid[: camera.height, : camera.width] + 0.5
    azimuth, elevation = camera.angles(columns, rows)
    x = ((azimuth / 360 + 0.5) * WIDTH - 0.5).astype(np.float32)
    y = ((0.5 - elevation / 180) * WIDTH / 2 - 0.5).astype(np.float32)
    light = cv2.remap(
        sky.light.astype(np.float32), x, y, cv2.INTER_CUBIC, borderMode=cv2.BORDER_WRAP
    )
    skyline = 1.5 + 2.5 * _noise(chance, azimuth / 12, 0 * azimuth)
    land = elevation < skyline
    ground = sky.light[-1, 0] * (0.6 + 0.8 * _noise(chance, columns / 20, rows / 8))[..., None]
    light[land] = ground[land]
    apart = np.degrees(np.arccos(np.clip(_cosine(sky.direction, azimuth, elevation), -1, 1)))
    sun = np.pi * np.radians(0.2666) ** 2
    light += ((apart < 0.2666) & ~land)[..., None] * sky.direct / sun
    light += (1 - land)[..., None] * sky.direct * 0.02 / (1 + (apart[..., None] / 1.0) ** 2) ** 1.5
    light *= 0.35 / np.median(light[~land] @ LUMINANCE)
    display = (1 - np.exp(-0.9 * np.maximum(light, 0))) / 0.9
    display = np.clip(display + chance.normal(0, 0.002, display.shape), 0, 1)
    code = np.where(display < 0.0031308, 12.92 * display, 1.055 * display ** (1 / 2.4) - 0.055)
    return np.rint(255 * code).astype(np.uint8)


def _blender(elevation: float, aerosol: float, *, disc: bool) -> np.ndarray:
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 32 if disc else 4
    scene.cycles.use_denoising = False
    world = bpy.data.worlds.new("sky")
    scene.world = world
    world.use_nodes = True
    node = world.node_tree.nodes.new("ShaderNodeTexSky")
    node.sky_type = "MULTIPLE_SCATTERING"
    node.sun_disc, node.sun_elevation = disc, np.radians(elevation)
    node.sun_size = np.radians(0.545)
    node.aerosol_density = aerosol
    world.node_tree.links.new(
        node.outputs["Color"], world.node_tree.nodes["Background"].inputs["Color"]
    )
    lens = bpy.data.cameras.new("round")
    lens.type = "PANO"
    lens.panorama_type = "EQUIRECTANGULAR"
    camera = bpy.data.objects.new("round", lens)
    camera.rotation_euler = (np.pi / 2, 0, 0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, WIDTH // 2
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = str(Path(folder, "sky.exr"))
        bpy.ops.render.render(write_still=True)
        return openexr.read(Path(folder, "sky.exr").read_bytes(), "sky.exr").light.astype(float)


def _clouded(
    light: np.ndarray, direct: np.ndarray, sun: tuple[float, float], cover: float, seed: int
) -> tuple[np.ndarray, float]:
    """Return the sky behind its clouds, and what they leave of the sun."""
    if cover == 0:
        return light.copy(), 1.0
    where, up = angles(WIDTH)

    def depth(azimuth: np.ndarray, elevation: np.ndarray) -> np.ndarray:
        far = _HEIGHT / np.tan(np.radians(np.maximum(elevation, 0.5)))
        x, y = (far * f(np.radians(azimuth)) for f in (np.cos, np.sin))
        field = _noise(np.random.default_rng(seed), x / 2.5, y / 2.5)
        return 25 * np.clip(field - (1 - cover), 0, None) * np.clip(elevation / 2, 0, 1)

    thick = depth(where, up)
    opacity = 1 - np.exp(-thick)
    lit = np.sin(np.radians(sun[1])) * direct + _upper(light)
    forward = 1.4 / (2.2 - 2 * _cosine(sun, where, up)) ** 1.5
    # Thin edges shine, thick bases are grey.
    bright = 0.35 + 0.45 * np.exp(-thick / 3)
    cloud = bright[..., None] * lit / np.pi + (np.exp(-thick) * forward)[..., None] * direct * 0.03
    shade = float(np.exp(-depth(np.array(sun[0]), np.array(sun[1]))))
    return light + opacity[..., None] * (cloud - light), shade


def _upper(light: np.ndarray) -> np.ndarray:
    sky = light.copy()
    sky[WIDTH // 4 :] = 0
    return np.asarray(irradiance(sky))


def _cosine(sun: tuple[float, float], azimuth: np.ndarray, elevation: np.ndarray) -> np.ndarray:
    a, b, turn = np.radians(sun[1]), np.radians(elevation), np.radians(azimuth - sun[0])
    return np.sin(a) * np.sin(b) + np.cos(a) * np.cos(b) * np.cos(turn)


def _noise(chance: np.random.Generator, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return value noise of five octaves, spread evenly over about [0, 1]."""
    total = np.zeros(np.broadcast(x, y).shape)
    for octave in range(5):
        lattice = chance.random((64, 64))
        u, v = x * 2**octave, y * 2**octave
        i, j = np.floor(u).astype(int), np.floor(v).astype(int)
        s, t = ((a - np.floor(a)) ** 2 * (3 - 2 * (a - np.floor(a))) for a in (u, v))

        corners = [lattice[(i + m) % 64, (j + n) % 64] for m in (0, 1) for n in (0, 1)]
        near, far = ((1 - t) * corners[k] + t * corners[k + 1] for k in (0, 2))
        total += 0.55**octave * ((1 - s) * near + s * far)
    total /= sum(0.55**n for n in range(5))
    return np.clip((total - 0.5) * 1.6 + 0.5, 0, 1)


def main() -> None:
    """Write the skies of some seeds, and their photos, as ``FOLDER/SEED.npz``."""
    folder, first, last = Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    for seed in range(first, last):
        if sys.argv[4:] == ["moved"]:
            pair = moved_sky(seed)
            np.savez_compressed(
                folder / f"{seed}.npz",
                light=pair.light.astype(np.float32),
                direct=pair.direct,
                directions=pair.directions,
                sky=pair.sky,
            )
            continue
        sky = true_sky(seed)
        camera = (sky.camera.width, sky.camera.height, sky.camera.fov_vertical_deg)
        np.savez_compressed(
            folder / f"{seed}.npz",
            light=sky.light.astype(np.float32),
            photo=photo(sky),
            direct=sky.direct,
            direction=sky.direction,
            cover=sky.cover,
            albedo=sky.albedo,
            camera=[*camera, sky.camera.pitch],
        )


if __name__ == "__main__":
    main()
