"""The function ``batch``: selects the photos, assigns them to workers and collects results."""

from __future__ import annotations

import contextlib
import os
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from sunwidget.batches import photos as photo_files
from sunwidget.batches.develop import Job, Outcome, sentence
from sunwidget.batches.record import Record, recipe_key
from sunwidget.batches.report import BatchReport, BatchRow
from sunwidget.batches.request import Request, check_endings, check_request, check_whole
from sunwidget.batches.workers import ThisProcess, Workers, has_dask, require_dask
from sunwidget.files import complete_or_absent, explain_write_errors, folder_target
from sunwidget.progress import with_time_left


def batch(
    photos: Any,
    edit: Any,
    out: str | os.PathLike[str],
    *,
    scheduler: Any = None,
    workers: int | None = None,
    analysis: dict[str, Any] | None = None,
    format: str | None = None,  # noqa: A002 - the usual word
    name: str = "{name}-sun",
    long_edge: int | None = None,
    corrections: bool = False,
    overwrite: bool = False,
    resume: bool = True,
    retries: int = 2,
    progress: Callable[[float, str], object] | None = None,
    **options: Any,
) -> BatchReport:
    """Move the sun in many photos. A failed photo is reported; the others are still written.

    Parameters
    ----------
    photos : path, pattern, folder, or list of these
        ``"photos/*.jpg"``, ``"photos/**/*.jpg"``, ``"photos"``.
    edit : Edit, dict, path or str
        An edit, a recipe (``Edit.to_dict``), a recipe file (JSON), or the name of a preset.
    out : path
        Output folder; created if missing.
    scheduler : str or distributed.Client, optional
        Address of a Dask scheduler, ``"tcp://…"``. Default: worker processes on this machine.
    workers : int, optional
        Worker processes on this machine; 0 develops one photo after another in this process.
        Default: one per core, with at least 2 GB of memory each; 0 without Dask.
    analysis : dict, optional
        Arguments of ``analyze`` for every photo, such as ``{"fov": 38}``.
    format : str, optional
        "png", "jpg", "tif" … Default: the photo's own; TIFF if that cannot be written.
    name : str
        Template of the file name without its extension, from ``{name}``, ``{folder}`` (name of the
        photo's folder), ``{number}`` (from 1; ``{number:04}`` pads it) and ``{ending}`` (the
        photo's extension).
    long_edge : int, optional
        Limit of the longer side in pixels. Default: the photo's own size.
    corrections : bool
        Also apply the recipe's strokes and hints, for a series from one fixed camera. They are
        made for one photo.
    overwrite : bool
        Replace files that no batch wrote or that were changed since.
    resume : bool
        Skip photos whose picture by the same recipe exists. A picture of another recipe or photo
        is replaced if a batch wrote it and it is unchanged.
    retries : int
        Number of further workers that try a photo after its worker dies.
    progress : callable, optional
        Called as ``progress(fraction, message)``. An exception from it stops the batch.
    **options
        Further arguments of ``save``: ``quality``, ``bit_depth`` …

    Returns
    -------
    BatchReport
        A row for each photo, in the order of ``photos``.

    Raises
    ------
    FileNotFoundError
        When no photo is found, or the parent folder of ``out`` is missing.
    EditError, ValueError, TypeError
        For an unusable recipe or argument, before any work.
    ModuleNotFoundError
        When workers are requested without the ``batch`` extra.
    RendererError, RuntimeError
        When this machine or a worker cannot render, or a worker has another version.
    ConnectionError, TimeoutError
        When the scheduler or all of its workers are lost. As after Ctrl-C, only complete pictures
        remain, and the same call resumes the batch.

    Examples
    --------
    >>> report = sw.batch("photos/*.jpg", sw.Edit(sun_elevation=3), "out", format="png")
    >>> report.failed
    """
    begin = time.perf_counter()
    request = check_request(edit, analysis, options, long_edge, corrections=corrections)
    check_whole("workers", workers, 0)
    check_whole("retries", retries, 0)
    if workers or scheduler is not None:
        require_dask()
    if workers is not None and scheduler is not None:
        raise ValueError(
            "Pass workers= (processes on this machine) or scheduler=, which has its own workers."
        )
    folder = _folder(out)
    record = Record(folder)
    found = [photo for photo in photo_files.find(photos) if not record.has_made(photo)]
    outputs = photo_files.names(found, name, format)
    check_endings(outputs, request)
    run = _Run(found, outputs, request, record, overwrite, resume, progress)
    with contextlib.ExitStack() as stack:
        jobs = run.jobs()
        # Starting a worker takes seconds, so start workers only if there is a job.
        first = next(jobs, None)
        where = ""
        if first is not None:
            pool = stack.enter_context(_workers(run, scheduler, workers, retries))
            where = pool.text
            for outcome in pool.outcomes(_chained(first, jobs)):
                run.finish(outcome)
    return BatchReport(tuple(run.rows[i] for i in range(len(found))), _since(begin), where)


