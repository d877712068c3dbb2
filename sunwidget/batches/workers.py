"""Who develops the photos of a batch: this process, or the workers of a Dask scheduler."""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError
from pathlib import Path
from typing import Any, Protocol

from sunwidget.batches.develop import Job, Outcome, develop, sentence
from sunwidget.photo.decode_apart import kept
from sunwidget.version import __version__

# How long to wait for the first worker, and for one to come back when all are gone.
PATIENCE = 60.0
# How often the wait for a result looks whether anybody works at all.
_BEAT = 1.0

_NO_DASK = (
    "Several workers need Dask: pip install 'sunwidget[batch]'. Without it pass workers=0, which "
    "does one photo after another in this process."
)


class Workers(Protocol):
    """Develops jobs, in any order; ``text`` says where, for the report."""

    text: str

    def outcomes(self, jobs: Iterator[Job]) -> Iterator[Outcome]:
        """Take jobs as there is room for them, and yield what became of each."""


class ThisProcess:
    """One photo after another, here."""

    text = "this process"

    def __init__(self, progress: Callable[[float, str], object] | None = None) -> None:
        self.progress = progress

    def outcomes(self, jobs: Iterator[Job]) -> Iterator[Outcome]:
        """Yield the outcome of each job in turn; ``progress`` hears of the parts of a photo."""
        with kept():
            for job in jobs:
                outcome = develop(job, self.progress)
                if outcome.unseen:  # it changed between the two times it was read
                    changed = f"{job.path} was removed or changed while it was read."
                    error = f"{changed} Run the batch again."
                    outcome = Outcome(job.number, error=error, worker=outcome.worker)
                yield outcome


def has_dask() -> bool:
    """Whether the ``batch`` extra is installed."""
    try:
        import distributed  # noqa: F401
    except ImportError:
        return False
    return True


def require_dask() -> None:
    """Raise ModuleNotFoundError, saying what to install, when Dask is missing."""
    if not has_dask():
        raise ModuleNotFoundError(_NO_DASK)


class DaskWorkers:
    """The workers of a scheduler that runs somewhere.

    Parameters
    ----------
    client : distributed.Client
    text : str
        Where they are, for the report.
    threads : int or None
        Threads for a worker's libraries; None: as many as Dask gave the worker.
    alive : callable, optional
        Called while waiting; raises when the workers cannot come (any more).
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
        """Return how many workers there are now."""
        return len(self.client.scheduler_info(n_workers=-1)["workers"])

    def wait_for_one(self) -> None:
        """Wait for the first worker.

        Raises
        ------
        TimeoutError
            When none comes within a minute.
        """
        while not self.count():
            self._check_patience()
            time.sleep(0.1)
        self._last_seen = time.monotonic()

    def outcomes(self, jobs: Iterator[Job]) -> Iterator[Outcome]:
        """Yield outcomes as they come; a photo whose worker died is done by another one.

        A photo that took down as many workers as the scheduler allows (``allowed-failures``) may
        only have stood beside the guilty one, so it is tried once more, alone, at the end.
        """
        condemned: list[Job] = []
        yield from self._outcomes(jobs, condemned.append)
        for job in condemned:
            again: list[Job] = []
            yield from self._outcomes(iter([job]), again.append)
            for poison in again:
                error = (
                    "Its worker died each time it was tried: the photo may need more memory than "
                    "a worker has. Try it alone with workers=0, or with fewer workers."
                )
                yield Outcome(poison.number, error=error)

    def _outcomes(self, jobs: Iterator[Job], condemn: Callable[[Job], object]) -> Iterator[Outcome]:
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
                        condemn(job)
                        continue
                    except RendererError:
                        raise
                    except (OSError, CancelledError) as error:
                        raise _lost(error) from error
                    except Exception as error:
                        raise RuntimeError(
                            f"A worker cannot work: {sentence(error)}. Install sunwidget "
                            f"{__version__} with its batch extra on every machine."
                        ) from error
                    finally:
                        future.release()
                    if outcome.unseen:
                        outcome = self._send(job, pending, outcome)
                        if outcome.unseen:
                            continue
                    yield outcome
        finally:
            if pending:
                self.client.cancel(list(pending))

    def _fill(self, pending: dict[Any, Job], jobs: Iterator[Job]) -> None:
        """Submit one photo more than there are workers: all are busy, and few wait in memory."""
        while len(pending) < self.count() + 1:
            job = next(jobs, None)
            if job is None:
                return
            self._submit(dataclasses.replace(job, threads=self.threads), pending)

    def _submit(self, job: Job, pending: dict[Any, Job]) -> None:
        import dask

        # A photo's bytes inside its task outlive any worker: that is meant, not an oversight.
        with dask.config.set({"distributed.admin.large-graph-warning-threshold": "1 TB"}):
            pending[self.client.submit(develop_here, job, pure=False)] = job

    def _send(self, job: Job, pending: dict[Any, Job], outcome: Outcome) -> Outcome:
        """Submit the job with the photo's bytes; return an error where they cannot be read."""
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
                with self.client.as_current():  # a person's own client stays the default one
                    done: set[Any] = wait(
                        list(pending), timeout=_BEAT, return_when="FIRST_COMPLETED"
                    ).done
            except TimeoutError:
                if self.client.status not in {"running", "connecting"}:
                    raise _lost(None) from None
                if self.count():
                    self._last_seen = time.monotonic()
                self._check_patience()
            except Exception as error:
                raise _lost(error) from error
            else:
                self._last_seen = time.monotonic()
                return done

    def _check_patience(self) -> None:
        if self.alive is not None:
            self.alive()
        if time.monotonic() - self._last_seen > PATIENCE:
            raise TimeoutError(
                f"{self.client.scheduler.address} has had no worker for {PATIENCE:.0f} s. Start "
                f"some with: dask worker {self.client.scheduler.address} --nthreads 1. Run the "
                "batch again to go on; what is done stays done."
            )


def develop_here(job: Job) -> Outcome:
    """Develop on a Dask worker, with as many threads as it was given."""
    if job.threads is None:
        from distributed import get_worker

        job = dataclasses.replace(job, threads=get_worker().state.nthreads)
    return develop(job)


def _lost(error: BaseException | None) -> ConnectionError:
    reason = f" ({type(error).__name__}: {error})" if error is not None else ""
    return ConnectionError(
        f"The Dask scheduler was lost{reason}. What is done stays done: run the batch again "
        "to go on."
    )
