"""Requests of the browser: large answers travel in pieces, and a message may come twice."""

import threading

from sunwidget.widgets.kernel import requests as module
from sunwidget.widgets.kernel.requests import Requests


def test_a_large_answer_travels_in_pieces(monkeypatch):
    monkeypatch.setattr(module, "_MESSAGE_BYTES", 10)
    sent = []
    pieces = [b"1234", b"5678", b"90ab", b"cd"]

    def film(_content, _progress):
        return {"name": "a.mp4"}, list(pieces)

    requests = Requests(lambda content, buffers=(): sent.append((content, buffers)), {"film": film})
    requests._answer({"type": "request", "id": "a", "action": "film"})
    kinds = [content["type"] for content, _ in sent]
    assert kinds == ["piece", "response"]
    assert sent[-1][0]["result"] == {"name": "a.mp4"}
    assert b"".join(buffer for _, buffers in sent for buffer in buffers) == b"".join(pieces)
    assert max(sum(map(len, buffers)) for _, buffers in sent) <= 10


def test_small_answers_and_one_large_buffer_are_one_message(monkeypatch):
    monkeypatch.setattr(module, "_MESSAGE_BYTES", 10)
    for buffers in ([b"12", b"34"], [b"0" * 50], []):
        sent = []
        requests = Requests(
            lambda content, given=(), sent=sent: sent.append((content["type"], given)),
            {"map": lambda _content, _progress, buffers=buffers: ({}, list(buffers))},
        )
        requests._answer({"type": "request", "id": "a", "action": "map"})
        assert sent == [("response", buffers)]


def test_a_request_that_comes_twice_is_worked_on_once():
    began, go_on, sent = threading.Semaphore(0), threading.Event(), []

    def film(_content, _progress):
        began.release()
        assert go_on.wait(60)
        return {}, []

    requests = Requests(lambda content, buffers=(): sent.append(content), {"film": film})
    threads = set(threading.enumerate())
    for _ in range(2):
        requests(None, {"type": "request", "id": "a", "action": "film"}, [])
    assert began.acquire(timeout=60)
    go_on.set()
    for thread in set(threading.enumerate()) - threads:
        thread.join(60)
    assert [content["type"] for content in sent] == ["response"]
    assert not began.acquire(blocking=False)
