"""The command ``sunwidget doctor``: checks of everything that is required or optional."""

from __future__ import annotations

import contextlib
import importlib.metadata
import os
import platform
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from importlib.resources import files
from typing import Any, NamedTuple

_FRAME = (1024, 698)  # as in the tables of docs/developer/speed.md
_FRAMES = 5


class Finding(NamedTuple):
    """One line of the report.

    ``remedy`` is what to install or do when ``present`` is false. A missing ``essential`` item
    makes the command fail.
    """

    name: str
    present: bool
    essential: bool
    detail: str
    remedy: str = ""


def findings() -> list[Finding]:
    """Check this machine. Never raises: a check that fails becomes a finding."""
    report: list[Finding] = []
    for name, essential, check in _CHECKS:
        try:
            report.extend(check())
        except Exception as error:  # noqa: BLE001 - every error of a check is reported
            why = f"{type(error).__name__}: {str(error).splitlines()[0] if str(error) else ''}"
            report.append(Finding(name, False, essential, why, _REMEDIES.get(name, "")))
    return report


def print_report(report: list[Finding]) -> bool:
    """Print the findings as a table; return whether everything essential is present."""
    width = max(len(finding.name) for finding in report)
    for finding in report:
        mark = "ok" if finding.present else "MISSING" if finding.essential else "absent"
        print(f"{mark:8}{finding.name:{width}}  {finding.detail}")
        if not finding.present and finding.remedy:
            print(f"{'':8}{'':{width}}  → {finding.remedy}")
    return all(finding.present for finding in report if finding.essential)


def _python() -> Iterator[Finding]:
    version = importlib.metadata.version("sunwidget")
    new_enough = sys.version_info >= (3, 11)
    detail = f"{platform.python_version()}, {platform.system()} {platform.machine()}"
    yield Finding("Python", new_enough, True, detail, "Python 3.11 or newer")
    yield Finding("sunwidget", True, True, version)


def _graphics() -> Iterator[Finding]:
    from sunwidget.errors import RendererError
    from sunwidget.renderer.gl_thread import on_gl_thread
    from sunwidget.renderer.missing_gl import cause, remedy

    try:
        info = on_gl_thread(lambda context: dict(context.info))
    except RendererError as error:
        why = error.__cause__ or error
        yield Finding("EGL", False, True, cause(why), remedy(why))
        return
    version = info["GL_VERSION"].split(" (")[0]
    yield Finding("EGL", True, True, f"{info['GL_RENDERER']}, OpenGL {version}")
    largest = info["GL_MAX_TEXTURE_SIZE"]
    yield Finding(
        "GL limits",
        largest >= 4096,
        False,
        f"textures up to {largest} pixels a side (photos may be larger), "
        f"{info['GL_MAX_TEXTURE_IMAGE_UNITS']} at once",
        "install a newer graphics driver; less than 4096 is untested",
    )


def _shaders() -> Iterator[Finding]:
    from sunwidget.errors import RendererError
    from sunwidget.renderer.gl_thread import on_gl_thread
    from sunwidget.renderer.graph import Programs
    from sunwidget.renderer.shader_source import frame_graph, part_shaders

    shaders: set[str] = set()
    for name in ("graph", "explorer"):
        for row in frame_graph(name)["passes"]:
            shaders.update(part_shaders(row))
            if "parts" in row:
                shaders.add(row["parts"]["by"])

    def compile_all(context: Any) -> None:
        programs = Programs(context)
        for shader in sorted(shaders):
            programs.get(shader)

    try:
        on_gl_thread(compile_all)
    except RendererError:
        yield Finding("shaders", False, True, "not checked", "EGL must work first")
        return
    yield Finding("shaders", True, True, f"{len(shaders)} compile")


def _sample_photo() -> Iterator[Finding]:
    """Analyze and render the sample once, and report how fast this machine is."""
    from statistics import median

    import sunwidget as sw
    from sunwidget.errors import RendererError

    begin = time.perf_counter()
    scene = sw.analyze(sw.sample())
    detail = f"analyzed in {time.perf_counter() - begin:.1f} s"

    def seconds(azimuth: int) -> float:
        begin = time.perf_counter()
        sw.render(scene, sw.Edit(sun_azimuth=azimuth), size=_FRAME)
        return time.perf_counter() - begin

    try:
        taken = [seconds(azimuth) for azimuth in range(_FRAMES + 1)][1:]  # the first compiles
    except RendererError:
        yield Finding("sample photo", True, False, f"{detail}; rendering not checked")
        return
    size = "×".join(map(str, _FRAME))
    detail += f", {size} rendered in {1000 * median(taken):.0f} ms (sun moved, median of {_FRAMES})"
    yield Finding("sample photo", True, True, detail)


def _opencv() -> Iterator[Finding]:
    import cv2

    owners = []
    for name in ("opencv-python", "opencv-python-headless", "opencv-contrib-python"):
        with contextlib.suppress(importlib.metadata.PackageNotFoundError):
            owners.append(f"{name} {importlib.metadata.version(name)}")
    contrib = hasattr(cv2, "ximgproc") and hasattr(cv2.ximgproc, "guidedFilter")
    detail = f"{cv2.__version__}, cv2.ximgproc {'found' if contrib else 'not found'}"
    if owners:
        detail += f"; also installed: {', '.join(owners)}"
    yield Finding("OpenCV", contrib, True, detail, _REMEDIES["OpenCV"])


