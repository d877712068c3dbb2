#!/usr/bin/env bash
# Brings what pip and npm cannot: a Python that makes environments, EGL, Chromium; or says what to do.
# usage: scripts/setup.sh venv | other-python | gl | chromium | node
set -eu
cd "$(dirname "$0")/.."

say() { printf '\033[1m==> %s\033[0m\n' "$*"; }
fail() { printf 'setup: %s\n' "$*" >&2; exit 1; }

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"
  elif command -v sudo >/dev/null; then sudo "$@"
  else return 1
  fi
}

# install WHY PACKAGE...: by apt where there is one, else a sentence that names the packages.
install() {
  why=$1; shift
  command -v apt-get >/dev/null || fail "$why is missing and there is no apt-get here. Install what your system calls: $*"
  say "$why is missing: installing $* with apt-get"
  export DEBIAN_FRONTEND=noninteractive
  if ! { as_root apt-get update -qq && as_root apt-get install -y -qq --no-install-recommends "$@"; } </dev/null >build/apt.log 2>&1; then
    tail -n 5 build/apt.log >&2
    fail "$why could not be installed. Run as root: apt-get install $*"
  fi
}

is_new_enough() {
  "$1" -c 'import sys; sys.exit(sys.version_info < (3, 11))' >/dev/null 2>&1
}

# $PYTHON, or the first one that is new enough and really runs (version managers leave shims that do not).
find_python() {
  if [ -n "${PYTHON:-}" ]; then
    is_new_enough "$PYTHON" || fail "PYTHON=$PYTHON does not run, or is older than Python 3.11."
    command -v "$PYTHON"; return
  fi
  for candidate in python3 python3.13 python3.12 python3.11 python3.14 /usr/bin/python3; do
    if is_new_enough "$candidate"; then command -v "$candidate"; return; fi
  done
  fail "Python 3.11 or newer was not found. Install it, or name it: make PYTHON=/path/to/python3"
}

# Whether .venv is there and was made by another Python than $PYTHON, if one is named.
of_other_python() {
  [ -n "${PYTHON:-}" ] && [ -x .venv/bin/python ] || return
  version='import sys; print(sys.version)'
  [ "$("$PYTHON" -c "$version" 2>&1)" != "$(.venv/bin/python -c "$version" 2>&1)" ]
}

make_venv() {
  of_other_python || { [ -x .venv/bin/python ] && .venv/bin/python -m pip --version >/dev/null 2>&1 && return; }
  python=$(find_python)
  "$python" -c 'import ensurepip' >/dev/null 2>&1 ||
    install "The venv module of $python" "$("$python" -c 'import sys; print("python%d.%d-venv" % sys.version_info[:2])')"
  say "Virtual environment .venv with $("$python" --version)"
  rm -rf .venv
  "$python" -m venv .venv
}

# glcontext finds libGL and libEGL by ldconfig; a context is the only proof that a driver stands behind them.
has_gl() {
  .venv/bin/python -c 'import moderngl; moderngl.create_context(standalone=True, backend="egl", require=330)' >/dev/null 2>&1
}

case ${1:-} in
  venv) mkdir -p build; make_venv ;;
  other-python) if of_other_python; then rm -f .venv/made-*; fi ;;
  gl)
    mkdir -p build
    has_gl || install "EGL (off-screen OpenGL)" libegl1 libgl1 libegl-mesa0 libgl1-mesa-dri libgles2
    has_gl || fail "EGL is installed but gives no OpenGL 3.3 context. Run: .venv/bin/sunwidget doctor"
    ;;
  chromium)
    mkdir -p build
    command -v chromium >/dev/null || install "Chromium (browser tests)" chromium fonts-dejavu-core
    ;;
  node)
    command -v node >/dev/null ||
      fail "Node.js was not found; the front end needs version 20 or newer: https://nodejs.org/en/download"
    [ "$(node -p 'parseInt(process.versions.node)')" -ge 20 ] ||
      fail "Node.js $(node --version) is too old; the front end needs version 20 or newer: https://nodejs.org/en/download"
    ;;
  *) fail "usage: scripts/setup.sh venv | other-python | gl | chromium | node" ;;
esac
