"""Notebook servers on a free port of this machine, each with a home of its own."""

import os
import signal
import socket
import subprocess
import time
import urllib.request
from contextlib import contextmanager

_PATIENCE = 120  # s


@contextmanager
def serving(command, folder, root, *, status, settings=None):
    """Run a server and yield its address ``http://127.0.0.1:PORT``; end it, and its kernels too.

    ``command(port)`` is what to run in ``folder``, ``status`` the path that answers once the
    server is up, ``settings`` what else its environment holds.
    """
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    environment = {
        **os.environ,
        "HOME": str(folder / ".home"),
        "IPYTHONDIR": str(folder / ".home" / "ipython"),
        "PYTHONPATH": os.pathsep.join([str(root), os.environ.get("PYTHONPATH", "")]).rstrip(":"),
        **(settings or {}),
    }
    (folder / ".home").mkdir(exist_ok=True)
    path = folder / "server.log"
    log = path.open("wb")
    # A session of its own, so that its kernels end with it.
    process = subprocess.Popen(
        command(port), cwd=folder, env=environment, stdout=log, stderr=log, start_new_session=True
    )
    address = f"http://127.0.0.1:{port}"
    try:
        _wait_until_up(process, f"{address}{status}", path)
        yield address
    finally:
        for ending in (signal.SIGTERM, signal.SIGKILL):
            try:
                os.killpg(process.pid, ending)
            except ProcessLookupError:
                break
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                continue
        process.wait(20)
        log.close()


def _wait_until_up(process, status, log):
    until = time.monotonic() + _PATIENCE
    while time.monotonic() < until:
        if process.poll() is not None:
            break
        try:
            with urllib.request.urlopen(status, timeout=5):
                return
        except OSError:
            time.sleep(0.2)
    raise RuntimeError(f"The server did not start:\n{log.read_text()[-4000:]}")
