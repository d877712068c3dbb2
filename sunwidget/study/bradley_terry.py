"""Strengths of methods from comparisons, by the model of Bradley and Terry.

Every method has a strength β. Method i is chosen over method j with probability
1 / (1 + exp(β_j − β_i)) (Bradley and Terry 1952, Biometrika 39, 324–345).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.errors import StudyError
from sunwidget.study.answers import Answer

PRIOR = 0.5
_STEPS = 100  # Newton's method needs about six
_CLOSE = 1e-10  # largest change of a strength in the last step


@dataclass(frozen=True, eq=False)
class BradleyTerry:
    """Strengths of methods, the result of ``bradley_terry``.

    Parameters
    ----------
    methods : tuple of str
        From the strongest to the weakest; the order of the arrays below.
    strengths : (K,) float64 array
        Natural logarithms; they sum to 0.
    covariance : (K, K) float64 array
        Covariance of the strengths under that condition; its rows sum to 0.
    wins : (K, K) float64 array
        ``wins[i, j]``: how often i was chosen over j; a tie is half a win for each.
    answers, ties : int
    left : int
        Answers that chose the left picture.
    prior : float
    notes : tuple of str
        Caveats for the interpretation.
    """

    methods: tuple[str, ...]
    strengths: NDArray[np.float64]
    covariance: NDArray[np.float64]
    wins: NDArray[np.float64]
    answers: int
    ties: int
    left: int
    prior: float
    notes: tuple[str, ...]

    @property
    def standard_errors(self) -> NDArray[np.float64]:
        """Standard error of each strength, (K,): the root of the covariance's diagonal."""
        return np.sqrt(np.diag(self.covariance))

    def intervals(self, level: float = 0.95) -> NDArray[np.float64]:
        """Return the lower and upper end of each strength's Wald interval, (K, 2)."""
        from scipy.special import ndtri

        half = ndtri((1 + level) / 2) * self.standard_errors
        return np.stack([self.strengths - half, self.strengths + half], axis=1)

    def difference(self, a: str, b: str) -> tuple[float, float]:
        """Return the strength of ``a`` minus that of ``b``, and its standard error."""
        i, j = self._at(a), self._at(b)
        c = self.covariance
        variance = c[i, i] + c[j, j] - 2 * c[i, j]
        return float(self.strengths[i] - self.strengths[j]), math.sqrt(max(variance, 0.0))

    def probability(self, a: str, b: str) -> float:
        """Return the probability that ``a`` is chosen over ``b``."""
        return float(1 / (1 + np.exp(-self.difference(a, b)[0])))

    def _at(self, method: str) -> int:
        if method not in self.methods:
            raise StudyError(
                f"No answer has method {method!r}. Methods: {', '.join(self.methods)}."
            )
        return self.methods.index(method)

    def __str__(self) -> str:
        width = max(len("method"), *map(len, self.methods))
        lines = [f"{'method':{width}}  strength  std. error  95 % interval    chosen"]
        rows = zip(self.methods, self.strengths, self.standard_errors, strict=True)
        for i, ((method, strength, error), (low, high)) in enumerate(
            zip(rows, self.intervals(), strict=True)
        ):
            won, shown = self.wins[i].sum(), self.wins[i].sum() + self.wins[:, i].sum()
            lines.append(
                f"{method:{width}}  {strength:8.2f}  {error:10.2f}  {low:6.2f} … {high:5.2f}"
                f"  {won:g} of {shown:g}"
            )
        decided = max(self.answers - self.ties, 1)
        lines.append(
            f"{self.answers} answers, {self.ties} ties; left chosen in "
            f"{100 * self.left / decided:.0f} % of those decided. Prior {self.prior:g}."
        )
        return "\n".join([*lines, *self.notes])

    __repr__ = __str__


