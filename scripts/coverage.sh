#!/usr/bin/env bash
# Which lines of sunwidget/ and js/src/ the tests run. Anything given goes to pytest:
#   scripts/coverage.sh tests/unit/edit/test_edit.py
# The browser is left out: what Chromium runs of JavaScript is not seen from here. Processes that
# tests start (the command line, Dask's workers) are counted.
set -u
cd "$(dirname "$0")/.."
mkdir -p build/coverage
export OPENCV_FOR_THREADS_NUM=1 OPENBLAS_NUM_THREADS=1 # see check.sh

failed=0
printf '\033[1m==> Python\033[0m\n'
[ $# = 0 ] && set -- tests/unit tests/render tests/integration tests/house tests/truth
.venv/bin/python -m pytest -n 2 --dist loadfile --no-loadscope-reorder --cov --cov-config=pyproject.toml \
  --cov-report=term --cov-report=html --durations=0 --durations-min=60 "$@" || failed=1
printf '\033[1m==> JavaScript (tests of Node alone)\033[0m\n'
npm --prefix js run --silent coverage || failed=1
echo 'Line by line: build/coverage/python/index.html'
exit $failed
