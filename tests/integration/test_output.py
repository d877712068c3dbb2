"""What a cell's output holds, with somebody before the notebook and with nobody."""

import sys
from types import SimpleNamespace

import pytest

from sunwidget.errors import RendererError
from sunwidget.widgets.kernel import output

FLAG = "--HistoryManager.hist_file=:memory:"
NBCLIENT = ["ipykernel_launcher.py", "-f", "kernel.json", FLAG]
LAB = {"metadata": {"cellId": "1f"}}
BARE = {"metadata": {}}


@pytest.fixture
def host(monkeypatch):
    """Let this process be a kernel: ``host(arguments, request)``."""

    def become(arguments, request):
        kernel = SimpleNamespace(get_parent=lambda: request)
        monkeypatch.setattr(sys, "argv", arguments)
        monkeypatch.setattr(output, "_shell", lambda: SimpleNamespace(kernel=kernel))

    return become


def bundle():
    view = {"model_id": "7"}
    return {"text/plain": "SunEditor()", output.WIDGET_VIEW: view}, {output.WIDGET_VIEW: {}}


def test_nobody_attends_to_what_nbclient_runs(host):
    host(NBCLIENT, BARE)
    assert output.unattended()


@pytest.mark.parametrize(
    ("arguments", "request_"),
    [
        (NBCLIENT[:-1], LAB),  # JupyterLab, Notebook 7
        (NBCLIENT[:-1], BARE),  # Voilà, an older notebook, a console
        (NBCLIENT, LAB),  # a kernel that is told to keep no history, on a disk without locks
    ],
)
def test_every_other_kernel_shows_the_widget(host, arguments, request_):
    host(arguments, request_)
    assert not output.unattended()
    data, metadata = output.with_picture(bundle(), lambda: b"png")
    assert output.WIDGET_VIEW in data
    assert output.WIDGET_VIEW in metadata
    assert data["image/png"] == "cG5n"


def test_without_a_kernel_the_widget_is_shown(monkeypatch):
    monkeypatch.setattr(sys, "argv", NBCLIENT)
    assert not output.unattended()  # marimo, a script, a test


def test_for_nobody_the_picture_stands_alone(host):
    host(NBCLIENT, BARE)
    data, metadata = output.with_picture(bundle(), lambda: b"png")
    assert set(data) == {"text/plain", "image/png"}
    assert metadata == {}


def test_where_nothing_can_be_drawn_the_widget_stays(host):
    host(NBCLIENT, BARE)

    def nothing():
        raise RendererError("no EGL")

    data, _ = output.with_picture(bundle(), nothing)
    assert output.WIDGET_VIEW in data
    assert "image/png" not in data


def test_what_has_no_view_has_no_picture():
    assert output.with_picture(None, lambda: b"png") is None
