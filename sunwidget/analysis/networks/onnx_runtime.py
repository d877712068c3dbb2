"""onnxruntime as sunwidget uses it: without its telemetry."""

from __future__ import annotations

import os
from types import ModuleType


def import_onnxruntime() -> ModuleType:
    """Import onnxruntime with its telemetry disabled and no identifier left on disk.

    Since 1.29 its wheels report sessions and models to the vendor and keep a device identifier in
    the cache folder, unless an environment variable disables this before the first import.
    sunwidget sends nothing without consent, and respects the variable if the user has set it.

    Raises
    ------
    ImportError
        If onnxruntime is not installed.
    """
    refused = os.environ.setdefault("ORT_DISABLE_TELEMETRY", "1") == "1"
    import onnxruntime

    if refused:
        onnxruntime.disable_telemetry_events()  # if another package imported it first
    return onnxruntime