def _sky_network() -> Iterator[Finding]:
    from sunwidget.analysis.networks.onnx_runtime import import_onnxruntime

    onnxruntime = import_onnxruntime()
    model = files("sunwidget").joinpath("analysis", "models", "sky.onnx").read_bytes()
    session = onnxruntime.InferenceSession(model, providers=["CPUExecutionProvider"])
    sides = session.get_inputs()[0].shape
    shape = "×".join(str(n) if isinstance(n, int) else "any" for n in sides)
    detail = f"{len(model) / 1e6:.1f} MB, input {shape}, onnxruntime {onnxruntime.__version__}"
    yield Finding("sky network", True, True, detail)


def _pillow() -> Iterator[Finding]:
    import PIL
    from PIL import features

    wanted = {"jpg": "JPEG", "zlib": "PNG", "libtiff": "TIFF", "webp": "WebP", "littlecms2": "ICC"}
    have = [label for codec, label in wanted.items() if features.check(codec)]
    lacking = [label for label in wanted.values() if label not in have]
    detail = f"Pillow {PIL.__version__}: {', '.join(have)}"
    if lacking:
        detail += f"; without {', '.join(lacking)}"
    yield Finding("photo files", not lacking, True, detail, _REMEDIES["photo files"])


def _films() -> Iterator[Finding]:
    import imageio_ffmpeg

    encoders = subprocess.run(  # noqa: S603 - no shell, no user input
        [imageio_ffmpeg.get_ffmpeg_exe(), "-hide_banner", "-encoders"],
        capture_output=True,
        text=True,
        check=True,
        timeout=30,
    ).stdout
    detail = f"ffmpeg {imageio_ffmpeg.get_ffmpeg_version()}"
    yield Finding("MP4 films", "libx264" in encoders, False, detail, _REMEDIES["MP4 films"])


def _raw_files() -> Iterator[Finding]:
    import rawpy

    libraw = ".".join(str(number) for number in rawpy.libraw_version)
    detail = f"rawpy {importlib.metadata.version('rawpy')}, LibRaw {libraw}"
    yield Finding("raw files", True, False, detail)


def _heic_photos() -> Iterator[Finding]:
    import pillow_heif

    detail = f"pillow-heif {pillow_heif.__version__}, libheif {pillow_heif.libheif_version()}"
    yield Finding("HEIC photos", True, False, detail)


def _open_exr() -> Iterator[Finding]:
    import OpenEXR

    yield Finding("OpenEXR", True, False, f"OpenEXR {OpenEXR.__version__}")


def _many_photos() -> Iterator[Finding]:
    import distributed  # noqa: F401 - imports dask; the check is that both import

    found = [f"{name} {importlib.metadata.version(name)}" for name in ("dask", "distributed")]
    yield Finding("many photos", True, False, f"{', '.join(found)}, {os.cpu_count()} cores")


def _front_end() -> Iterator[Finding]:
    bundles = [f for f in files("sunwidget").joinpath("static").iterdir() if f.name.endswith(".js")]
    sizes = [f"{f.name} {len(f.read_bytes()) / 1000:.0f} kB" for f in bundles]
    detail = ", ".join(sizes) or "sunwidget/static has no bundle"
    yield Finding("front end", bool(bundles), False, detail, _REMEDIES["front end"])


def _notebook() -> Iterator[Finding]:
    found = [
        f"{name} {importlib.metadata.version(name)}"
        for name in ("anywidget", "ipywidgets", "jupyterlab")
    ]
    yield Finding("notebook", True, False, ", ".join(found))


def _sun_path() -> Iterator[Finding]:
    try:
        detail = f"pvlib {importlib.metadata.version('pvlib')}"
    except importlib.metadata.PackageNotFoundError:
        yield Finding("sun's path", False, False, "no pvlib", _REMEDIES["sun's path"])
    else:
        yield Finding("sun's path", True, False, detail)


def _measured_skies() -> Iterator[Finding]:
    from sunwidget.validation import measurements

    there = measurements.is_available()
    detail = f"{len(measurements.load())} scans" if there else "not downloaded"
    yield Finding("measured skies", there, False, detail, _REMEDIES["measured skies"])


_REMEDIES = {
    "OpenCV": "pip uninstall -y opencv-python opencv-python-headless opencv-contrib-python"
    " && pip install --force-reinstall opencv-contrib-python-headless",
    "shaders": "pip install --force-reinstall sunwidget",
    "sky network": "pip install --force-reinstall sunwidget",
    "photo files": "pip install --force-reinstall pillow",
    "MP4 films": "pip install 'sunwidget[video]' (GIF and WebP work without)",
    "raw files": "pip install 'sunwidget[raw]'",
    "HEIC photos": "pip install 'sunwidget[heif]' (or export them as JPEG)",
    "OpenEXR": "pip install 'sunwidget[exr]' (linear light as Radiance .hdr works without)",
    "many photos": "pip install 'sunwidget[batch]' (one photo after another works without)",
    "front end": "in a checkout: make build (needs Node 20 or newer); stills work without",
    "notebook": "pip install 'sunwidget[lab]'",
    "sun's path": "pip install 'sunwidget[solar]' (SkyExplorer at a date and place)",
    "measured skies": "sunwidget.validation.measurements.download() (21 MB; for validation only)",
}

_CHECKS: tuple[tuple[str, bool, Callable[[], Iterator[Finding]]], ...] = (
    ("Python", True, _python),
    ("EGL", True, _graphics),
    ("shaders", True, _shaders),
    ("OpenCV", True, _opencv),
    ("sky network", True, _sky_network),
    ("sample photo", True, _sample_photo),
    ("photo files", True, _pillow),
    ("MP4 films", False, _films),
    ("raw files", False, _raw_files),
    ("HEIC photos", False, _heic_photos),
    ("OpenEXR", False, _open_exr),
    ("many photos", False, _many_photos),
    ("front end", False, _front_end),
    ("notebook", False, _notebook),
    ("sun's path", False, _sun_path),
    ("measured skies", False, _measured_skies),
)
