"""Drawn charts as charts of the language: they do the same, or are refused by name."""

from collections.abc import Callable, Sequence
from pathlib import Path
from random import Random

import pytest

from rovercheck.checker.drawn.charts.masks import masked
from rovercheck.checker.drawn.charts.tidy import tidied
from rovercheck.checker.drawn.grammar.syntax import Name
from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.lower.run import LoweredRun
from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.charts import WrittenChart
from rovercheck.spec_model.lang.domain import Num, chosen, integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var, all_of, const, flag, ite, var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.walk import nodes
from rovercheck.spec_model.lang.words import bit
from tests.drawn.random_plain_charts import random_plain_model
from tests.export.slx_runs import written_again
from tests.profiles import full
from tests.simulink.by_hand.models import ByHand, one_chart
from tests.simulink.packages import MODELS

ROWS = 60
SEEDS = range(120) if full() else range(0, 24, 2)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_random_chart_written_in_python_does_the_same(tmp_path: Path, seed: int) -> None:
    model = random_plain_model(seed, tmp_path)
    lowered = lowered_model(model, "one.slx", {"t": integer(0, 200)})
    try:
        written = written_again(lowered, tmp_path / "one.slx")
    except ModelError as error:
        assert str(error).count("C")
        return
    one, other, random = LoweredRun(lowered), LoweredRun(written), Random(seed)
    for row in range(ROWS):
        given = {"u": random.choice((-2, -1, 0, 1, 2, 3, 127)), "on": random.randrange(2)}
        assert one.step(given) == other.step(given), f"row {row}"
        now, then = one.active(), other.active()
        shared = now.keys() & then.keys()
        assert {n: now[n] for n in shared if not n.endswith(".last")} == {
            n: then[n] for n in shared if not n.endswith(".last")
        }


WITHOUT_WORDS = {
    "initialized": "is entered before the first step",
    "paths": "it leads to a dead end",
    "early": "is sent to the whole chart: send it to a state",
    "sent": "has actions on an event or a time",
    "times": "`after(3 ticks)` stands where no state is left",
    **dict.fromkeys(
        ("on_times", "alternatives", "nested", "units", "seen", "counted_edges"),
        "has actions on an event or a time",
    ),
    "regions_left": "is sent to the whole chart: send it to a state",
    "functions": "rounds a fraction, for which a chart has no word",
    "arithmetic": "rounds a fraction, for which a chart has no word",
    "raised": "has an event to other blocks: write to a datum",
    "changes": "whether `u` has changed",
    "own_changes": "whether `n` has changed",
    "graphical": "a path may go through junction",
    "triggered": "has 2 input events",
    "calls": "has an event to other blocks: write to a datum",
    "split": "has an event to other blocks: write to a datum",
    "generator": "it generates function calls",
    "shared store": "has an event to other blocks: write to a datum",
    "moore levels": "is a Moore chart: make it a classic one",
    "moore regions": "is a Moore chart: make it a classic one",
    "states held": "whether `i` has changed",
    "states reset": "whether `i` has changed",
    "function": "has the Simulink function f (SSID 3): write it as a MATLAB function",
}
"""What of the models by hand is refused, and in which words."""


@pytest.mark.parametrize("one", MODELS, ids=lambda one: one.name)
def test_a_model_by_hand_is_written_or_refused(tmp_path: Path, one: ByHand) -> None:
    read = one.read(tmp_path)
    lowered = lowered_model(read, "one.slx", {"u": chosen(sorted(set(one.inputs)))})
    if one.name in WITHOUT_WORDS:
        with pytest.raises(ModelError) as told:
            written_again(lowered, tmp_path / "one.slx")
        assert WITHOUT_WORDS[one.name] in str(told.value)
        return
    run = LoweredRun(written_again(lowered, tmp_path / "one.slx"))
    given = Random(one.name).choices(one.inputs, k=100)
    for number, (u, expected) in enumerate(zip(given, one.simulate(given), strict=True)):
        assert tuple(run.step({"u": u}).values()) == expected, f"row {number}"


# --- what would leave other states -------------------------------------------------------------------------


def drawn(folder: Path, draw: Callable[[WrittenChart], None]) -> DrawnModel:
    return read_model(one_chart(draw)().save(folder / "one.slx"))


