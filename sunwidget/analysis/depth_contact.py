"""Contact rows: how far below the horizon what stands upright meets the ground, by column.

One upright thing a column, as a "stixel" (Badino, Franke & Pfeiffer, "The stixel world", DAGM
2009), but without stereo: land above the horizon is no ground, so its colours tell what is
upright, and those at the foot of the picture what is ground. Between the two the contact is told
by colours, by an edge, by how high the thing rises (a tree of eight metres seen by an eye 1.7 m
above the ground has its foot a quarter as far below the horizon as its top above), and by the
neighbouring columns: a hidden Markov chain over columns, solved by forward and backward passes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sunwidget.analysis.depth_view import View

STATES = 64
_FINEST = 0.008  # of the height: contacts are not seen any finer
_UPRIGHT_WINDOW, _GROUND_WINDOW = 0.062, 0.22  # of the width: colours of which columns count
_FOOT = 0.43  # ground's colours are taken from here (0 horizon, 1 lower edge) to the edge
_FLOOR = 3.3  # Lab units: finer differences of colour say nothing
_CLIP = 1.07  # largest log-odds of a pixel ...
_ROWS = 0.061 * 256  # ... and weight of them, as a picture has so many independent rows
_EDGE, _EDGE_MOST = 0.5, 2.5  # weight of an edge, in deviations of its surroundings
RATIO = 0.107  # drop of the foot over rise of the top, typically ...
_RATIO_SPREAD = 1.3  # ... with this deviation of its logarithm
_JUMP = 60.0 / 256  # cost of a neighbour e times as far, at 256 columns
_JUMP_MOST, _JUMP_AT_STEP = 12.0, 3.0  # cost of any jump, and where the skyline steps, too
_STEP = 0.25  # a change of ln(rise) that is a step
_ROUNDS, _FLAT, _HIGH = 12, 2e-3, 0.6  # of reweighting; a difference that is none; a step
_STAIRS, _OTHER = 0.06, 0.6  # of the width; of ln depth: so far apart are different things
_OUTSIDE = 20.0  # cost of a foot below the picture


@dataclass(frozen=True, eq=False)
class Contacts:
    """What is known of the contact rows.

    Parameters
    ----------
    drop : (STATES,) float64
        Pixels below the horizon, spread logarithmically from 0.
    probability : (STATES, w) float64
        Of each drop in each column; columns sum to 1.
    rows : (STATES, w) float64
        The row, in pixel centres, of each drop.
    rise : (w,) float64
        Pixels that the land rises above the horizon.
    above : (h, w) bool
        The land above the horizon that is joined to it in its column.
    """

    drop: np.ndarray
    probability: np.ndarray
    rows: np.ndarray
    rise: np.ndarray
    above: np.ndarray


def finest_drop(view: View) -> float:
    """Return how finely a drop below the horizon is known, in pixels."""
    return max(view.horizon_error, _FINEST * view.shape[0])


def find(view: View) -> Contacts:
    """Find how probable each contact row is in each column."""
    height, width = view.shape
    above, rise = _above(view)
    finest = finest_drop(view)
    horizon = view.horizon_rows - 0.5
    deepest = max(float((height - horizon).max()), 0.5 * height)
    levels = np.linspace(0, np.log1p(deepest / finest), STATES)
    drop = finest * np.expm1(levels)
    rows = horizon + drop[:, None]
    colours = _colours(view, above)
    cost = _at_rows(colours, rows + 0.5)
    cost -= _EDGE * _at_rows(_edges(view), rows) * (drop > 1.5)[:, None]
    wanted = np.log((RATIO * rise + finest / 2) / (drop[:, None] + finest / 2))
    cost += 0.5 * (wanted / _RATIO_SPREAD) ** 2
    cost += _OUTSIDE * (rows > height)
    step = np.abs(np.diff(np.log(rise + 2 * finest), prepend=np.log(rise[0] + 2 * finest)))
    distance = np.abs(levels[:, None] - levels) * (_JUMP * width)
    probability = _marginals(cost, distance, np.clip(step / _STEP, 0, 1))
    return Contacts(drop, probability, rows, rise, above)


def stands_at(contacts: Contacts, height: int) -> np.ndarray:
    """Return how probably the contact lies below each pixel: (height, w) float32."""
    above = np.cumsum(contacts.probability, axis=0)
    rows = np.arange(height)
    out = np.empty((height, above.shape[1]), np.float32)
    for x in range(above.shape[1]):
        out[:, x] = 1 - np.interp(rows, contacts.rows[:, x], above[:, x], 0, 1)
    return out


def levelled(values: np.ndarray, weight: np.ndarray, price: float) -> np.ndarray:
    """Flatten the small folds of a profile and keep its steps and slopes: (w,) float64.

    Least Σ weight (v − values)² / 2 + price Σ s ln(1 + |difference of neighbours| / s), by
    reweighted least squares: total variation (Rudin, Osher & Fatemi 1992) for small differences,
    while a step costs hardly more when it is high, so that steps stay as high as they are. A
    column's contact errs by itself, and a few percent of depth would be walls that face sideways.
    """
    from scipy.linalg import solveh_banded

    found = values
    if len(values) < 3:
        return found
    for _ in range(_ROUNDS):
        fold = np.maximum(np.abs(np.diff(found)), _FLAT)
        tie = price / (fold * (1 + fold / _HIGH))
        diagonal = weight + np.append(tie, 0) + np.append(0, tie)
        bands = np.vstack([np.append(0, -tie), diagonal])
        found = solveh_banded(bands, weight * values)
    # What is left of a slope is stairs: slopes again, by a bilateral filter (Tomasi & Manduchi
    # 1998), which leaves steps of another thing alone.
    column = np.arange(len(values))
    near = np.exp(-0.5 * ((column[:, None] - column) / (_STAIRS * len(values))) ** 2) * weight
    for _ in range(2):
        alike = near * np.exp(-0.5 * ((found[:, None] - found) / _OTHER) ** 2)
        found = alike @ found / alike.sum(axis=1)
    return np.asarray(found)


def _above(view: View) -> tuple[np.ndarray, np.ndarray]:
    """Return the land that stands on the horizon, and how far it rises above it, by column."""
    height = view.shape[0]
    rows = np.arange(height)[:, None]
    over = rows < view.first_ground
    sky = ~view.land & over
    lowest = np.where(sky.any(axis=0), height - 1 - np.argmax(sky[::-1], axis=0), -1)
    above = over & (rows > lowest)
    rise = np.maximum(view.horizon_rows - 1.5 - lowest, 0) * above.any(axis=0)
    return above, rise


def _colours(view: View, above: np.ndarray) -> np.ndarray:
    """Return the cost of ground beginning at each row: (h + 1, w), from the colours above it."""
    import cv2

    height, width = view.shape
    rows, first = np.arange(height)[:, None], view.first_ground
    lab = cv2.cvtColor(cv2.GaussianBlur(view.working.encoded, (0, 0), 1.0), cv2.COLOR_RGB2LAB)
    foot = (rows >= first + _FOOT * (height - first)) & view.land
    upright, many = _likelihood(lab, above, _UPRIGHT_WINDOW)
    ground, enough = _likelihood(lab, foot, _GROUND_WINDOW)
    odds = np.clip((upright - ground) / 2, -_CLIP, _CLIP) * (many * enough)
    odds = np.where((rows >= first) & view.land, odds, 0) * (_ROWS / height)
    return np.vstack([np.zeros((1, width)), -np.cumsum(odds, axis=0)])


def _likelihood(lab: np.ndarray, where: np.ndarray, window: float) -> tuple[np.ndarray, np.ndarray]:
    """Return ln p of each pixel's colour after the marked ones in the columns around.

    Up to constants and times two: (h, w); and how well these columns are known, (w,) in [0, 1).
    """
    import cv2

    weight = where.astype(np.float32)[..., None]
    sums = np.concatenate([weight, lab * weight, lab * lab * weight], axis=-1).sum(axis=0)
    size = (int(window * lab.shape[1]) | 1, 1)
    kept = [cv2.blur(sums[None, :, k], size, borderType=cv2.BORDER_REPLICATE)[0] for k in range(7)]
    count = np.maximum(kept[0], 1e-3)
    total = np.zeros(lab.shape[:2], np.float32)
    for channel in range(3):
        mean = kept[1 + channel] / count
        variance = np.maximum(kept[4 + channel] / count - mean**2, 0) + np.float32(_FLOOR**2)
        total -= (lab[..., channel] - mean) ** 2 / variance + np.log(variance)
    return total, kept[0] / (kept[0] + 2)


def _edges(view: View) -> np.ndarray:
    """Return how much each row differs from those under it, in deviations of the surroundings."""
    import cv2

    height, width = view.shape
    lab = cv2.cvtColor(cv2.blur(view.working.encoded, (5, 5)), cv2.COLOR_RGB2LAB)
    step = np.zeros((height, width), np.float32)
    if height > 4:
        step[2:-2] = np.sqrt(((lab[:-4] - lab[4:]) ** 2).sum(axis=-1))
    spread = np.sqrt(cv2.blur(step * step, (width // 4 | 1, height // 4 | 1))) + 2
    return np.asarray(np.minimum(step / spread, _EDGE_MOST))


def _at_rows(image: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Read (h, w) at fractional rows (n, w), linearly; beyond the picture its edge."""
    last = image.shape[0] - 1
    rows = np.clip(rows, 0, last)
    low = np.minimum(rows.astype(int), max(last - 1, 0))
    share = rows - low
    column = np.arange(image.shape[1])
    return np.asarray(
        image[low, column] * (1 - share) + image[np.minimum(low + 1, last), column] * share
    )


