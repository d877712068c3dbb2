"""``python -m sunwidget``."""

import sys

from sunwidget.cli import main

if __name__ == "__main__":
    sys.exit(main())
