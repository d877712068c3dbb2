"""Façades with windows drawn by seed, in perspective before real photos, and what is glass.

Panes are simple things in endless variety, so they can be drawn; what is no pane is everything
that photos of nature show, and walls with doors, signs and trunks. Photographed façades are set up
alike where there are some, and their windows in drawn walls.
"""

from __future__ import annotations

import cv2
import numpy as np

from training.buildings import colour, corners
from training.windows.facades import Facades

Random = np.random.Generator
SIDE = 384
"""Pixels of a façade before it is set up in perspective."""
GLASS, OPENING, GLASS_UNKNOWN, OPENING_UNKNOWN = range(4)
"""Layers of what is known of a picture, each in [0, 1]: panes; windows with frames and bars."""
LAYERS = 4
REAL_WALLS, REAL_WINDOWS = 0.5, 0.4  # shares, where photographed façades are given


def noise(random: Random, cells: int, size: int = SIDE) -> np.ndarray:
    """Smooth noise of deviation 1, (S, S) float32."""
    grid = random.normal(0, 1, (cells, cells)).astype(np.float32)
    return cv2.resize(grid, (size, size), interpolation=cv2.INTER_CUBIC)


def wall(random: Random) -> np.ndarray:
    """Plaster, brick, panels or timber, (S, S, 3) float32 in [0, 255]."""
    tone = colour(random, 40, 245, 0.15)
    if random.random() < 0.35:  # brick, ochre, wood
        tone = tone * np.array([1.0, random.uniform(0.55, 0.9), random.uniform(0.35, 0.8)])
    grain = sum(
        random.uniform(0, 0.08) * noise(random, int(random.integers(3, 192))) for _ in range(3)
    )
    picture = tone * (1 + grain[..., None])
    draw = random.random()
    if draw < 0.45:  # courses of bricks, boards or panels
        step = int(random.integers(3, 40))
        line = random.uniform(0.6, 1.25)
        if random.random() < 0.7:
            picture[:: max(step, 2)] *= line
        if random.random() < 0.5:
            picture[:, :: max(2, int(step * random.uniform(1, 3)))] *= line
    elif draw < 0.7:  # weatherboards, clapboard, louvres: each lit and shaded alike
        across = np.arange(SIDE) / random.uniform(4, 40) % 1
        board = 1 + random.uniform(-0.3, 0.3) * (across - 0.5)
        board[across < random.uniform(0.05, 0.25)] *= random.uniform(0.3, 0.9)
        picture *= board[:, None, None] if random.random() < 0.7 else board[None, :, None]
    return picture


def glass(random: Random, height: int, width: int, mirrors: bool) -> np.ndarray:
    """What a pane shows: a dark room, the sky's or the street's image, curtains; (h, w, 3)."""
    y = np.linspace(0, 1, height)[:, None, None]
    if mirrors:
        top, foot = colour(random, 90, 245, 0.12), colour(random, 15, 200, 0.15)
    else:
        top, foot = colour(random, 3, 90, 0.2), colour(random, 3, 90, 0.2)
    pane = np.broadcast_to(top * (1 - y) + foot * y, (height, width, 3)).copy()
    if random.random() < 0.4:  # blotches of a mirrored street
        cells = (int(random.integers(1, 6)), int(random.integers(1, 6)))
        spots = cv2.resize(random.normal(0, 0.35, cells), (width, height))
        pane *= np.exp(spots.reshape(height, width, 1))
    draw = random.random()
    cloth = colour(random, 90, 235, 0.08)
    if draw < 0.18:  # curtains at the sides
        part = max(1, int(width * random.uniform(0.12, 0.4)))
        pane[:, :part] = pane[:, -part:] = cloth * random.uniform(0.4, 1)
    elif draw < 0.32:  # a blind
        pane[: max(1, int(height * random.uniform(0.15, 0.9)))] = cloth * random.uniform(0.4, 1)
    return pane


