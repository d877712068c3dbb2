"""Files of the editor's export panel: formats, names and writing.

Files are written to a temporary folder. When they are complete, they are moved to the notebook's
folder, unless the name was taken meanwhile, or sent as a download. Cancelled work leaves no file.
"""

from __future__ import annotations

import importlib.util
import itertools
import tempfile
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from sunwidget.progress import Progress
from sunwidget.widgets.kernel.requests import Answer

_SHOWN_BYTES = 20_000_000  # smaller films are also sent to the browser, which plays them
_PIECE_BYTES = 8_000_000
_FRAMES = "%04d.png"
_NAME_LENGTH = 120
_FORBIDDEN = '/\\:\0"<>|?*%'  # in file names of some system; % numbers frames
_ZIP = "application/zip"


class Kind(NamedTuple):
    """A file format that the panel offers.

    ``quality``: it has a quality setting. ``frames``: it writes one file per frame. ``module`` is
    required and installed by the extra ``extra``.
    """

    suffix: str
    label: str
    type: str
    quality: bool = False
    frames: bool = False
    module: str = ""
    extra: str = ""

    @property
    def lacks(self) -> str:
        """The command that installs a missing module, or ""."""
        if not self.module or importlib.util.find_spec(self.module) is not None:
            return ""
        return f"pip install 'sunwidget[{self.extra}]'"

    def describe(self) -> dict[str, Any]:
        """Return the entry for the panel."""
        return {
            "suffix": self.suffix,
            "label": self.label,
            "quality": self.quality,
            "lacks": self.lacks,
        }


# fmt: off
STILLS = (
    Kind(".png", "PNG", "image/png"),
    Kind(".jpg", "JPEG", "image/jpeg", quality=True),
    Kind(".tif", "TIFF", "image/tiff"),
    Kind(".webp", "WebP", "image/webp", quality=True),
    Kind(".exr", "OpenEXR", "image/x-exr", module="OpenEXR", extra="exr"),
    Kind(".hdr", "Radiance HDR", "image/vnd.radiance"),
)
FILMS = (
    Kind(".mp4", "MP4", "video/mp4", quality=True, module="imageio_ffmpeg", extra="video"),
    Kind(".gif", "GIF", "image/gif"),
    Kind(".webp", "WebP", "image/webp", quality=True),
    Kind(".png", "PNG frames", "image/png", frames=True),
)
# fmt: on


def kind_of(kinds: tuple[Kind, ...], suffix: Any) -> Kind:
    """Return the format with this suffix; raise ValueError if there is none."""
    for kind in kinds:
        if kind.suffix == suffix:
            return kind
    raise ValueError(f"There is no export format {suffix!r:.40}.")


def make_file(
    kind: Kind,
    name: Any,
    make: Callable[[Path], object],
    progress: Progress,
    *,
    in_folder: bool,
) -> Answer:
    """Write a file and return the response to the browser.

    Parameters
    ----------
    kind : Kind
    name : str
        The file's name, with or without its extension, without a folder.
    make : callable
        ``make(path)`` writes it; ``path`` is a pattern for a format of frames.
    progress : callable
    in_folder : bool
        Write it into the kernel's folder instead of sending it.

    Returns
    -------
    dict, list of bytes
        ``name``, ``bytes``, ``type`` and, in the folder, ``path``, with the pieces of a file that
        is sent or of a film small enough to be played. Several files become a folder or a ZIP. If
        the name is taken: ``taken`` and ``free``, and no file is written.
    """
    stem = _checked_stem(name, kind.suffix)
    here = Path.cwd()
    # Frames and layers go into a folder of that name without extension.
    place = here / (stem if kind.frames else stem + kind.suffix)
    if in_folder and place.exists():
        return _taken(place), []
    # On the same file system, so that the move is atomic.
    with tempfile.TemporaryDirectory(
        prefix=".sunwidget-", dir=here if in_folder else None
    ) as aside:
        folder = Path(aside) / stem
        if not kind.frames:  # the writer of frames creates the folder
            folder.mkdir()
        make(folder / (_FRAMES if kind.frames else stem + kind.suffix))
        files = sorted(path for path in folder.iterdir() if path.is_file())
        single = files[0] if len(files) == 1 and not kind.frames else None
        place = here / (single.name if single else stem)
        size = sum(path.stat().st_size for path in files)
        answer = {"name": place.name, "type": kind.type, "bytes": size, "files": len(files)}
        data = b""
        shown = kind in FILMS and size <= _SHOWN_BYTES
        if single is not None and (shown or not in_folder):
            data = single.read_bytes()
        if in_folder:
            if place.exists():
                return _taken(place), []
            (single or folder).replace(place)
            answer["path"] = str(place)
        elif single is None:
            progress(1.0, "Packing …")
            data = _zip(files, Path(aside) / "all.zip")
            answer |= {"name": f"{stem}.zip", "type": _ZIP, "bytes": len(data)}
    progress(1.0, "Sending …")
    return answer, [data[i : i + _PIECE_BYTES] for i in range(0, len(data), _PIECE_BYTES)]


def possible_stem(name: str) -> str:
    """Return a photo's name without its extension, valid as a file name on every system."""
    characters = (c if c.isprintable() and c not in _FORBIDDEN else "_" for c in Path(name).stem)
    return "".join(characters).strip(" .")[: _NAME_LENGTH // 2] or "picture"


def _checked_stem(name: Any, suffix: str) -> str:
    text = name.strip() if isinstance(name, str) else ""
    stem = text.removesuffix(suffix)
    plain = stem not in {"", ".", ".."} and not any(c in stem for c in _FORBIDDEN)
    if not plain or len(text) > _NAME_LENGTH:
        raise ValueError(
            f"{text[:60]!r} cannot be a file's name. Choose 1 to {_NAME_LENGTH} characters "
            'without / \\ : * ? " < > % or |.'
        )
    return stem


def _taken(place: Path) -> dict[str, Any]:
    names = (f"{place.stem}-{i}{place.suffix}" for i in itertools.count(2))
    free = next(name for name in names if not (place.parent / name).exists())
    return {"taken": place.name, "free": free}


def _zip(files: list[Path], place: Path) -> bytes:
    # Pictures are already compressed.
    with zipfile.ZipFile(place, "w", zipfile.ZIP_STORED) as archive:
        for path in files:
            archive.write(path, path.name)
    return place.read_bytes()
