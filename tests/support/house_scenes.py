"""A drawn house with windows, for tests of what lights them."""

import functools

import cv2
import numpy as np
from analysis_pictures import seascape

import sunwidget as sw

SIZE = (360, 240)


def facade(size=SIZE):
    """A house before sky and sea, and which of its pixels are glass."""
    width, height = size
    picture = seascape(width, height, horizon=0.8).astype(np.float32)
    glass = np.zeros((height, width), np.uint8)
    cv2.rectangle(picture, (60, 60), (300, 230), (176, 150, 128), -1)
    for x in range(80, 290, 44):
        for y in (80, 132, 184):
            cv2.rectangle(picture, (x - 2, y - 2), (x + 22, y + 32), (225, 222, 215), -1)
            for pane in ((x, y, x + 9, y + 30), (x + 11, y, x + 20, y + 30)):
                cv2.rectangle(picture, pane[:2], pane[2:], (38, 42, 48), -1)
                cv2.rectangle(glass, pane[:2], pane[2:], 1, -1)
    soft = cv2.GaussianBlur(picture, (0, 0), 0.6)
    grain = np.random.default_rng(2).normal(0, 2, (height, width, 1))
    return np.clip(soft + grain, 0, 255).astype(np.uint8), glass > 0


@functools.cache
def house_scene():
    """The house, analysed."""
    return sw.analyze(sw.open(facade()[0]))
