"""The thesis' equations as straight NumPy and OpenCV: what the shaders are compared with.

M. Türe, "Image Based Solar Position Editing and Relighting", METU 2017, chapter 3; equation
numbers are the thesis'. ``literal`` keeps the text's slips (docs: errata). Written from the
equations, one full-size array a step, with no thought of speed: the benchmark divides its time
by the renderer's.

The sky is either looked up in what the renderer's own sky pass drew (``sky="passes"``, to
compare the equations alone) or marched here from the scene (``sky="model"``).
"""

from __future__ import annotations

import re

import cv2
import numpy as np

from sunwidget.analysis import frame_inputs
from sunwidget.analysis.fit.fit import Response, view_angles
from sunwidget.analysis.images.color_transfer import Statistics, from_lab, to_lab
from sunwidget.atmosphere.color import spectral_to_rec709
from sunwidget.atmosphere.optics import direct_irradiance
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.sky import SkyTable
from sunwidget.atmosphere.sun import disc_radiance
from sunwidget.edit.table import NUMBERS, Edit
from sunwidget.renderer import render_pass
from sunwidget.renderer.shader_source import read_shader
from sunwidget.renderer.values import parameter_values

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
DISC_RADIUS = 0.2665
SKY_SHARE = float(
    re.search(r"kSkyShare = ([\d.]+)", read_shader("atmosphere/read_sky_view.glsl")).group(1)
)
_AIR = (
    "aerosol_optical_depth",
    "angstrom_exponent",
    "aerosol_asymmetry",
    "aerosol_albedo",
    "ozone",
    "ground_albedo",
    "altitude",
    "air_density",
    "rayleigh_exponent",
    "rayleigh_scale_height",
    "aerosol_scale_height",
)


def thesis_frame(scene, edit, *, literal=None, sky="model"):
    """Return the edited picture, (H, W, 3) uint8, undithered.

    ``literal`` defaults to what ``edit.method`` says; ``sky`` is ``"model"`` or ``"passes"``.
    """
    literal = edit.method == "thesis_literal" if literal is None else literal
    source = parameter_values(Edit(), scene.automatic)
    now = parameter_values(edit, scene.automatic)
    known = frame_inputs.uniforms(scene)
    response = Response(known["response_shoulder"], known["response_contrast"])
    photo = scene.photo.pixels.astype(np.float64)
    matte, opacity, _, _ = np.moveaxis(quantised(frame_inputs.layers(scene)), -1, 0)

    states = ((source, "source"), (now, "edit"))

    # 3.2.3: the model's sky, developed like a photo, given the photo's sky colors.
    plain = [rendered_sky(scene, values, sky, state) for values, state in states]
    own = weighted_statistics(response.display_light(plain[0]), matte)
    target = Statistics(known["photo_sky_mean"], known["photo_sky_deviation"])

    def matched(light):
        return np.minimum(transfer(response.display_light(light), own, target), 4.0)

    first, moved = (matched(light) for light in plain)
    sky_first, sky_now = first, moved
    disc = drawn_disc(scene, now) * np.array(known["sky_gain"])
    mask = np.minimum(disc @ LUMINANCE, 1.0)[..., None]  # F'
    sky_now = sky_now + mask * (response.display_light(disc) - sky_now)

    cloud = clouds(photo, opacity, now, scene, sky_first, sky_now, mask, first, moved, literal)
    cover = cloud[1][..., None]
    background = cloud[0] * cover + sky_now * (1 - cover)  # 3.15
    land = foreground(photo, matte, source, now, scene, first, moved, literal)
    light = matte[..., None] * background + (1 - matte[..., None]) * land  # 3.16
    return np.floor(255 * encode(light) + 0.5).astype(np.uint8)


def clouds(photo, opacity, now, scene, sky_first, sky_now, mask, first, moved, literal):
    """Equations 3.5, 3.6 and 3.9 to 3.14: relit clouds (H, W, 3), and where they are (H, W)."""
    code = encode(photo)
    ratio = code[..., 0] / np.maximum(code[..., 2], 1 / 255)
    low, high = now["cloud_ratio_min"], now["cloud_ratio_max"]
    softness = ((ratio - low) / max(high - low, 1e-3))[..., None]  # 3.6
    cover = opacity
    if literal:
        cover = (ratio >= low).astype(float)  # 3.5
    else:
        softness = np.clip(softness, 0, 1)
    thick = photo * sky_now / np.maximum(sky_first, 1e-3)  # 3.10
    height, width = photo.shape[:2]
    rows, columns = np.mgrid[:height, :width] + 0.5
    x, y = place_of_sun(scene, now)
    distance = np.hypot(columns / width - x, (rows / height - y) * height / width)  # d_c
    near = (1 - np.minimum(distance / now["blend_distance"], 1))[..., None]  # 3.12
    blurred, blurred_first = blur(moved), np.maximum(blur(first), 1e-3)
    if literal:
        soft = sky_first * mask + photo * (1 - mask)  # 3.11
        soft = soft * blurred * near + soft * (1 - near)  # 3.13
    else:
        near = near ** now["blend_power"]
        through = mask * (1 - opacity[..., None])
        soft = sky_now * through + photo * (1 - through)
        soft = soft * (blurred / blurred_first * near + (1 - near))
    return soft * softness + thick * (1 - softness), cover  # 3.14


