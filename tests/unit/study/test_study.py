"""Answers and their files, and Bradley–Terry against other ways to the same numbers."""

import itertools

import numpy as np
import pytest
from scipy.optimize import minimize

from sunwidget.study import (
    Answer,
    StudyError,
    bradley_terry,
    by_rater,
    read_csv,
    write_csv,
)


def answer(left, right, choice, rater="anna", trial=1, **changes):
    values = {"picture": "", "seconds": 1.5, "timestamp": "2026-11-21T10:00:00Z"} | changes
    return Answer(rater=rater, trial=trial, left=left, right=right, choice=choice, **values)


def simulated(strengths, each, rng, rater="anna"):
    """Answers by the model: every pair ``each`` times, sides by chance."""
    rows = []
    for a, b in itertools.combinations(strengths, 2):
        for _ in range(each):
            left, right = (a, b) if rng.random() < 0.5 else (b, a)
            chance = 1 / (1 + np.exp(strengths[right] - strengths[left]))
            choice = "left" if rng.random() < chance else "right"
            rows.append(answer(left, right, choice, rater, len(rows) + 1))
    return rows


TRUE = {"ratio": 1.1, "photo": 0.6, "thesis": -0.4, "literal": -1.3}


def by_optimiser(rows, prior):
    """Strengths and covariance from the likelihood of single answers and a general optimiser."""
    names = list(dict.fromkeys(name for row in rows for name in (row.left, row.right)))
    count = len(names)

    def loss(free):
        strength = dict(zip(names, [*free, -sum(free)], strict=True))
        total = 0.0
        for row in rows:
            apart = strength[row.left] - strength[row.right]
            share = {"left": 1, "right": 0, "tie": 0.5}[row.choice]
            total += share * np.log1p(np.exp(-apart)) + (1 - share) * np.log1p(np.exp(apart))
        for a, b in itertools.permutations(names, 2):
            total += prior / (count - 1) * np.log1p(np.exp(strength[b] - strength[a]))
        return total

    found = minimize(loss, np.zeros(count - 1), method="BFGS", options={"gtol": 1e-7}).x
    # The Hessian over the free strengths by differences; the last is minus their sum.
    step, unit = 1e-3, np.eye(count - 1)
    hessian = [
        [
            (
                loss(found + step * (a + b))
                - loss(found + step * (a - b))
                - loss(found - step * (a - b))
                + loss(found - step * (a + b))
            )
            / (4 * step**2)
            for b in unit
        ]
        for a in unit
    ]
    spread = np.vstack([unit, -np.ones(count - 1)])
    covariance = spread @ np.linalg.inv(hessian) @ spread.T
    return dict(zip(names, [*found, -found.sum()], strict=True)), names, covariance


@pytest.mark.parametrize("prior", [0, 0.5, 3])
def test_strengths_and_errors_are_those_of_a_general_optimiser(prior):
    rows = simulated(TRUE, 12, np.random.default_rng(3))
    rows += [answer("ratio", "photo", "tie"), answer("literal", "thesis", "tie")]
    found = bradley_terry(rows, prior=prior)
    strengths, names, covariance = by_optimiser(rows, prior)
    assert found.strengths == pytest.approx([strengths[m] for m in found.methods], abs=1e-5)
    pick = [names.index(m) for m in found.methods]
    assert found.covariance == pytest.approx(covariance[np.ix_(pick, pick)], rel=1e-4, abs=1e-5)
    assert found.ties == 2


def test_known_strengths_come_back_within_their_errors():
    rng = np.random.default_rng(11)
    inside, off = 0, []
    for _ in range(60):
        found = bradley_terry(simulated(TRUE, 25, rng))
        true = np.array([TRUE[m] for m in found.methods])
        low, high = found.intervals(0.95).T
        inside += ((low < true) & (true < high)).sum()
        off.append(found.strengths[np.argsort(found.methods)])
    # 240 intervals of 95 %: a share of 0.95 ± 0.014.
    assert 0.9 < inside / 240 <= 0.995
    mean = np.mean(off, axis=0)
    assert mean == pytest.approx([TRUE[m] for m in sorted(TRUE)], abs=0.1)


def test_two_methods_have_the_answer_in_closed_form():
    rows = [answer("a", "b", "left")] * 7 + [answer("b", "a", "left")] * 3
    plain = bradley_terry(rows, prior=0)
    assert plain.difference("a", "b")[0] == pytest.approx(np.log(7 / 3))
    # Variance of a log odds: 1/7 + 1/3.
    assert plain.difference("a", "b")[1] == pytest.approx(np.sqrt(1 / 7 + 1 / 3))
    assert plain.probability("a", "b") == pytest.approx(0.7)
    assert plain.strengths.sum() == pytest.approx(0)
    jeffreys = bradley_terry(rows)
    assert jeffreys.difference("a", "b")[0] == pytest.approx(np.log(7.5 / 3.5))


