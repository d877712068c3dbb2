"""``python -m sunwidget``."""

import sys

from sunwidget.cli.main import main

if __name__ == "__main__":
    sys.exit(main())
