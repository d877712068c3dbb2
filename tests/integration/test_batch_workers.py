"""A batch on Dask: real schedulers and workers in processes of their own, on loopback."""

import contextlib
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import sunwidget as sw
from sunwidget.batches import cluster
from sunwidget.batches import workers as batch_workers

pytest.importorskip("distributed")
pytestmark = pytest.mark.skipif(not hasattr(os, "killpg"), reason="processes are killed as on Unix")

LOW = sw.Edit(sun_elevation=3)

# Loaded by each worker: photos are copied in a moment, and one of them kills whoever opens it.
STAND_IN = """
import os
from sunwidget.batches import develop

def save(job, photo, path, progress):
    if photo.name == "poison.png":
        os._exit(1)
    path.write_bytes(photo.read_bytes())
    return ()

develop._save = save
"""


@contextlib.contextmanager
def process(folder, *arguments):
    """A process of Dask's command line; what it says is in a file."""
    with (folder / "words.txt").open("ab") as words:
        running = subprocess.Popen(
            [sys.executable, "-m", *arguments], stdout=words, stderr=words, cwd=folder
        )
    try:
        yield running
    finally:
        running.kill()
        running.wait()


@contextlib.contextmanager
def loopback(folder):
    """A scheduler and two workers: its address and the workers' processes."""
    found = folder / "scheduler.json"
    scheduler = ("distributed.cli.dask_scheduler", "--port", "0", "--host", "127.0.0.1")
    worker = ("distributed.cli.dask_worker", "--scheduler-file", str(found), "--nthreads", "1")
    with contextlib.ExitStack() as stack:
        stack.enter_context(
            process(folder, *scheduler, "--no-dashboard", "--scheduler-file", str(found))
        )
        workers = [
            stack.enter_context(process(folder, *worker, "--no-nanny", "--no-dashboard"))
            for _ in range(2)
        ]
        from distributed import Client

        while not found.exists():
            time.sleep(0.05)
        with Client(scheduler_file=str(found)) as client:
            client.wait_for_workers(2, timeout=120)
            address = client.scheduler.address
        yield address, workers


def photos_in(folder, count):
    folder.mkdir()
    coast = sw.sample("coast").preview(64)
    for i in range(count):
        Image.fromarray(np.roll(coast, i, axis=1)).save(folder / f"{i}.png")
    return [folder / f"{i}.png" for i in range(count)]


def in_group(group):
    """The processes of a group that still run."""
    import psutil  # comes with distributed

    found = []
    for running in psutil.process_iter(["status"]):
        with contextlib.suppress(ProcessLookupError):
            if os.getpgid(running.pid) == group and running.info["status"] != "zombie":
                found.append(running)
    return found


@pytest.mark.timeout(600)  # three processes that each compile the shaders, on a busy machine
def test_every_photo_comes_out_once_though_a_worker_is_killed(tmp_path, monkeypatch):
    photos = photos_in(tmp_path / "photos", 5)
    # A path that leads elsewhere in each process: the workers are sent the photo's bytes.
    monkeypatch.chdir(tmp_path / "photos")
    photos[4] = Path("/proc/self/cwd/4.png") if Path("/proc/self/cwd").exists() else photos[4]
    told, killed = [], []
    with loopback(tmp_path) as (address, workers):

        def kill_one(fraction, message):
            told.append((fraction, message))
            if len(told) == 2:  # of five; each worker has one photo in hand
                workers[0].send_signal(signal.SIGKILL)
                killed.append(workers[0].wait())

        report = sw.batch(photos, LOW, tmp_path / "out", scheduler=address, progress=kill_one)
    assert killed == [-signal.SIGKILL]
    assert [row.state for row in report] == ["done"] * 5, report
    assert len(told) == 5
    assert told[-1][0] == 1
    pids = {int(row.worker.split(":")[1]) for row in report}
    assert pids == {worker.pid for worker in workers}
    names = sorted(p.name for p in (tmp_path / "out").iterdir())
    assert names == [".sunwidget-batch.jsonl", *(f"{i}-sun.png" for i in range(5))]
    # The same bytes as from a plain run in this process.
    plain = sw.batch(photos, LOW, tmp_path / "plain", workers=0)
    assert len(plain.done) == 5
    for row, other in zip(report, plain, strict=True):
        assert row.output.read_bytes() == other.output.read_bytes(), row.photo
    again = sw.batch(photos, LOW, tmp_path / "out", scheduler="tcp://127.0.0.1:1")
    assert len(again.skipped) == 5  # so the scheduler that is gone was not even asked


def test_a_photo_that_kills_its_workers_is_given_up_and_the_rest_done(tmp_path, monkeypatch):
    (tmp_path / "stand_in.py").write_text(STAND_IN)
    monkeypatch.setenv("DASK_DISTRIBUTED__WORKER__PRELOAD", str(tmp_path / "stand_in.py"))
    photos = photos_in(tmp_path / "photos", 5)
    photos.insert(1, photos[0].rename(tmp_path / "photos/poison.png"))
    report = sw.batch(photos[1:], LOW, tmp_path / "out", workers=2, retries=0)
    assert [row.state for row in report] == ["failed", *["done"] * 4], report
    assert "worker died" in report.failed[0].error
    assert report.where == "2 worker processes"
    assert not any("poison" in p.name for p in (tmp_path / "out").iterdir())


def test_a_stopped_batch_ends_its_workers(tmp_path, monkeypatch):
    (tmp_path / "stand_in.py").write_text(STAND_IN)
    monkeypatch.setenv("DASK_DISTRIBUTED__WORKER__PRELOAD", str(tmp_path / "stand_in.py"))
    photos = photos_in(tmp_path / "photos", 4)
    started = []
    begin = subprocess.Popen

    def popen(*arguments, **options):
        started.append(begin(*arguments, **options))
        return started[-1]

    monkeypatch.setattr(subprocess, "Popen", popen)

    def stop(fraction, message):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sw.batch(photos, LOW, tmp_path / "out", workers=1, progress=stop)
    (workers,) = started
    assert workers.poll() is not None
    end = time.monotonic() + 10
    while left := in_group(workers.pid):  # nor any process that it started
        assert time.monotonic() < end, left
        time.sleep(0.05)
    assert len(list((tmp_path / "out").glob("*.png"))) == 1


def test_a_scheduler_that_does_not_answer_is_named(tmp_path, monkeypatch):
    monkeypatch.setattr(cluster, "_ANSWER", 0.5)
    photos = photos_in(tmp_path / "photos", 1)
    with pytest.raises(ConnectionError, match="No Dask scheduler answers at tcp://127.0.0.1:1"):
        sw.batch(photos, LOW, tmp_path / "out", scheduler="tcp://127.0.0.1:1")


def test_a_scheduler_without_workers_is_named(tmp_path, monkeypatch):
    from distributed import LocalCluster

    monkeypatch.setattr(batch_workers, "PATIENCE", 0.5)
    photos = photos_in(tmp_path / "photos", 1)
    with (
        LocalCluster(n_workers=0, processes=True, dashboard_address="127.0.0.1:0") as empty,
        pytest.raises(TimeoutError, match=r"has had no worker .* dask worker tcp://"),
    ):
        sw.batch(photos, LOW, tmp_path / "out", scheduler=empty)
