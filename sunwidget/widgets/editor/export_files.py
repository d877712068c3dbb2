"""Files that the editor's export panel asks for: their formats, their names, and how they are made.

What is made lies aside until it is complete. In the notebook's folder it then gets its name,
unless that was taken meanwhile; for a download it is sent. Cancelled work leaves nothing.
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

_SHOWN_BYTES = 20_000_000  # a smaller film is sent to be looked at, wherever it was written
_PIECE_BYTES = 8_000_000
_FRAMES = "%04d.png"
_NAME_LENGTH = 120
_FORBIDDEN = '/\\:\0"<>|?*%'  # by a system's folders; % numbers frames
_ZIP = "application/zip"


class Kind(NamedTuple):
    """A kind of file that the panel offers.

    Whether it has a ``quality`` or is a picture a frame, and the ``module`` it needs, which the
    extra ``extra`` installs.
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
        """How to install what it needs; "" when all is there."""
        if not self.module or importlib.util.find_spec(self.module) is not None:
            return ""
        return f"pip install 'sunwidget[{self.extra}]'"

    def described(self) -> dict[str, Any]:
        """Return what the panel shows of it."""
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
    """Return the kind with this suffix; ValueError when there is none."""
    for kind in kinds:
        if kind.suffix == suffix:
            return kind
    raise ValueError(f"There is no format {suffix!r:.40} to export to.")


def made(
    kind: Kind,
    name: Any,
    make: Callable[[Path], object],
    progress: Progress,
    *,
    in_folder: bool,
) -> Answer:
    """Make a file and answer with it.

    Parameters
    ----------
    kind : Kind
    name : str
        The file's name, with or without its ending, in no other folder.
    make : callable
        ``make(path)`` writes it; ``path`` is a pattern for a format of frames.
    progress : callable
    in_folder : bool
        Write it into the kernel's folder instead of sending it.

    Returns
    -------
    dict, list of bytes
        ``name``, ``bytes``, ``type`` and, in the folder, ``path``; the file follows in pieces
        where it is sent, or a film small enough to be shown. Several files become a folder, or
        a ZIP. When the name is taken: ``taken`` and ``free``, and nothing was made.
    """
    stem = _checked_stem(name, kind.suffix)
    here = Path.cwd()
    # Frames and layers lie in a folder of the name without its ending.
    place = here / (stem if kind.frames else stem + kind.suffix)
    if in_folder and place.exists():
        return _taken(place), []
    # Beside its place, so that it can be moved there whole.
    with tempfile.TemporaryDirectory(
        prefix=".sunwidget-", dir=here if in_folder else None
    ) as aside:
        folder = Path(aside) / stem
        if not kind.frames:  # whose folder is made with them
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
            data = _zipped(files, Path(aside) / "all.zip")
            answer |= {"name": f"{stem}.zip", "type": _ZIP, "bytes": len(data)}
    progress(1.0, "Sending …")
    return answer, [data[i : i + _PIECE_BYTES] for i in range(0, len(data), _PIECE_BYTES)]


def possible_stem(name: str) -> str:
    """Return a photo's name without its ending as every folder takes it."""
    signs = (
        sign if sign.isprintable() and sign not in _FORBIDDEN else "_" for sign in Path(name).stem
    )
    return "".join(signs).strip(" .")[: _NAME_LENGTH // 2] or "picture"


def _checked_stem(name: Any, suffix: str) -> str:
    text = name.strip() if isinstance(name, str) else ""
    stem = text.removesuffix(suffix)
    plain = stem not in {"", ".", ".."} and not any(sign in stem for sign in _FORBIDDEN)
    if not plain or len(text) > _NAME_LENGTH:
        raise ValueError(
            f"{text[:60]!r} cannot be a file's name. Choose one of 1 to {_NAME_LENGTH} characters "
            "without slashes or other characters that file names cannot hold."
        )
    return stem


def _taken(place: Path) -> dict[str, Any]:
    names = (f"{place.stem}-{i}{place.suffix}" for i in itertools.count(2))
    free = next(name for name in names if not (place.parent / name).exists())
    return {"taken": place.name, "free": free}


def _zipped(files: list[Path], place: Path) -> bytes:
    # Pictures are packed already.
    with zipfile.ZipFile(place, "w", zipfile.ZIP_STORED) as archive:
        for path in files:
            archive.write(path, path.name)
    return place.read_bytes()
