"""Answers to the browser that are too large for one message."""

from sunwidget.widgets import requests as module
from sunwidget.widgets.requests import Requests


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
