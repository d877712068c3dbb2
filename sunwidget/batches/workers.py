"""Workers that develop the photos of a batch: this process, or those of a Dask scheduler."""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError
from pathlib import Path
from typing import Any, Protocol

from sunwidget.batches.develop import Job, Outcome, develop, sentence
from sunwidget.photo.decode_apart import keep_process
from sunwidget.version import __version__

# Seconds to wait for the first worker, and for a new one when all are gone.
PATIENCE = 60.0
# Seconds between checks that there are workers while waiting for a result.
_BEAT = 1.0

_NO_DASK = (
    "Several workers need Dask: pip install 'sunwidget[batch]'. Without Dask pass workers=0 to "
    "develop one photo after another in this process."
)


class Workers(Protocol):
    """Develops jobs in any order; ``text`` is the place shown in the report."""

    text: str

    def outcomes(self, jobs: Iterator[Job]) -> Iterator[Outcome]:
        """Take jobs as workers become free and yield their outcomes."""


class ThisProcess:
    """Develops one photo after another in this process."""

    text = "this process"

    def __init__(self, progress: Callable[[float, str], object] | None = None) -> None:
        self.progress = progress

    def outcomes(self, jobs: Iterator[Job]) -> Iterator[Outcome]:
        """Yield the outcome of each job in turn; report progress within each photo."""
        with keep_process():
            for job in jobs:
                outcome = develop(job, self.progress)
                if outcome.unreadable:  # it changed between two reads
                    changed = f"{job.path} was removed or changed while it was read."
                    error = f"{changed} Run the batch again."
                    outcome = Outcome(job.number, error=error, worker=outcome.worker)
                yield outcome


def has_dask() -> bool:
    """Return whether the ``batch`` extra is installed."""
    try:
        import distributed  # noqa: F401
    except ImportError:
        return False
    return True


def require_dask() -> None:
    """Raise ModuleNotFoundError, with the remedy, if Dask is missing."""
    if not has_dask():
        raise ModuleNotFoundError(_NO_DASK)


class DaskWorkers:
    """The workers of a Dask scheduler.

    Parameters
    ----------
    client : distributed.Client
    text : str
        Their place, for the report.
    threads : int or None
        Threads of a worker's libraries; None: as many as Dask assigned to the worker.
    alive : callable, optional
        Called while waiting; raises if no worker can appear any more.
    """

    def __init__(
        self,
        client: Any,
        text: str,
        threads: int | None = None,
        alive: Callable[[], None] | None = None,
    ) -> None:
        self.client = client
        self.text = text
        self.threads = threads
        self.alive = alive
        self._last_seen = time.monotonic()

    def count(self) -> int:
        """Return the current number of workers."""
        return len(self.client.scheduler_info(n_workers=-1)["workers"])

    def wait_for_one(self) -> None:
        """Wait for the first worker.

        Raises
        ------
        TimeoutError
            When no worker appears within a minute.
        """
        while not self.count():
            self._check_patience()
            time.sleep(0.1)
        self._last_seen = time.monotonic()

    def outcomes(self, jobs: Iterator[Job]) -> Iterator[Outcome]:
        """Yield outcomes as they arrive; another worker takes over a photo whose worker died.

        A photo on which as many workers died as the scheduler allows (``allowed-failures``) may not
        be the cause, since workers hold several. It is tried once more, alone, at the end.
        """
        suspects: list[Job] = []
        yield from self._outcomes(jobs, suspects.append)
        for job in suspects:
            again: list[Job] = []
            yield from self._outcomes(iter([job]), again.append)
            for failed in again:
                error = (
                    "Its worker died at every attempt: the photo may need more memory than a "
                    "worker has. Try it alone with workers=0, or with fewer workers."
                )
                yield Outcome(failed.number, error=error)

    def _outcomes(self, jobs: Iterator[Job], suspect: Callable[[Job], object]) -> Iterator[Outcome]:
        from distributed import KilledWorker

        from sunwidget.errors import RendererError

        pending: dict[Any, Job] = {}
        try:
            while True:
                self._fill(pending, jobs)
                if not pending:
                    return
                for future in self._finished(pending):
                    job = pending.pop(future)
                    try:
                        outcome: Outcome = future.result()
                    except KilledWorker:
                        suspect(job)
                        continue
                    except RendererError:
                        raise
                    except (OSError, CancelledError) as error:
                        raise _connection_error(error) from error
                    except Exception as error:
                        raise RuntimeError(
                            f"A worker failed: {sentence(error)}. Install sunwidget "
                            f"{__version__} with its batch extra on every machine."
                        ) from error
                    finally:
                        future.release()
                    if outcome.unreadable:
                        outcome = self._send(job, pending, outcome)
                        if outcome.unreadable:
                            continue
                    yield outcome
        finally:
            if pending:
                self.client.cancel(list(pending))

    def _fill(self, pending: dict[Any, Job], jobs: Iterator[Job]) -> None:
        """Submit one photo more than there are workers, so that all are busy and few wait."""
        while len(pending) < self.count() + 1:
            job = next(jobs, None)
            if job is None:
                return
            self._submit(dataclasses.replace(job, threads=self.threads), pending)

    def _submit(self, job: Job, pending: dict[Any, Job]) -> None:
        import dask

        # The task holds the photo's bytes on purpose: they outlive any worker.
        with dask.config.set({"distributed.admin.large-graph-warning-threshold": "1 TB"}):
            pending[self.client.submit(develop_here, job, pure=False)] = job

    def _send(self, job: Job, pending: dict[Any, Job], outcome: Outcome) -> Outcome:
        """Submit the job with the photo's bytes; return an error if they cannot be read."""
        if job.data is None:
            try:
                data = Path(job.path).read_bytes()
            except OSError as error:
                return Outcome(job.number, error=f"Cannot read {job.path}: {error.strerror}.")
            self._submit(dataclasses.replace(job, data=data), pending)
        return outcome

    def _finished(self, pending: dict[Any, Job]) -> set[Any]:
        from distributed import wait

        while True:
            try:
                with self.client.as_current():  # the caller's own client stays the default
                    done: set[Any] = wait(
                        list(pending), timeout=_BEAT, return_when="FIRST_COMPLETED"
                    ).done
            except TimeoutError:
                if self.client.status not in {"running", "connecting"}:
                    raise _connection_error(None) from None
                if self.count():
                    self._last_seen = time.monotonic()
                self._check_patience()
            except Exception as error:
                raise _connection_error(error) from error
            else:
                self._last_seen = time.monotonic()
                return done

    def _check_patience(self) -> None:
        if self.alive is not None:
            self.alive()
        if time.monotonic() - self._last_seen > PATIENCE:
            raise TimeoutError(
                f"{self.client.scheduler.address} has had no worker for {PATIENCE:.0f} s. Start "
                f"workers with: dask worker {self.client.scheduler.address} --nthreads 1. Then "
                "run the batch again to resume it."
            )


def develop_here(job: Job) -> Outcome:
    """Develop on a Dask worker, with the worker's number of threads."""
    if job.threads is None:
        from distributed import get_worker

        job = dataclasses.replace(job, threads=get_worker().state.nthreads)
    return develop(job)


def _connection_error(error: BaseException | None) -> ConnectionError:
    reason = f" ({type(error).__name__}: {error})" if error is not None else ""
    return ConnectionError(
        f"The connection to the Dask scheduler was lost{reason}. Finished pictures are kept; run "
        "the batch again to resume it."
    )
