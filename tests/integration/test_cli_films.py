"""What ``sunwidget sweep`` and ``timelapse`` refuse in a line, before a photo is opened."""

import pytest

from sunwidget.cli.main import main


def refusal(capsys, *arguments):
    """Run a command that must fail; return the one line that it says."""
    try:
        status = main(list(arguments))
    except SystemExit as stop:
        status = stop.code
    said = capsys.readouterr().err
    assert status == 2
    assert said.count("\n") == 1
    return said


@pytest.mark.parametrize(
    ("flags", "says"),
    [
        ("--steps dawn sunset --to-sun-elevation 3", "--steps and --to-… both set the film"),
        ("--key-frame 0:dawn --key-frame 2:sunset --to-time 17:00", "--key-frame and --to-…"),
        ("--day --sun-elevation 3", "The clock moves the sun"),
        ("--to-time 17:00 --to-sun-azimuth 3", "The clock moves the sun"),
        ("--sun-elevation 3 --to-sun-elevation 3", "Nothing moves"),
        ("--steps dawn sunset --day", "not allowed with"),
        ("--frames 3 --seconds 2 --to-exposure 1", "not allowed with"),
        ("--key-frame soon:sunset", "is not of the form 2.5:"),
        ("--key-frame 2:sun_elevation=low", "is not of the form 2.5:"),
        ("--key-frame 2:method=thesis", "is not a number, so it cannot change"),
        ("--key-frame 2:sun_elevatoin=3", "sun_elevation"),
        ("--size 1920", "is not of the form 1920x1080"),
        ("--loop there", "invalid choice"),
        ("--easing bouncy", "invalid choice"),
    ],
)
def test_a_sweep_that_contradicts_itself_is_refused(capsys, tmp_path, flags, says):
    out = tmp_path / "film.gif"
    assert says in refusal(capsys, "sweep", "sample:coast", "-o", str(out), *flags.split())
    assert not out.exists()


@pytest.mark.parametrize(
    ("flags", "says"),
    [
        ("--steps dawn", "needs two or more"),
        ("--steps dawn sunset --sun-elevation 3", "Leave out the other parameter flags"),
        ("--steps dawn sunset --preset dawn", "Leave out the other parameter flags"),
        ("--preset dawn --exposure 1", "excludes other parameters"),
        ("--heading 30", "--heading needs --place"),
        ("--start 2024-06-21T17:30", "--start and --interval go together"),
        ("--interval 30", "--start and --interval go together"),
        ("--start 2024-06-21T17:30 --interval 30 --times %Y", "Leave one out"),
        ("--start noon --interval 30", "is not of the form 2024-06-21T17:30"),
        ("--place here", "is not latitude,longitude"),
        ("--broken mend", "invalid choice"),
        ("--loop there_and_back", "invalid choice"),
    ],
)
def test_a_time_lapse_that_contradicts_itself_is_refused(capsys, tmp_path, flags, says):
    out = tmp_path / "film.gif"
    assert says in refusal(capsys, "timelapse", str(tmp_path), "-o", str(out), *flags.split())
    assert not out.exists()