class _Run:
    """One batch: its pending photos, and the report rows of the others."""

    def __init__(
        self,
        photos: list[Path],
        outputs: list[str],
        request: Request,
        record: Record,
        overwrite: bool,
        resume: bool,
        progress: Callable[[float, str], object] | None,
    ) -> None:
        self.photos = photos
        self.outputs = outputs
        self.request = request
        self.recipe = recipe_key(request)
        self.record = record
        self.overwrite = overwrite
        self.resume = resume
        self.rows: dict[int, BatchRow] = {}
        self._digests: dict[int, str] = {}
        self._report = with_time_left(progress)

    @property
    def left(self) -> int:
        """Number of photos without a row."""
        return len(self.photos) - len(self.rows)

    def jobs(self) -> Iterator[Job]:
        """Yield a job for each pending photo; add the rows of the others."""
        for number, (photo, output) in enumerate(zip(self.photos, self.outputs, strict=True)):
            try:
                job = self._job(number, photo, output)
            except OSError as error:
                reason = f"Cannot read {photo}: {error.strerror or error}."
                if isinstance(error, FileNotFoundError):
                    reason = f"There is no file {photo}."
                self._row(number, BatchRow(photo, None, "failed", error=reason))
            else:
                if job is not None:
                    yield job

    def _job(self, number: int, photo: Path, output: str) -> Job | None:
        place = self.record.folder / output
        digest = self.record.digest(photo)
        if self.resume and self.record.is_done(output, digest, self.recipe):
            self._row(number, BatchRow(photo, place, "skipped"))
            return None
        if place.exists():
            if place.samefile(photo):
                error = f"{place} is the photo itself. Choose another folder or name."
                self._row(number, BatchRow(photo, None, "failed", error=error))
                return None
            if not (self.overwrite or self.record.is_own(output)):
                error = (
                    f"{place} exists already and was not written by a batch, or was changed since. "
                    "Pass overwrite=True to replace it."
                )
                self._row(number, BatchRow(photo, None, "failed", error=error))
                return None
        self._digests[number] = digest
        return Job(number, str(photo), digest, output, self.request)

    def finish(self, outcome: Outcome) -> None:
        """Write the files of a photo, record it, and add its row."""
        photo, output = self.photos[outcome.number], self.outputs[outcome.number]
        error = outcome.error
        if not error:
            try:
                with explain_write_errors(self.record.folder / output):
                    self._write(outcome)
            except OSError as wrong:
                error = sentence(wrong)
        row = BatchRow(
            photo,
            None if error else self.record.folder / output,
            "failed" if error else "done",
            outcome.seconds,
            error,
            outcome.worker,
            outcome.notes,
        )
        self._row(outcome.number, row)

    def _write(self, outcome: Outcome) -> None:
        number = outcome.number
        written: list[Path] = []
        try:
            for name, data in outcome.files.items():
                place = self.record.folder / name
                place.parent.mkdir(parents=True, exist_ok=True)
                overwrite = self.overwrite or self.record.is_own(name)
                with complete_or_absent(place, overwrite=overwrite) as unfinished:
                    unfinished.write_bytes(data)
                written.append(place)
            self.record.add(
                self.outputs[number],
                self.photos[number],
                self._digests[number],
                self.recipe,
                outcome.files,
            )
        except OSError:
            # The next run would not recognize files that are missing from the record.
            for place in written:
                place.unlink(missing_ok=True)
            raise

    def _row(self, number: int, row: BatchRow) -> None:
        self.rows[number] = row
        total = len(self.photos)
        failed = sum(row.state == "failed" for row in self.rows.values())
        words = f"{len(self.rows)} of {total} photos" + (f", {failed} failed" if failed else "")
        self._report(len(self.rows) / total, words)

    def within(self, fraction: float, _message: str) -> None:
        """Report progress within the photo that this process is developing."""
        done, total = len(self.rows), len(self.photos)
        self._report((done + min(fraction, 0.99)) / total, f"{done} of {total} photos")


def _folder(out: str | os.PathLike[str]) -> Path:
    folder = Path(os.path.abspath(folder_target(out)))  # noqa: PTH100 - links stay links
    folder.mkdir(exist_ok=True)
    return folder


@contextlib.contextmanager
def _workers(run: _Run, scheduler: Any, workers: int | None, retries: int) -> Iterator[Workers]:
    if scheduler is not None:
        from sunwidget.batches.cluster import remote_workers

        with remote_workers(scheduler) as pool:
            yield pool
        return
    if workers is None:
        from sunwidget.batches.cluster import default_workers

        workers = default_workers(run.left) if has_dask() and run.left > 1 else 0
    if not workers:
        yield ThisProcess(run.within)
        return
    from sunwidget.batches.cluster import local_workers

    with local_workers(min(workers, run.left), deaths=retries) as pool:
        yield pool


def _chained(first: Job, rest: Iterator[Job]) -> Iterator[Job]:
    yield first
    yield from rest


def _since(begin: float) -> float:
    return time.perf_counter() - begin