def bradley_terry(
    answers: Iterable[Answer], *, prior: float = PRIOR, methods: Sequence[str] = ()
) -> BradleyTerry:
    """Estimate the strengths of methods from answers, pooled over raters and pictures.

    Newton's method maximizes the penalized likelihood of Bradley and Terry's model. ``prior`` is
    the weight of the penalty: the number of additional wins, and losses, of every method, spread
    evenly over the others. It keeps the strength of a method that always won finite and makes
    methods comparable that were never shown together. With two methods, ½ is Jeffreys' prior
    Beta(½, ½). Standard errors are from the inverse Hessian in the space of strengths that sum
    to 0. They assume independent answers, which many answers of few raters are not.

    Parameters
    ----------
    answers : iterable of Answer
        From ``Study.answers`` or ``read_csv``.
    prior : float, default 0.5
        At least 0; 0 is plain maximum likelihood.
    methods : sequence of str, optional
        Methods to list even without answers.

    Raises
    ------
    StudyError
        Without answers, and with ``prior`` 0 if no finite maximum exists (Ford 1957: some methods
        never lost to the others).

    Examples
    --------
    >>> sunwidget.study.bradley_terry(sunwidget.study.read_csv("anna.csv", "bert.csv"))
    """
    rows = list(answers)
    if not rows:
        raise StudyError("There are no answers yet. Show the study and answer some comparisons.")
    if not prior >= 0 or not math.isfinite(prior):
        raise StudyError(f"prior must be a number from 0, not {prior!r:.80}.")
    names = list(dict.fromkeys([*methods, *(n for row in rows for n in (row.left, row.right))]))
    wins = _wins(rows, names)
    groups = _linked_groups(wins)
    if prior == 0 and groups > 1:
        raise StudyError(
            "Without a prior these answers have no finite strengths: some methods never lost to "
            "the others or were never shown with them. Keep the default prior."
        )
    count = len(names)
    virtual = prior / (count - 1) * (1 - np.eye(count))
    strengths, covariance = _fit(wins + virtual)
    order = sorted(range(count), key=lambda i: -strengths[i])
    pick = np.ix_(order, order)
    return BradleyTerry(
        methods=tuple(names[i] for i in order),
        strengths=strengths[order],
        covariance=covariance[pick],
        wins=wins[pick],
        answers=len(rows),
        ties=sum(row.choice == "tie" for row in rows),
        left=sum(row.choice == "left" for row in rows),
        prior=prior,
        notes=_notes(wins[pick], [names[i] for i in order], groups),
    )


def by_rater(answers: Iterable[Answer], *, prior: float = PRIOR) -> dict[str, BradleyTerry]:
    """Return the strengths from each rater's answers, by rater; see ``bradley_terry``."""
    rows = list(answers)
    methods = list(dict.fromkeys(name for row in rows for name in (row.left, row.right)))
    return {
        rater: bradley_terry(
            (row for row in rows if row.rater == rater), prior=prior, methods=methods
        )
        for rater in dict.fromkeys(row.rater for row in rows)
    }


def _wins(rows: list[Answer], names: list[str]) -> NDArray[np.float64]:
    at = {name: i for i, name in enumerate(names)}
    wins = np.zeros((len(names), len(names)))
    for row in rows:
        left, right = at[row.left], at[row.right]
        share = {"left": 1.0, "right": 0.0, "tie": 0.5}[row.choice]
        wins[left, right] += share
        wins[right, left] += 1 - share
    return wins


def _fit(wins: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return strengths and their covariance; ``wins`` must link all methods both ways."""
    shown = wins + wins.T
    strengths = np.zeros(len(wins))

    def likelihood(trial: NDArray[np.float64]) -> float:
        return float(-(wins * np.logaddexp(0, trial[None, :] - trial[:, None])).sum())

    def terms(at: NDArray[np.float64]) -> tuple[NDArray[Any], NDArray[Any]]:
        chance = 1 / (1 + np.exp(at[None, :] - at[:, None]))
        information = -shown * chance * chance.T
        np.fill_diagonal(information, 0)
        np.fill_diagonal(information, -information.sum(1))
        # A shift of all strengths has no effect; the pseudo-inverse keeps their sum at 0.
        return (wins - shown * chance).sum(1), np.linalg.pinv(information, hermitian=True)

    for _ in range(_STEPS):
        gradient, inverse = terms(strengths)
        step = inverse @ gradient
        # Far from the maximum, a Newton step may overshoot.
        while likelihood(strengths + step) < likelihood(strengths) - 1e-12 * shown.sum():
            step = step / 2
        strengths = strengths + step
        if np.abs(step).max() < _CLOSE:
            break
    return strengths - strengths.mean(), terms(strengths)[1]


def _linked_groups(wins: NDArray[np.float64]) -> int:
    """Return the number of groups of methods that wins link in both directions."""
    from scipy.sparse.csgraph import connected_components

    return int(connected_components(wins > 0, directed=True, connection="strong")[0])


def _notes(wins: NDArray[np.float64], names: list[str], groups: int) -> tuple[str, ...]:
    """Return notes on strengths that only the prior keeps finite."""
    notes = []
    for i, name in enumerate(names):
        won, lost = wins[i].sum(), wins[:, i].sum()
        if won + lost == 0:
            notes.append(f"{name}: not shown yet.")
        elif won == 0 or lost == 0:
            did = "lost" if won == 0 else "won"
            notes.append(f"{name} {did} every comparison: only the prior keeps it finite.")
    if groups > 1 and not notes:
        notes.append(
            "Some methods never lost to the others or were never shown with them: only the prior "
            "relates them."
        )
    return tuple(notes)