def window(
    picture: np.ndarray, mask: np.ndarray, box: tuple[int, int, int, int], style: dict[str, float]
) -> None:
    """One window in its wall, both in place; ``box`` is left, top, right, bottom."""
    random = style["random"]
    x0, y0, x1, y1 = box
    frame = style["frame"]
    edge = max(0, round(style["edge"] * (x1 - x0)))
    tone = style["tone"]
    if style["surround"]:
        b = max(1, round(0.12 * (x1 - x0)))
        cv2.rectangle(picture, (x0 - b, y0 - b), (x1 + b, y1 + b), style["trim"], -1)
    cv2.rectangle(picture, (x0, y0), (x1, y1), tone, -1)
    gx0, gy0, gx1, gy1 = x0 + edge, y0 + edge, x1 - edge, y1 - edge
    if gx1 - gx0 < 2 or gy1 - gy0 < 2:
        return
    if style["real"] is not None:
        photo = cv2.resize(
            style["real"].window(random), (x1 - x0, y1 - y0), None, 0, 0, cv2.INTER_AREA
        )
        picture[y0:y1, x0:x1] = photo * style["tint"]
        mask[y0:y1, x0:x1] = (0, 1, 1, 0)
        return
    if random.random() < style["shut"]:  # shutters are closed: no glass
        for y in range(y0, y1, 3):
            cv2.line(picture, (x0, y), (x1, y), (np.array(tone) * 0.8).tolist(), 1)
        return
    pane = glass(random, gy1 - gy0, gx1 - gx0, random.random() < style["mirrors"])
    shape = np.ones((gy1 - gy0, gx1 - gx0), np.float32)
    bars = np.ones_like(shape)
    if style["arch"]:
        shape[:] = 0
        r = (gx1 - gx0) // 2
        cv2.ellipse(shape, (r, min(r, gy1 - gy0)), (r, r), 0, 180, 360, 1, -1)
        shape[min(r, gy1 - gy0) :] = 1
    for i in range(1, int(style["across"])):
        x = i * (gx1 - gx0) // int(style["across"])
        bar = slice(max(x - frame // 2, 0), x + (frame + 1) // 2)
        pane[:, bar], bars[:, bar] = tone, 0
    for i in range(1, int(style["down"])):
        y = i * (gy1 - gy0) // int(style["down"])
        bar = slice(max(y - frame // 2, 0), y + (frame + 1) // 2)
        pane[bar], bars[bar] = tone, 0
    if style["reveal"]:  # the wall's own shadow on the glass
        pane[: max(1, round(0.1 * (gy1 - gy0)))] *= 0.4
    part = picture[gy0:gy1, gx0:gx1]
    part[:] = part + shape[..., None] * (pane - part)
    if not style["arch"]:
        mask[y0:y1, x0:x1, OPENING] = 1
    part = mask[gy0:gy1, gx0:gx1]
    part[..., GLASS] = shape * bars
    part[..., OPENING] = np.maximum(part[..., OPENING], shape)
    if style["sill"]:
        cv2.line(picture, (x0 - 2, y1 + 1), (x1 + 2, y1 + 1), style["trim"], max(1, frame))
    if style["shutters"]:
        w = (x1 - x0) // 2
        for a, b in ((x0 - w - 1, x0 - 1), (x1 + 1, x1 + w + 1)):
            cv2.rectangle(picture, (a, y0), (b, y1), style["leaf"], -1)


def facade(random: Random, real: Facades | None = None) -> tuple[np.ndarray, np.ndarray]:
    """A wall with its windows straight on: (S, S, 3) in [0, 255], and what is known (S, S, 4)."""
    picture, mask = wall(random), np.zeros((SIDE, SIDE, LAYERS), np.float32)
    storeys, bays = (int(n) for n in np.clip(1 + random.exponential([2.5, 3.0]), 1, 14))
    height, width = SIDE / storeys, SIDE / bays
    share = random.uniform([0.25, 0.3], [0.8, 0.85])
    curtain_wall = random.random() < 0.15  # nothing but glass and bars
    if curtain_wall:
        share = random.uniform([0.85, 0.75], [0.97, 0.95])
    own = colour(random, 20, 250, 0.1)
    upright = 0.7 < share[1] * height / (share[0] * width) < 3.5  # as photographed windows are
    style = {
        "random": random,
        "frame": int(random.integers(1, 4)),
        "edge": random.uniform(0, 0.12),
        "tone": (own if random.random() < 0.7 else np.full(3, 235.0)).tolist(),
        "trim": colour(random, 60, 240, 0.08).tolist(),
        "leaf": colour(random, 20, 180, 0.35).tolist(),
        "across": int(random.choice([1, 2, 2, 3, 4])),
        "down": int(random.choice([1, 1, 2, 3, 4])),
        "arch": random.random() < 0.12,
        "reveal": random.random() < 0.4,
        "sill": random.random() < 0.4,
        "surround": random.random() < 0.3,
        "shutters": random.random() < 0.12 and share[0] < 0.5,
        "shut": 0.0 if random.random() < 0.7 else random.uniform(0, 0.6),
        "real": real if upright and random.random() < REAL_WINDOWS else None,
        "tint": np.exp(random.normal(-0.2, 0.4) + random.normal(0, 0.1, 3)),
        "mirrors": random.uniform(0, 0.3) if random.random() < 0.6 else random.uniform(0.5, 1),
    }
    missing = random.uniform(0, 0.3) if random.random() < 0.5 else 0.0
    for storey in range(storeys):
        if random.random() < 0.15:
            picture[int(storey * height) : int(storey * height + 0.08 * height) + 1] *= 0.75
        for bay in range(bays):
            if random.random() < missing:
                continue
            w, h = share[0] * width, share[1] * height
            x0, y0 = (bay + 0.5) * width - w / 2, (storey + 0.5) * height - h / 2
            box = tuple(round(v) for v in (x0, y0, x0 + w, y0 + h))
            window(picture, mask, box, style)
    if random.random() < 0.5:
        clutter(picture, mask, random)
    return picture, mask


def clutter(picture: np.ndarray, mask: np.ndarray, random: Random) -> None:
    """Doors, signs, pipes and letters: no glass; both in place."""
    for _ in range(int(random.integers(1, 7))):
        x, y = random.integers(0, SIDE, 2)
        w, h = (SIDE * random.uniform(0.02, 0.3, 2)).astype(int) + 2
        draw = random.random()
        if draw < 0.35:  # a door or a gate
            y = SIDE - h
        elif draw < 0.5:  # a pipe
            w, h = 3, SIDE
        tone = colour(random, 10, 240, 0.3).tolist()
        cv2.rectangle(picture, (int(x), int(y)), (int(x + w), int(y + h)), tone, -1)
        cv2.rectangle(mask, (int(x), int(y)), (int(x + w), int(y + h)), (0, 0, 0, 0), -1)
        if draw > 0.8:
            text = "".join(chr(c) for c in random.integers(65, 91, 5))
            at = (int(x), int(y + h))
            letters = np.zeros(mask.shape[:2], np.uint8)
            cv2.putText(letters, text, at, cv2.FONT_HERSHEY_SIMPLEX, h / 30, 255, 2)
            ink = colour(random, 0, 255, 0.2)
            picture += (letters / 255)[..., None] * (ink - picture)


def light(random: Random, shape: tuple[int, int] = (SIDE, SIDE)) -> np.ndarray:
    """Shading of a wall: sun or shade, with the edge of a shadow at times; (h, w, 1)."""
    level = np.exp(random.normal(-0.2, 0.5))
    y = np.linspace(random.uniform(0.7, 1.3), random.uniform(0.6, 1.2), shape[0])[:, None]
    shade = np.full(shape, level, np.float32) * y
    if random.random() < 0.3:
        corner = (random.uniform(0, 1, (4, 2)) * shape[::-1]).astype(np.int32)
        cover = np.zeros(shape, np.float32)
        cv2.fillPoly(cover, [corner], 1.0)
        shade *= 1 - cover * random.uniform(0.3, 0.8)
    return shade[..., None]


def occlude(canvas: np.ndarray, target: np.ndarray, photo: np.ndarray, random: Random) -> None:
    """Leaves, people and posts before it: blots and bars of another photo, both in place."""
    size = canvas.shape[0]
    for _ in range(int(random.integers(0, 4))):
        cover = np.zeros((size, size), np.float32)
        x, y = random.uniform(0, size, 2)
        if random.random() < 0.5:
            w = random.uniform(0.03, 0.2) * size
            cloud = noise(random, int(random.integers(8, 64)), size)
            rows, columns = np.mgrid[:size, :size]
            inside = 1 - ((columns - x) ** 2 + (rows - y) ** 2) / w**2
            cover = np.clip(4 * (inside + 0.7 * cloud), 0, 1)
        else:
            w = int(random.integers(1, max(2, size // 25)))
            cv2.line(cover, (int(x), 0), (int(x + random.normal(0, 4)), size), 1.0, w)
        canvas[:] = canvas + cover[..., None] * (photo - canvas)
        target *= (1 - cover)[..., None]


def person(canvas: np.ndarray, cover: np.ndarray, random: Random) -> None:
    """Somebody who stands or walks; draws into ``canvas`` and ``cover``, as all things do."""
    size = canvas.shape[0]
    tall = size * random.uniform(0.04, 0.35)
    x, foot = random.uniform(0, size), random.uniform(0.5, 1.0) * size
    wide = tall * random.uniform(0.1, 0.16)
    parts = [(0.0, 0.16, 0.55), (0.14, 0.56, 1.0), (0.5, 1.0, 0.7)]
    for top, low, share in parts:
        tone = colour(random, 5, 200, 0.4).tolist()
        a = (round(x - share * wide), round(foot - tall * (1 - top)))
        b = (round(x + share * wide), round(foot - tall * (1 - low)))
        for layer, value in ((canvas, tone), (cover, 1.0)):
            cv2.rectangle(layer, a, b, value, -1)


def car(canvas: np.ndarray, cover: np.ndarray, random: Random) -> None:
    """A body, its dark panes, wheels and lights."""
    size = canvas.shape[0]
    wide = size * random.uniform(0.05, 0.5)
    tall = wide * random.uniform(0.3, 0.75)
    x, foot = random.uniform(0, size), random.uniform(0.55, 1.05) * size
    low, high = wide * random.uniform(0.4, 0.5), wide * random.uniform(0.2, 0.4)
    waist = foot - tall * random.uniform(0.5, 0.65)
    roof = foot - tall
    shape = [(x - low, foot - 0.15 * tall), (x - low, waist), (x - high, roof), (x + high, roof)]
    shape += [(x + low, waist), (x + low, foot - 0.15 * tall)]
    paint = colour(random, 15, 235, 0.35).tolist()
    for layer, value in ((canvas, paint), (cover, 1.0)):
        cv2.fillPoly(layer, [np.array(shape, np.int32)], value, cv2.LINE_AA)
    dark = colour(random, 5, 110, 0.1).tolist()
    inner = 0.88 * (np.array([shape[1], shape[2], shape[3], shape[4]]) - (x, waist)) + (
        x,
        waist - 1,
    )
    cuts = int(random.integers(1, 4))
    for i in range(cuts):
        a, b = i / cuts + 0.02, (i + 1) / cuts - 0.02
        foot_line = inner[0] + np.array([[a], [b]]) * (inner[3] - inner[0])
        roof_line = inner[1] + np.array([[a], [b]]) * (inner[2] - inner[1])
        pane = np.concatenate([foot_line, roof_line[::-1]])
        cv2.fillPoly(canvas, [pane.astype(np.int32)], dark, cv2.LINE_AA)
    for side in (-0.6, 0.6):
        at = (round(x + side * low), round(foot - 0.15 * tall))
        for layer, value in ((canvas, (15.0, 15.0, 15.0)), (cover, 1.0)):
            cv2.circle(layer, at, max(1, round(0.16 * tall)), value, -1, cv2.LINE_AA)


def sign(canvas: np.ndarray, cover: np.ndarray, random: Random) -> None:
    """A board, a traffic light or a bin, on a post or not."""
    size = canvas.shape[0]
    x, y = random.uniform(0, size), random.uniform(0.1, 0.9) * size
    wide, tall = size * random.uniform(0.01, 0.12, 2)
    if random.random() < 0.6:
        thick = max(1, round(0.1 * wide))
        for layer, value in ((canvas, colour(random, 20, 160, 0.05).tolist()), (cover, 1.0)):
            cv2.line(layer, (round(x), round(y)), (round(x), size), value, thick)
    tone = colour(random, 5, 240, 0.4).tolist()
    box = (round(x - wide / 2), round(y - tall / 2)), (round(x + wide / 2), round(y + tall / 2))
    for layer, value in ((canvas, tone), (cover, 1.0)):
        cv2.rectangle(layer, *box, value, -1)
    if random.random() < 0.4:
        for i in (-1, 0, 1):
            lamp = colour(random, 20, 255, 0.8).tolist()
            at = (round(x), round(y + 0.3 * i * tall))
            cv2.circle(canvas, at, max(1, round(0.12 * tall)), lamp, -1, cv2.LINE_AA)


def furnish(canvas: np.ndarray, target: np.ndarray, random: Random) -> None:
    """People, cars and signs: dark, upright, angular, and no windows; both in place."""
    for _ in range(int(random.choice([0, 0, 1, 2, 4, 8]))):
        cover = np.zeros(target.shape[:2], np.float32)
        draw = (person, car, sign)[random.integers(3)]
        draw(canvas, cover, random)
        target *= (1 - cover)[..., None]


def street(
    photo: np.ndarray, other: np.ndarray, random: Random, real: Facades | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Façades before a photo of nature; (S, S, 3) uint8, and what is known of it, (S, S, 4)."""
    size = photo.shape[0]
    canvas, target = photo.astype(np.float32), np.zeros((size, size, LAYERS), np.float32)
    if random.random() < 0.25:
        furnish(canvas, target, random)
        return np.clip(canvas, 0, 255).astype(np.uint8), target
    for _ in range(int(random.integers(1, 5))):
        quad = corners(size, random).astype(np.float32)
        if random.random() < 0.3:  # a house far away
            middle = quad.mean(0)
            quad = middle + (quad - middle) * random.uniform(0.15, 0.5)
        if real is not None and random.random() < REAL_WALLS:
            picture, mask, solid = real.wall(quad, random)
        else:
            picture, mask = facade(random, real)
            solid = None
        set_up(
            canvas, target, (picture * light(random, picture.shape[:2]), mask, solid), quad, random
        )
    furnish(canvas, target, random)
    occlude(canvas, target, other.astype(np.float32), random)
    return np.clip(canvas, 0, 255).astype(np.uint8), np.clip(target, 0, 1)


def set_up(
    canvas: np.ndarray,
    target: np.ndarray,
    wall: tuple[np.ndarray, np.ndarray, np.ndarray | None],
    quad: np.ndarray,
    random: Random,
) -> None:
    """Sets a wall (picture, what is known, where it is solid) up between four corners, in place."""
    size = canvas.shape[0]
    picture, mask, solid = wall
    height, width = picture.shape[:2]
    flat = np.array([[0, 0], [width, 0], [width, height], [0, height]], np.float32)
    turn = cv2.getPerspectiveTransform(flat, quad.astype(np.float32))
    shape = quad
    if solid is None and random.random() < 0.4:
        ridge = (quad[0] + quad[1]) / 2 - [0, random.uniform(0.02, 0.2) * size]
        shape = np.concatenate([quad[:1], ridge[None], quad[1:]])
    cover = np.zeros((size, size), np.uint8)
    cv2.fillPoly(cover, [np.round(shape * 16).astype(np.int32)], 255, cv2.LINE_AA, 4)
    alpha = cover.astype(np.float32)[..., None] / 255
    # Twice as fine and averaged: small panes keep what they have of light.
    fine = np.diag([2.0, 2.0, 1.0]) @ turn
    if solid is not None:
        alpha = alpha * warped(solid, fine, size)[..., None]
    canvas += alpha * (warped(picture, fine, size) - canvas)
    target += alpha * (warped(mask, fine, size, cv2.BORDER_CONSTANT) - target)


def warped(
    image: np.ndarray, turn: np.ndarray, size: int, border: int = cv2.BORDER_REPLICATE
) -> np.ndarray:
    """An image set up in perspective at half of the size that ``turn`` draws."""
    large = cv2.warpPerspective(
        image.astype(np.float32), turn, (2 * size, 2 * size), borderMode=border
    )
    return cv2.resize(large, (size, size), interpolation=cv2.INTER_AREA)
