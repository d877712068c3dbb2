#!/usr/bin/env bash
# Runs every check even when one fails, pytest last so that its summary closes the output.
# Anything after `--` goes to pytest: scripts/check.sh -- -k camera
set -u
cd "$(dirname "$0")/.."
[ "${1:-}" = "--" ] && shift

failed=()
check() {
  name=$1; shift
  printf '\033[1m==> %s\033[0m\n' "$name"
  begin=$SECONDS
  "$@" || failed+=("$name")
  printf '    %s: %d s\n' "$name" $((SECONDS - begin))
}

check "ruff (lint)" .venv/bin/ruff check .
check "ruff (format)" .venv/bin/ruff format --check --quiet .
check "mypy (types)" .venv/bin/mypy
check "tsc and Biome (JavaScript types and lint)" npm --prefix js run --silent check
check "JavaScript tests" npm --prefix js run --silent test

printf '\033[1m==> pytest\033[0m\n'
if ((${#failed[@]})); then
  trap 'printf "Failed before pytest: %s\n" "$(IFS=,; echo "${failed[*]}")"; exit 1' EXIT
fi
# Each of the two workers has a core, so a library's second thread only stands in the other's way.
export OPENCV_FOR_THREADS_NUM=1 OPENBLAS_NUM_THREADS=1
# Two at a time, a file on one worker, since its fixtures are dear; in the order of collection,
# which has the long files first and many short ones at the end.
.venv/bin/python -m pytest -n 2 --dist loadfile --no-loadscope-reorder "$@"
