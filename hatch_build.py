"""Build hook: no wheel leaves without its front end.

An editable install skips the check, so that Python work needs no Node.
"""

import shutil
import subprocess
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class FrontEndHook(BuildHookInterface):
    """Run ``npm run build`` when ``sunwidget/static`` holds no bundle."""

    def initialize(self, version: str, _build_data: dict[str, Any]) -> None:
        """Build the front end, or say why a wheel cannot be made without it."""
        root = Path(self.root)
        if version == "editable" or any((root / "sunwidget" / "static").glob("*.js")):
            return
        npm = shutil.which("npm")
        if npm is None:
            raise RuntimeError(
                "The front end is not built (sunwidget/static is empty) and npm was not found. "
                "Install Node 20 or newer, then run `make build`."
            )
        subprocess.run([npm, "install", "--no-save"], cwd=root / "js", check=True)
        subprocess.run([npm, "run", "build"], cwd=root / "js", check=True)
