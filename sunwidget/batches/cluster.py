"""A Dask scheduler and worker processes on this machine, for as long as one batch takes."""

from __future__ import annotations

import contextlib
import logging
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import sunwidget
from sunwidget.batches.workers import DaskWorkers

# Dask has glibc give memory back whenever 64 kB are free: a picture's arrays are then mapped anew
# for each operation, which doubles the time of a photo (measured). None unsets the variable.
_MEMORY: dict[str, int | None] = {"MALLOC_TRIM_THRESHOLD_": None}
_BLAS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")  # Dask's own: 1
# What a worker should have at least: a photo of 24 MP takes about 1.5 GB.
_MEMORY_OF_ONE = 2 << 30
_ANSWER = 10.0  # seconds in which a scheduler answers


def default_workers(photos: int) -> int:
    """Return a worker for each core, at least 2 GB of memory each, and no more than photos."""
    from dask.system import CPU_COUNT
    from distributed.system import MEMORY_LIMIT

    return max(1, min(CPU_COUNT, MEMORY_LIMIT // _MEMORY_OF_ONE, photos))


@contextlib.contextmanager
def local_workers(count: int, *, deaths: int) -> Iterator[DaskWorkers]:
    """Start a scheduler in this process and ``count`` worker processes.

    Parameters
    ----------
    count : int
    deaths : int
        How many workers a photo may take down before it is given up.

    Notes
    -----
    The workers are started by ``dask worker`` and not by ``LocalCluster``, whose processes import
    the script that starts them again and so need ``if __name__ == "__main__"`` in it. They have a
    session of their own, so that Ctrl-C reaches only the process that runs the batch, and are
    killed at the end: all that is worth keeping is in this process.
    """
    from dask.system import CPU_COUNT
    from distributed import Client, LocalCluster
    from distributed.system import MEMORY_LIMIT

    threads = max(1, CPU_COUNT // count)
    with contextlib.ExitStack() as stack:
        folder = Path(
            stack.enter_context(
                tempfile.TemporaryDirectory(prefix="sunwidget-batch-", ignore_cleanup_errors=True)
            )
        )
        cluster = stack.enter_context(
            LocalCluster(
                n_workers=0,
                processes=True,  # or the scheduler would listen to this process only
                host="127.0.0.1",
                dashboard_address="127.0.0.1:0",  # any port: 8787 may be somebody's
                silence_logs=logging.CRITICAL,
                scheduler_kwargs={"allowed_failures": deaths},
            )
        )
        words = stack.enter_context((folder / "workers.log").open("w+b"))
        process = stack.enter_context(
            _processes(
                cluster.scheduler_address, count, MEMORY_LIMIT // count, threads, folder, words
            )
        )

        def alive() -> None:
            if process.poll() is not None:
                words.seek(0)
                last = words.read().decode(errors="replace").strip().splitlines()[-1:]
                raise RuntimeError(
                    f"The workers stopped: {''.join(last) or 'without a word'}. With workers=0 "
                    "the photos are done in this process."
                )

        client = stack.enter_context(Client(cluster, set_as_default=False))
        text = f"{count} worker processes" if count > 1 else "1 worker process"
        workers = DaskWorkers(client, text, threads, alive)
        workers.wait_for_one()
        yield workers


@contextlib.contextmanager
def _processes(
    address: str, count: int, memory: int, threads: int, folder: Path, words: Any
) -> Iterator[subprocess.Popen[bytes]]:
    command = [
        # -P: a folder of photos is no place to import from.
        *(sys.executable, "-P", "-m", "distributed.cli.dask_worker", address),
        *("--nworkers", str(count), "--nthreads", "1", "--memory-limit", str(memory)),
        *("--host", "127.0.0.1", "--no-dashboard", "--death-timeout", "60"),
        *("--local-directory", str(folder)),
    ]
    environment = _MEMORY | dict.fromkeys(_BLAS, threads)
    # The very sunwidget that asks, also from a checkout that is not installed.
    path = os.pathsep.join(
        [str(Path(sunwidget.__file__).parents[1]), *filter(None, [os.environ.get("PYTHONPATH")])]
    )
    process = subprocess.Popen(  # noqa: S603 - no shell, and no word of it comes from a photo
        command,
        stdin=subprocess.DEVNULL,
        stdout=words,
        stderr=subprocess.STDOUT,
        env=os.environ
        | {
            "PYTHONPATH": path,
            "DASK_DISTRIBUTED__NANNY__PRE_SPAWN_ENVIRON": repr(environment),
        },
        start_new_session=True,
    )
    try:
        yield process
    finally:
        if hasattr(os, "killpg"):
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
        else:  # Windows: workers leave when the process that watches them is gone
            process.kill()
        process.wait()


@contextlib.contextmanager
def remote_workers(scheduler: Any) -> Iterator[DaskWorkers]:
    """Connect to a scheduler: its address, a Dask cluster object, or a client, which stays open.

    Raises
    ------
    ConnectionError
        When nothing answers at the address.
    """
    from distributed import Client

    if isinstance(scheduler, Client):
        yield _ready(scheduler)
        return
    try:
        client = Client(scheduler, timeout=_ANSWER, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        raise ConnectionError(
            f"No Dask scheduler answers at {scheduler}. Start one with: dask scheduler; and "
            "workers on each machine with: dask worker tcp://… --nthreads 1"
        ) from error
    with client:
        yield _ready(client)


def _ready(client: Any) -> DaskWorkers:
    workers = DaskWorkers(client, f"the workers of {client.scheduler.address}")
    workers.wait_for_one()
    return workers
