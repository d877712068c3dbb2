"""Nothing is fetched or sent unless a person asks for it by name."""

import socket

import numpy as np
import pytest

import sunwidget as sw
from sunwidget.cli.main import main

EDIT = sw.Edit(sun_elevation=3, place=sw.Place(41, 29, "2024-06-21", 16, 270))


@pytest.fixture
def asked(monkeypatch):
    """What asked for the network; every way to it fails."""
    calls = []

    def refuse(*arguments, **_options):
        calls.append(arguments[1:])
        raise OSError("no network")

    for name in ("connect", "connect_ex", "sendto"):
        monkeypatch.setattr(socket.socket, name, refuse)
    for name in ("getaddrinfo", "gethostbyname", "create_connection"):
        monkeypatch.setattr(socket, name, refuse)
    return calls


def test_the_fixture_hears_of_a_connection(asked):
    with pytest.raises(OSError, match="no network"):
        socket.create_connection(("127.0.0.1", 9))
    assert asked


def test_no_step_from_a_photo_to_its_exports_asks_for_the_network(asked, tmp_path):
    path = tmp_path / "photo.png"
    sw.save(np.random.default_rng(0).integers(0, 255, (24, 36, 3), np.uint8), path)
    photo = sw.open(path)
    scene = sw.analyze(photo)
    sw.render(scene, EDIT)
    sw.save((scene, EDIT), tmp_path / "still.jpg")
    sw.sweep(scene, [sw.Edit(), "sunset"], tmp_path / "film.mp4", frames=2)
    sw.contact_sheet(scene, [sw.Edit(), "sunset"], frames=2)
    sw.environment_map(scene, EDIT, tmp_path / "sky.hdr", size=(16, 8))
    sw.to_html(scene, EDIT, tmp_path / "page.html")
    sw.batch(path, EDIT, tmp_path / "batch", workers=0)
    assert asked == []


def test_no_widget_asks_for_the_network(asked, tmp_path):
    photo = sw.open(np.random.default_rng(0).integers(0, 255, (24, 36, 3), np.uint8))
    editor = sw.SunEditor(photo, recipe=EDIT).wait(60)
    editor.sun_elevation = 8
    editor.set_place(41, 29, "2024-06-21", 16, 270)
    editor.render()
    editor.save(tmp_path / "still.png")
    editor.to_html(tmp_path / "page.html")
    editor._repr_mimebundle_()
    sw.SkyExplorer().render(size=(32, 24))
    sw.Compare(editor.scene, [sw.Edit(), EDIT]).wait(60)
    assert asked == []


def test_the_doctor_asks_for_no_network(asked, capsys):
    assert main(["doctor"]) == 0
    assert "EGL" in capsys.readouterr().out
    assert asked == []
