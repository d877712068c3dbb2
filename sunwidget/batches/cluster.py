"""A Dask scheduler and worker processes on this machine for the duration of one batch."""

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

# Dask makes glibc return memory whenever 64 kB are free. Each operation then maps a picture's
# arrays again, which doubles the time of a photo (measured). None unsets the variable.
_MEMORY: dict[str, int | None] = {"MALLOC_TRIM_THRESHOLD_": None}
_BLAS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")  # Dask's own: 1
# Least memory of a worker: a photo of 24 MP takes about 1.5 GB.
_MEMORY_OF_ONE = 2 << 30
_ANSWER = 10.0  # seconds to wait for an answer of the scheduler


def default_workers(photos: int) -> int:
    """Return one worker per core, limited by 2 GB of memory each and by the number of photos."""
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
        Number of workers that may die on a photo before it is abandoned.

    Notes
    -----
    ``dask worker`` starts the workers, not ``LocalCluster``: its processes import the calling
    script again, which then needs ``if __name__ == "__main__"``. The workers have a separate
    session, so that Ctrl-C reaches only the process that runs the batch. They are killed at the
    end, since they hold no results.
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
                processes=True,  # otherwise the scheduler would accept this process only
                host="127.0.0.1",
                dashboard_address="127.0.0.1:0",  # any free port: 8787 may be taken
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
                    f"The workers stopped: {''.join(last) or 'no message'}. Pass workers=0 to "
                    "develop the photos in this process."
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
        # -P: do not import modules from a folder of photos.
        *(sys.executable, "-P", "-m", "distributed.cli.dask_worker", address),
        *("--nworkers", str(count), "--nthreads", "1", "--memory-limit", str(memory)),
        *("--host", "127.0.0.1", "--no-dashboard", "--death-timeout", "60"),
        *("--local-directory", str(folder)),
    ]
    environment = _MEMORY | dict.fromkeys(_BLAS, threads)
    # Workers import the same sunwidget as this process, even from a checkout.
    path = os.pathsep.join(
        [str(Path(sunwidget.__file__).parents[1]), *filter(None, [os.environ.get("PYTHONPATH")])]
    )
    process = subprocess.Popen(  # noqa: S603 - no shell, and no argument comes from a photo
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
        else:  # Windows: workers exit when their parent process is gone
            process.kill()
        process.wait()


@contextlib.contextmanager
def remote_workers(scheduler: Any) -> Iterator[DaskWorkers]:
    """Connect to a scheduler by its address, a Dask cluster object or a client (not closed).

    Raises
    ------
    ConnectionError
        When no scheduler answers at the address.
    """
    from distributed import Client

    if isinstance(scheduler, Client):
        yield _ready(scheduler)
        return
    try:
        client = Client(scheduler, timeout=_ANSWER, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        raise ConnectionError(
            f"No Dask scheduler answers at {scheduler}. Start one with: dask scheduler; then "
            "start workers on each machine with: dask worker tcp://… --nthreads 1"
        ) from error
    with client:
        yield _ready(client)


def _ready(client: Any) -> DaskWorkers:
    workers = DaskWorkers(client, f"the workers of {client.scheduler.address}")
    workers.wait_for_one()
    return workers