def test_a_method_that_always_wins_stays_finite_and_is_named():
    rows = simulated(TRUE, 6, np.random.default_rng(5))
    rows += [answer("best", name, "left") for name in TRUE for _ in range(6)]
    found = bradley_terry(rows)
    assert found.methods[0] == "best"
    assert np.isfinite(found.strengths).all()
    assert found.standard_errors[0] > 1.3 * found.standard_errors[1:].max()
    assert any("best won every comparison" in note for note in found.notes)
    assert "best won every comparison" in str(found)
    with pytest.raises(StudyError, match="never lost"):
        bradley_terry(rows, prior=0)


def test_methods_that_were_never_compared_are_said_to_be():
    rows = [answer(*pair, side) for pair in (("a", "b"), ("c", "d")) for side in ("left", "right")]
    found = bradley_terry(rows)
    assert found.strengths == pytest.approx(0, abs=1e-9)
    assert "only the prior relates them" in found.notes[0]
    assert bradley_terry(rows, methods=("e",)).notes == ("e: not shown yet.",)


def test_sides_and_order_of_the_answers_are_of_no_account():
    rows = simulated(TRUE, 9, np.random.default_rng(8))
    swap = {"left": "right", "right": "left", "tie": "tie"}
    turned = [r._replace(left=r.right, right=r.left, choice=swap[r.choice]) for r in rows[::-1]]
    one, other = bradley_terry(rows), bradley_terry(turned)
    assert one.methods == other.methods
    assert one.strengths == pytest.approx(other.strengths, abs=1e-9)
    assert (one.left, other.left) == (one.left, len(rows) - one.left)


def test_raters_apart_and_together():
    rng = np.random.default_rng(2)
    opposite = {name: -strength for name, strength in TRUE.items()}
    rows = simulated(TRUE, 20, rng, "anna") + simulated(opposite, 20, rng, "bert")
    apart = by_rater(rows)
    assert apart["anna"].methods[0] == "ratio"
    assert apart["bert"].methods[0] == "literal"
    assert np.abs(bradley_terry(rows).strengths).max() < 0.4
    assert np.abs(apart["anna"].strengths).max() > 0.8


@pytest.mark.parametrize("bad", [-1, float("nan")])
def test_a_prior_is_a_number_from_0(bad):
    with pytest.raises(StudyError, match="prior"):
        bradley_terry([answer("a", "b", "left")], prior=bad)


def test_no_answers_are_said_to_be_none():
    with pytest.raises(StudyError, match="no answers yet"):
        bradley_terry([])


HOSTILE = ["<b>ours</b>", 'say "hi", twice', "line\nbreak", "Grüße – 陽"]


def test_answers_survive_their_file(tmp_path):
    rows = [
        answer(HOSTILE[i], HOSTILE[i - 1], "left", rater=HOSTILE[i], trial=i + 1, picture="=1+1")
        for i in range(4)
    ]
    path = write_csv(rows, tmp_path / "answers.csv")
    assert read_csv(path) == rows
    with pytest.raises(FileExistsError):
        write_csv(rows, path)
    assert read_csv(write_csv(rows[:1], path, overwrite=True)) == rows[:1]


def test_files_of_several_raters_pool_and_no_answer_counts_twice(tmp_path):
    early = [answer("a", "b", "left", trial=1)]
    late = [*early, answer("b", "a", "tie", trial=2)]
    other = [answer("a", "b", "right", rater="bert")]
    files = [write_csv(rows, tmp_path / f"{i}.csv") for i, rows in enumerate((early, late, other))]
    assert read_csv(*files) == [*late, *other]
    assert bradley_terry(read_csv(*files)).answers == 3


HEADER = "rater,trial,picture,left,right,choice,seconds,timestamp\n"


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("rater,trial\nanna,1\n", "left"),
        (HEADER + "a,1,,x,y,up,1,t\n", "line 2"),
        (HEADER + "a,0,,x,y,left,1,t\n", "trial"),
        (
            HEADER + "a,1,,x,y,left,nan,t\n",
            "number",
        ),
        (HEADER + "a,1,,x,x,left,1,t\n", "two dif"),
        (HEADER + "a,1\n", "is missing"),
    ],
)
def test_a_file_that_holds_no_answers_says_what_is_wrong(tmp_path, text, says):
    path = tmp_path / "wrong.csv"
    path.write_text(text, "utf-8")
    with pytest.raises(StudyError, match=says) as caught:
        read_csv(path)
    assert "wrong.csv" in str(caught.value)


def test_bytes_that_are_no_text_are_refused_by_name(tmp_path):
    path = tmp_path / "photo.csv"
    path.write_bytes(b"\xff\xd8\xff\xe0" + bytes(range(256)))
    with pytest.raises(StudyError, match="photo.csv is not a study's CSV"):
        read_csv(path)
