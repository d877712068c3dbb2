"""A training that is cut short goes on where it was; needs PyTorch, which the package does not."""

import pytest

torch = pytest.importorskip("torch", reason="training needs PyTorch")

from training.loop import Run, report  # noqa: E402 - after the skip


def network():
    torch.manual_seed(1)
    return torch.nn.Conv2d(1, 1, 1)


def train(folder, minutes, steps, **options):
    """A run of so many steps towards an output of 1."""
    run = Run(network(), folder, minutes, **options)
    for _ in report(run, every=2):
        loss = ((run.network(torch.ones(1, 1, 2, 2)) - 1) ** 2).mean()
        loss.backward()
        run.learn(0.02, 2.0)
        run.count({"loss": loss})
        if run.step == steps:
            run.spent = run.limit
    return run


def test_it_learns_and_tells(tmp_path, capsys):
    run = train(tmp_path, 1, 200)
    assert abs(run.network(torch.ones(1, 1, 1, 1)).item() - 1) < 0.1
    assert "step 200" in capsys.readouterr().out
    assert run.average.steps == run.step == 200


def test_it_goes_on_from_its_checkpoint(tmp_path):
    first = train(tmp_path, 1, 20)
    again = Run(network(), tmp_path, 2)
    assert again.resumed
    assert again.step == 20
    assert again.spent == first.spent >= 60
    assert torch.equal(again.network.weight, first.network.weight)
    assert torch.equal(again.average.state["weight"], first.average.state["weight"])
    momentum = first.optimise.state[first.network.weight]["exp_avg"]
    assert torch.equal(again.optimise.state[again.network.weight]["exp_avg"], momentum)
    assert next(again.shares()) == pytest.approx(0.5, abs=0.01)


def test_a_run_whose_time_is_spent_makes_no_step(tmp_path):
    first = train(tmp_path, 1, 5)
    assert train(tmp_path, 1, 9).step == first.step == 5


def test_a_start_gives_weights_and_no_time(tmp_path):
    state = torch.load(train(tmp_path, 1, 20).checkpoint, weights_only=True)
    (tmp_path / "other").mkdir()
    run = Run(network(), tmp_path / "other", 1)
    run.begin(state)
    assert not run.resumed
    assert (run.spent, run.step) == (0, 0)
    assert torch.equal(run.network.weight, state["network"]["weight"])


def test_checkpoints_are_told_of(tmp_path):
    told = []
    train(tmp_path, 1, 10, seconds=0, told=lambda: told.append(1))
    assert len(told) == 11  # after each step, and in the end