def foreground(photo, matte, source, now, scene, first, moved, literal):
    """Equations 3.7 and 3.8: relit land (H, W, 3)."""
    known = frame_inputs.uniforms(scene)
    mean_first, mean_now = (np.average(s, axis=(0, 1), weights=w3(matte)) for s in (first, moved))
    visible_first, visible_now = visible(scene, source), visible(scene, now)
    if literal:
        share = now["sun_sky_ratio"] * known["sun_mask_share"]  # F^s on the mask's pixels

        def amplified(mean, seen):
            return (mean + share * seen) / (1 + share * seen)

        photo_sky = amplified(np.array(known["photo_sky_linear_mean"]), 1.0)
        photo_land = np.maximum(known["photo_land_linear_mean"], 1e-3)
        wanted = photo_sky / photo_land * amplified(mean_now, visible_now)  # F̄' = Q × S̄ʳ
        land = wanted / photo_land * photo  # 3.7
    else:
        noon = beam(scene, source, risen=True) @ LUMINANCE
        share = 0.25 * now["sun_sky_ratio"] / 1000 * (mean_first @ LUMINANCE)

        def with_sun(mean, values, seen):
            light = beam(scene, values, risen=True)
            color = light / max(light @ LUMINANCE, 1e-9)
            strength = beam(scene, values, risen=False) @ LUMINANCE / max(noon, 1e-9)
            return mean + share * seen * strength * color

        gain = with_sun(mean_now, now, visible_now) / np.maximum(
            with_sun(mean_first, source, visible_first), 1e-4
        )
        land = gain * photo
    s = 1 - (1 - now["thesis_saturation"]) * np.clip(visible_first - visible_now, 0, 1)
    level = np.maximum(land @ LUMINANCE, 1e-6)[..., None]
    return np.maximum(land / level, 1e-6) ** s * level  # 3.8


def transfer(linear, own, target):
    """Reinhard's colour transfer, 2.10 and 2.11; a flat sky has no deviation to scale by."""
    scale = np.array(target.deviation) / np.maximum(own.deviation, 0.02)
    lab = (to_lab(linear) - own.mean) * scale + target.mean
    return np.maximum(from_lab(lab), 0)


def weighted_statistics(linear, weight):
    lab = to_lab(linear)
    mean = np.average(lab, axis=(0, 1), weights=w3(weight + 1e-6))
    variance = np.average((lab - mean) ** 2, axis=(0, 1), weights=w3(weight + 1e-6))
    return Statistics(tuple(mean), tuple(np.sqrt(variance)))


def w3(weight):
    return np.repeat(weight[..., None] + 1e-9, 3, axis=-1)


def blur(sky):
    """S_b: the sky, blurred over an eighth of the picture."""
    height, width = sky.shape[:2]
    size = (max(1, round(width / 8)) | 1, max(1, round(height / 8)) | 1)
    return cv2.blur(sky, size, borderType=cv2.BORDER_REPLICATE)


def rendered_sky(scene, values, origin, state):
    """Return the model's sky times its gain, (H, W, 3) scene-linear, without disc and glare."""
    width, height = scene.width, scene.height
    azimuth, elevation = view_angles(scene.camera, width, height)
    view = render_pass_of(scene, values, f"sky_view_{state}")
    elevation = np.maximum(elevation, np.degrees(view[-1, 3, 0] + 1e-3))  # no ground
    if origin == "passes":
        spectral = look_up(view, azimuth, elevation)
    else:
        table = SkyTable(Atmosphere(**{name: values[name] for name in _AIR}))
        spectral = table.radiance(
            elevation, azimuth - values["sun_azimuth"], values["sun_elevation"]
        )
    color = spectral_to_rec709(spectral)
    color = np.maximum(color, 0.02 * np.maximum(color @ LUMINANCE, 1e-12)[..., None])
    return color * np.array(frame_inputs.uniforms(scene)["sky_gain"])


def render_pass_of(scene, values, name):
    numbers = {p.name: values[p.name] for p in NUMBERS if p.name in values}
    return render_pass(scene, Edit(**numbers, method="thesis"), name).astype(np.float64)