def refused(folder: Path, draw: Callable[[WrittenChart], None]) -> str:
    lowered = lowered_model(drawn(folder, draw), "one.slx", {"u": integer(0, 3)})
    with pytest.raises(ModelError) as told:
        written_again(lowered, folder / "one.slx")
    return str(told.value)


def test_a_loop_that_is_drawn_outside_of_more_than_its_state_is_refused(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        outer, other = c.state("A"), c.state("B")
        inner = c.state("K", outer)
        c.transition(None, outer)
        c.transition(None, inner)
        c.transition(inner, inner, "[u == 1]", 1, c)
        c.transition(outer, other, "[u == 2]")

    assert "it is drawn so that C stays active" in refused(tmp_path, draw)


def test_a_region_that_enters_its_state_again_is_refused(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        both, other = c.state("P", parallel=True), c.state("B")
        first, second = c.state("R1", both, 1), c.state("R2", both, 2)
        c.transition(None, both)
        begin = {region: c.state("K", region) for region in (first, second)}
        for region, k in begin.items():
            m = c.state("M", region)
            c.transition(None, k)
            c.transition(k, m, "[u == 1]")
        c.transition(begin[first], both, "[u == 3]", 2, c)
        c.transition(both, other, "[u == 2]")

    assert "later regions are still to be executed" in refused(tmp_path, draw)


@pytest.mark.parametrize(("guard", "named"), [("u > K", True), ("u > K && after(2*K, tick)", False)])
def test_a_constant_keeps_its_name_unless_a_time_is_computed_with_it(
    tmp_path: Path, guard: str, named: bool
) -> None:
    """Such a time was refused, as the constant under its name was none."""

    def draw(c: WrittenChart) -> None:
        c.data("K", "constant", "int8", 2)
        a, b = c.state("A\nen: t = 1;"), c.state("B\nen: t = 2;")
        c.transition(None, a)
        c.transition(a, b, f"[{guard}]")

    lowered = lowered_model(drawn(tmp_path, draw), "one.slx", {"u": integer(0, 3)})
    written = written_again(lowered, tmp_path / "one.slx")
    [chart] = written.system.charts
    assert any(isinstance(one, Named) for one in nodes(*chart.guards)) == named
    run = LoweredRun(written)
    given = [run.step({"u": 3})["t"] for _ in range(6)]
    assert given == ([1, 2, 2, 2, 2, 2] if named else [1, 1, 1, 1, 2, 2])


# --- formulas ----------------------------------------------------------------------------------------------

x = var("x", integer(0, 15))
on = flag("on")


def same(one: Expr, other: Expr, *over: Var) -> bool:
    at: Sequence[dict[str, int]] = [{}]
    for each in over:
        at = [{**known, each.name: raw} for known in at for raw in each.domain.values]
    return all(evaluate(one, one_at) == evaluate(other, one_at) for one_at in at)


@pytest.mark.parametrize(
    ("written", "shown"),
    [
        (ite(on, 1, 0) > 0, "on"),
        (ite(on, 0, 1) == 0, "on"),
        (ite(on, const(False), x > 3), "!on && x > 3"),
        (ite(on, x > 3, on), "on && x > 3"),
        (ite(on, on, x > 3), "on || x > 3"),
        (~(x == 3), "x != 3"),
        (ite(bit(x, 2), 4, 0) + 0 != 0, "bit(x, 2)"),
        (x * Const(1, Num()) + 0, "x*1"),
        (sum((ite(bit(x, n), 2**n, 0) for n in (1, 2, 3)), const(1)), "x + (bit(x, 0) ? 0 : 1)"),
        (sum((ite(bit(x, n), 2**n, 0) for n in (1, 2)), ite(bit(x, 0), 1, 0)), "x mod 8"),
        (Apply(Op.DIV, (x * Const(1, Num()) / 2 + const("0.5"), Const(2, Num())), Num()), "(x*1 + 1) div 2"),
    ],
)
def test_a_formula_is_written_in_fewer_words(written: Expr, shown: str) -> None:
    made = tidied(written)
    assert str(made) == shown
    assert same(made, written, x, on)


def test_a_sum_that_is_no_mask_stays() -> None:
    total = ite(on, 3, 0) + ite(on, 4, 0)
    assert masked(total) is total and all_of(on) is on and Name("x")
