"""The command ``sunwidget demo``: every kind of output for one bundled photo."""

from __future__ import annotations

import contextlib
import importlib.util
from pathlib import Path

from sunwidget.edit.table import Edit
from sunwidget.progress import Progress, part

SAMPLE = "coast"
STILL = Edit(sun_elevation=3)
SUNSET = (14.0, -4.0)
FILM_SIZE = (960, 640)


def demo(folder: Path, progress: Progress | None = None) -> list[tuple[Path, str]]:
    """Analyze the sample and write its maps, a still, a recipe, a page and a sunset film.

    Returns (path, description) pairs in the order of writing. Files of an earlier demo are
    replaced. Without the ``video`` extra the film is a WebP; without the built front end there is
    no page.
    """
    import sunwidget as sw
    from sunwidget.export.maps import save_maps
    from sunwidget.renderer.gl_thread import require_renderer

    require_renderer()
    report = progress or (lambda _fraction, _message: None)
    folder.mkdir(parents=True, exist_ok=True)
    scene = sw.analyze(sw.sample(SAMPLE), progress=part(report, 0.0, 0.3))
    save_maps(scene, folder / "maps", overwrite=True)
    made = [(folder / "maps", "results of the analysis: overview.png, scene.json, every map")]

    still = folder / "still.png"
    sw.save((scene, STILL), still, overwrite=True)
    made.append((still, f"the same picture with the sun at {STILL.sun_elevation:g}°"))
    recipe = folder / "recipe.json"
    recipe.write_text(STILL.to_json() + "\n", "utf-8")
    made.append((recipe, f"its recipe: sunwidget render sample:{SAMPLE} --recipe {recipe} -o …"))

    # A checkout without Node has no front end; its build reports that.
    with contextlib.suppress(ImportError):
        page = folder / "page.html"
        sw.to_html(scene, STILL, page, title="Move the sun over the coast", overwrite=True)
        made.append((page, "a page in which the sun can be moved: open it in a browser"))

    suffix = ".mp4" if importlib.util.find_spec("imageio_ffmpeg") else ".webp"
    ends = [Edit(sun_elevation=elevation) for elevation in SUNSET]
    film = folder / f"sunset{suffix}"
    sw.sweep(
        scene,
        ends,
        film,
        size=FILM_SIZE,
        overwrite=True,
        progress=part(report, 0.4, 1.0),
    )
    made.append((film, f"a sunset from {SUNSET[0]:g}° to {SUNSET[1]:g}°"))
    return made
