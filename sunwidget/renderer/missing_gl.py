"""Explain why there is no OpenGL context, and what to install."""

from __future__ import annotations

import os
import platform
import sys

# Loader (libEGL, libGL) and Mesa's driver, which can draw on the processor alone.
_INSTALL = {
    "Debian or Ubuntu": "apt-get install libegl1 libgl1 libegl-mesa0 libgl1-mesa-dri",
    "Fedora or RHEL": "dnf install mesa-libEGL mesa-libGL mesa-dri-drivers",
    "Alpine": "apk add mesa-egl mesa-gl mesa-dri-gallium",
}
_FAMILIES = {
    "debian": "Debian or Ubuntu",
    "ubuntu": "Debian or Ubuntu",
    "fedora": "Fedora or RHEL",
    "rhel": "Fedora or RHEL",
    "centos": "Fedora or RHEL",
    "alpine": "Alpine",
}

NO_FLOATS = "no float targets"
_SOFTWARE = "Mesa draws without the card: LIBGL_ALWAYS_SOFTWARE=1."

# Part of glcontext's message, its meaning, and remedies other than installing packages.
_CAUSES = (
    ("not loaded", "the system's OpenGL libraries are missing", ""),
    (
        "found 0 devices",
        "EGL is there but no driver behind it",
        "A container with an NVIDIA card needs NVIDIA_DRIVER_CAPABILITIES=all.",
    ),
    (
        "eglInitialize failed",
        "no driver behind EGL starts",
        "LIBGL_ALWAYS_SOFTWARE=1 skips a graphics card that you may not use.",
    ),
    (
        "eglCreateContext failed",
        "the driver offers less than OpenGL 3.3",
        (
            "Mesa without a card offers more (LIBGL_ALWAYS_SOFTWARE=1), unless"
            " MESA_GL_VERSION_OVERRIDE is set."
        ),
    ),
    (NO_FLOATS, "the driver cannot draw into float textures", _SOFTWARE),
)


def explain(error: BaseException) -> str:
    """Return the cause and the remedy, in sentences that can be joined to one line.

    Parameters
    ----------
    error : exception
        Raised when the context was created: glcontext's bare ``Exception``, or an ImportError.
    """
    return (
        "sunwidget draws with OpenGL 3.3, which needs a driver but no display. "
        f"On this machine {cause(error)}.\n{remedy(error)}\n"
        "Then check with `sunwidget doctor`; see also docs/guide/troubleshooting.md."
    )


def cause(error: BaseException) -> str:
    """Return why there is no context, as a clause with the driver's own message."""
    said = " ".join(str(error).split()) or type(error).__name__
    if isinstance(error, ImportError):
        return f"the package moderngl cannot be imported ({said})"
    meanings = (meaning for sign, meaning, _ in _CAUSES if sign in said)
    return f"{next(meanings, 'no context could be created')} ({said})"


def remedy(error: BaseException) -> str:
    """Return what to install or set, for this system and this error."""
    if isinstance(error, ImportError):
        return "Install it again: pip install --force-reinstall moderngl glcontext"
    more = next((more for sign, _, more in _CAUSES if sign in str(error)), "")
    return f"{_packages()}. {more}".rstrip()


def _packages() -> str:
    if not sys.platform.startswith("linux"):
        return "Install the graphics card's own driver"
    debian = _INSTALL["Debian or Ubuntu"]
    # Colab and Kaggle: cells run as root and cannot answer prompts.
    if "COLAB_RELEASE_TAG" in os.environ or "KAGGLE_KERNEL_RUN_TYPE" in os.environ:
        return f"Run in a cell: !apt-get update && {debian.replace('install', 'install -y')}"
    family = _family()
    if family is None:
        ways = "; ".join(f"on {name}: {command}" for name, command in _INSTALL.items())
        return f"Install as root, {ways}"
    text = f"Install as root: {_INSTALL[family]}"
    if "CONDA_PREFIX" in os.environ:
        text += " (conda's libegl and libgl only load a driver, which the system must provide)"
    return text


def _family() -> str | None:
    try:
        about = platform.freedesktop_os_release()
    except OSError:
        return None
    names = [about.get("ID", ""), *about.get("ID_LIKE", "").split()]
    return next((_FAMILIES[name] for name in names if name in _FAMILIES), None)
