"""onnxruntime as sunwidget uses it: without its telemetry."""

from __future__ import annotations

import os
from types import ModuleType


def onnx_runtime() -> ModuleType:
    """Import onnxruntime so that it sends nothing and leaves no identifier on the disk.

    Since 1.29 its wheels report sessions and models to their maker, and keep a device's number
    in the cache folder, unless a variable says no before the first import. sunwidget sends
    nothing unasked; a person who has set the variable is asked already.

    Raises
    ------
    ImportError
        When onnxruntime is not installed.
    """
    refused = os.environ.setdefault("ORT_DISABLE_TELEMETRY", "1") == "1"
    import onnxruntime

    if refused:
        onnxruntime.disable_telemetry_events()  # for when another's import came first
    return onnxruntime
