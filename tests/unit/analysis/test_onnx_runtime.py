"""sunwidget sends nothing unasked, and neither does what it builds on."""

import os
import re
import subprocess
import sys

import onnxruntime

from sunwidget.analysis.networks.onnx_runtime import import_onnxruntime

# onnxruntime 1.29 and later write a device's number within a second of their first session.
NETWORK = """
import time
import numpy as np
import sunwidget as sw
sw.analyze(np.full((24, 32, 3), 90, np.uint8))
time.sleep(1)
"""


def test_finding_the_sky_leaves_no_identifier_on_the_disk(tmp_path):
    # In CI onnxruntime is silent by itself.
    silent = (
        "CI",
        "GITHUB_ACTIONS",
        "JENKINS_URL",
        "TF_BUILD",
        "ORT_DISABLE_TELEMETRY",
        "XDG_CACHE_HOME",
    )
    kept = {name: value for name, value in os.environ.items() if name not in silent}
    subprocess.run(
        [sys.executable, "-c", NETWORK],
        env={**kept, "HOME": str(tmp_path)},
        timeout=120,
        check=True,
    )
    assert [
        path for path in tmp_path.rglob("*") if path.name in {"deviceid", "onnxruntime.db"}
    ] == []


def test_there_is_one_door_to_onnxruntime(root):
    doors = [
        path.name
        for path in (root / "sunwidget").rglob("*.py")
        if re.search(r"^\s*(import|from) onnxruntime\b", path.read_text("utf-8"), re.MULTILINE)
    ]
    assert doors == ["onnx_runtime.py"]


def test_who_has_chosen_is_not_overruled(monkeypatch):
    asked = []
    monkeypatch.setattr(onnxruntime, "disable_telemetry_events", lambda: asked.append("silence"))
    monkeypatch.setenv("ORT_DISABLE_TELEMETRY", "0")
    import_onnxruntime()
    assert os.environ["ORT_DISABLE_TELEMETRY"] == "0"
    assert asked == []
    monkeypatch.delenv("ORT_DISABLE_TELEMETRY")
    import_onnxruntime()
    assert os.environ["ORT_DISABLE_TELEMETRY"] == "1"
    assert asked == ["silence"]
