"""The thesis' equations in NumPy, which lie with the tests that compare the shaders with them."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "support"))

from thesis_reference import look_up, thesis_frame

__all__ = ["look_up", "thesis_frame"]
