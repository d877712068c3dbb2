"""A camera raw file, made here: an uncompressed DNG of a colour ramp behind a Bayer pattern."""

import io

import numpy as np
import tifffile

# XYZ (D65) to the camera's RGB, which is linear Rec. 709 here.
_FROM_XYZ = (
    (32404542, -15371385, -4985314),
    (-9692660, 18760108, 415560),
    (556434, -2040259, 10572252),
)


def ramp(height=48, width=64, top=0.85):
    """Linear Rec. 709 light that demosaicing keeps exactly away from the border."""
    y, x = np.mgrid[:height, :width]
    light = np.stack([x / width, y / height, 1 - x / width], -1)
    return light / light.max() * (top - 0.05) + 0.05


def dng(light, orientation=1, *, make="Maker", exif=()):
    """The bytes of a DNG of ``light``, stored as it is and to be turned by ``orientation``."""
    height, width = light.shape[:2]
    mosaic = np.empty((height, width), np.uint16)
    for row, column, channel in ((0, 0, 0), (0, 1, 1), (1, 0, 1), (1, 1, 2)):
        mosaic[row::2, column::2] = np.rint(light[row::2, column::2, channel] * 16383)
    matrix = [n for line in _FROM_XYZ for value in line for n in (value, 10_000_000)]
    tags = [
        (271, "s", 0, make, True),
        (272, "s", 0, "Test camera", True),
        (274, "H", 1, orientation, True),
        (33421, "H", 2, (2, 2), True),  # pattern of two by two
        (33422, "B", 4, (0, 1, 1, 2), True),  # red, green, green, blue
        (50706, "B", 4, (1, 4, 0, 0), True),
        (50707, "B", 4, (1, 1, 0, 0), True),
        (50708, "s", 0, "Test camera", True),
        (50714, "H", 1, 0, True),
        (50717, "H", 1, 16383, True),
        (50721, "2i", 9, tuple(matrix), True),
        (50728, "2I", 3, (1, 1) * 3, True),
        (50778, "H", 1, 21, True),
        *exif,
    ]
    file = io.BytesIO()
    tifffile.imwrite(
        file, mosaic, photometric="cfa", extratags=tags, metadata=None, software="Firmware 2"
    )
    return file.getvalue()