def look_up(view, azimuth, elevation):
    """Read the renderer's sky view: radiance over a guess; its last row describes it."""
    described, table = view[-1], view[:-1]
    sun, g = described[0, :3], described[0, 3]
    horizon = described[3, 0]
    rows, columns = table.shape[:2]
    above = int(rows * SKY_SHARE)
    el, az = np.radians(elevation), np.radians(azimuth)
    direction = np.stack([np.cos(el) * np.sin(az), np.sin(el), np.cos(el) * np.cos(az)], -1)
    turn = np.abs(az - np.arctan2(sun[0], sun[2]))
    turn = np.minimum(turn, 2 * np.pi - turn)
    x = np.clip((np.sqrt(0.09 + 2.8 * turn / np.pi) - 0.3) / 1.4, 0, 1) * (columns - 1)
    up = np.sqrt(np.maximum(el - horizon, 0) / (np.pi / 2 - horizon))
    down = np.sqrt(np.maximum(horizon - el, 0) / (np.pi / 2 + horizon))
    is_up = el >= horizon
    y = np.where(is_up, (1 - np.minimum(up, 1)) * (above - 1), above + down * (rows - above - 1))
    i = np.where(
        is_up, np.minimum(y.astype(int), above - 2), np.clip(y.astype(int), above, rows - 2)
    )
    j = np.minimum(x.astype(int), columns - 2)
    fy, fx = (y - i)[..., None], (x - j)[..., None]
    value = (table[i, j] * (1 - fx) + table[i, j + 1] * fx) * (1 - fy)
    value += (table[i + 1, j] * (1 - fx) + table[i + 1, j + 1] * fx) * fy
    nu = (direction @ sun)[..., None]
    rayleigh = 3 / (16 * np.pi) * (1 + nu**2)
    mie = 3 / (8 * np.pi) * (1 - g * g) * (1 + nu**2)
    mie = mie / ((2 + g * g) * np.maximum(1 + g * g - 2 * g * nu, 1e-6) ** 1.5)
    return value * (described[1] * (rayleigh + 0.04) + described[2] * mie)


def drawn_disc(scene, values):
    """Radiance of the new disc, (H, W, 3) linear Rec. 709 in kcd m⁻²."""
    size = values["sun_size"]
    angle = angle_from_sun(scene, values)
    _, elevation = view_angles(scene.camera, scene.width, scene.height)
    pixel = np.degrees(1 / (frame_inputs.uniforms(scene)["camera_focal"] * scene.height))
    radius = DISC_RADIUS * size
    coverage = np.clip((radius - angle) / pixel + 0.5, 0, 1) * (size > 0)
    atmosphere = Atmosphere(**{name: values[name] for name in _AIR})
    inside = np.minimum(angle / max(radius, 1e-9), np.sqrt(1 - 1e-4)) * DISC_RADIUS
    # The air's path at each pixel; half a pixel of the horizon belongs to the disc.
    light = disc_radiance(atmosphere, np.maximum(elevation, 0.0), inside)
    risen = np.clip(elevation / pixel + 0.5, 0, 1)
    return np.maximum(spectral_to_rec709(light), 0) * (coverage * risen)[..., None]


def beam(scene, values, *, risen):
    """Return the sun's light at the camera in linear Rec. 709; ``risen``: as if wholly up."""
    atmosphere = Atmosphere(**{name: values[name] for name in _AIR})
    elevation = values["sun_elevation"]
    light = direct_irradiance(atmosphere, max(elevation, 0.0))
    if risen:
        light = light / max(share_above(0.0 if elevation < 0 else elevation), 1e-9)
    else:
        light = light / max(share_above(max(elevation, 0.0)), 1e-9) * share_above(elevation)
    return np.maximum(spectral_to_rec709(light), 1e-9)


def share_above(elevation):
    """Share of the disc above the horizon, for the elevation of its centre in degrees."""
    x = float(np.clip(elevation / DISC_RADIUS, -1, 1))
    return 0.5 + (x * np.sqrt(1 - x * x) + np.arcsin(x)) / np.pi


def angle_from_sun(scene, values):
    azimuth, elevation = view_angles(scene.camera, scene.width, scene.height)
    a, e = np.radians(azimuth - values["sun_azimuth"]), np.radians(elevation)
    s = np.radians(values["sun_elevation"])
    chord = (np.cos(e) * np.sin(a)) ** 2 + (np.sin(e) - np.sin(s)) ** 2
    chord += (np.cos(e) * np.cos(a) - np.cos(s)) ** 2
    return np.degrees(2 * np.arcsin(np.minimum(np.sqrt(chord) / 2, 1)))


def place_of_sun(scene, values):
    """Where the sun appears, in fractions; behind the camera, the mirrored place."""
    e, a = np.radians(values["sun_elevation"]), np.radians(values["sun_azimuth"])
    camera = scene.camera
    world = (np.cos(e) * np.sin(a), np.sin(e), np.cos(e) * np.cos(a))
    axes = np.array([camera.right, camera.up, camera.forward])
    ray = np.array(world) @ axes
    depth = max(abs(ray[2]), 1e-4)
    return (
        0.5 + ray[0] / depth * camera.focal / camera.width,
        0.5 + ray[1] / depth * camera.focal / camera.height,
    )


def visible(scene, values):
    """Share of the disc that land and clouds leave visible, by the renderer's own samples."""
    name = "visibility_edit"
    return float(render_pass_of(scene, values, name)[0, 0, 0])


def quantised(image):
    return np.floor(np.clip(image, 0, 1).astype(np.float32) * 255 + 0.5) / 255


def encode(light):
    x = np.clip(light, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * np.maximum(x, 1e-8) ** (1 / 2.4) - 0.055)
