"""Work behind a widget's back ends before Python does."""

import subprocess
import sys

# Torn out of OpenCV, the thread would abort the process.
SCRIPT = """
import threading
import cv2
import numpy as np
from sunwidget.widgets.kernel import background

begun = threading.Event()

def work():
    picture = np.zeros((400, 400, 3), np.float32)
    while not background.leaving():
        cv2.GaussianBlur(picture, (0, 0), 5)
        begun.set()
    print("ended")

background.start(work, name="work")
begun.wait(30)
"""


def test_a_process_ends_while_a_thread_works_in_a_library():
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT], capture_output=True, text=True, timeout=60, check=False
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "ended\n", "")