def _marginals(cost: np.ndarray, distance: np.ndarray, step: np.ndarray) -> np.ndarray:
    """Return the probability of each state in each column, given all columns.

    Parameters
    ----------
    cost : (n, w)
        −ln likelihood.
    distance : (n, n)
        Cost of going from one state to another between neighbours.
    step : (w,)
        How far a column is no neighbour of the one before it, 0 to 1.
    """
    states, width = cost.shape
    likelihood = np.exp(cost.min(axis=0) - cost).T
    smooth = np.exp(-np.minimum(distance, _JUMP_MOST))
    broken = np.exp(-np.minimum(distance, _JUMP_AT_STEP))
    forward = np.empty((width, states))
    backward = np.empty((width, states))
    now = likelihood[0] / likelihood[0].sum()
    forward[0] = now
    for x in range(1, width):
        now = (
            smooth @ now
            if step[x] == 0
            else (1 - step[x]) * (smooth @ now) + step[x] * (broken @ now)
        )
        now = now * likelihood[x]
        now = now / now.sum()
        forward[x] = now
    now = np.full(states, 1 / states)
    backward[-1] = now
    for x in range(width - 2, -1, -1):
        seen = now * likelihood[x + 1]
        share = step[x + 1]
        now = (
            smooth @ seen if share == 0 else (1 - share) * (smooth @ seen) + share * (broken @ seen)
        )
        now = now / now.sum()
        backward[x] = now
    both = forward * backward
    return np.asarray((both / both.sum(axis=1, keepdims=True)).T)
