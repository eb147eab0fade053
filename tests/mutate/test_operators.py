"""Every operator of mutants on a small chart, and that the original is left as it was."""

import pytest

from rovercheck.checker.mutate.formulas import slips
from rovercheck.checker.mutate.mutants import Mutant, mutants
from rovercheck.checker.mutate.product import same
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block, Chart, Enabled, State, to
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.edit import in_system
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Expr, flag, var
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.place import Place
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.lang.time import ms
from rovercheck.spec_model.lang.words import duration
from tests.mutate.lamp import lamps, level, press

ALL = {m.id: m for m in mutants(lamps)}


@pytest.mark.parametrize(
    ("id", "text"),
    [
        ("Lamp/arrow/Off.1/guard-negated", "`[press && level >= 2]` is negated"),
        ("Lamp/arrow/Off.1/guard-true", "`[press && level >= 2]` is always true"),
        ("Lamp/arrow/Off.1/guard-false", "`[press && level >= 2]` is never true: the transition is missing"),
        ("Lamp/arrow/Off.1/and-or", "`press && level >= 2` is joined by or"),
        ("Lamp/arrow/Off.1/dropped", "`press` is missing in `press && level >= 2`"),
        ("Lamp/arrow/Off.1/dropped#2", "`level >= 2` is missing in `press && level >= 2`"),
        ("Lamp/arrow/Off.1/comparison", "`level >= 2` is written with >"),
        ("Lamp/arrow/Off.1/limit-up", "`2` is 3 in `level >= 2`"),
        ("Lamp/arrow/Off.1/limit-down", "`2` is 1 in `level >= 2`"),
        ("Lamp/arrow/Off.1/priority", "the transitions 1 and 2 are tested in the other order"),
        ("Lamp/arrow/On.2/target", "the transition to Night leads to Off"),
        ("Lamp/default.1/target", "the transition to Off leads to On"),
        ("Lamp/arrow/On.1/timer-up", "`after(2 ticks)` is `after(3 ticks)`"),
        ("Lamp/arrow/On.1/timer-down", "`after(2 ticks)` is `after(1 tick)`"),
        ("Lamp/arrow/Night.1/arrow-missing", "the transition to Off is missing"),
        ("Lamp/state/On/entry/action-missing", "`lit := true` is missing"),
        ("Lamp/state/On/entry/value", "`lit := true` is `lit := false`"),
        ("Lamp/state/On/entry/value#2", "`shade := WARM` is `shade := COLD`"),
        ("Alarm/block/bit", "in `alarm := lit && shade != DARK && bit(level, 0)`, "
                            "`bit(level, 0)` looks at bit 1"),
        ("Alarm/block/member", "in `alarm := lit && shade != DARK && bit(level, 0)`, "
                               "`DARK` is WARM in `shade != DARK`"),
        ("Alarm/block/condition-negated", "`if alarm` is negated"),
        ("Alarm/block/field", "`seen := level` is `seen := seen`"),
        ("Alarm/block/dead", "the block Alarm never executes and writes nothing"),
        ("Lamp/chart/dead", "the chart Lamp never executes and writes nothing"),
        ("Alarm/wire/lit/dead-wire", "Alarm always reads false as lit, which Lamp writes"),
        ("Alarm/data/seen/initial", "seen begins as 1, not as 0"),
        ("Lamp/order/Alarm/order", "Alarm executes before Lamp"),
    ],
)  # fmt: skip
def test_an_operator_makes_its_fault(id: str, text: str) -> None:
    assert ALL[id].text == text
    assert not same(lower(ALL[id].system), lower(lamps))


def test_ids_are_distinct_and_name_places() -> None:
    assert len(ALL) == len(mutants(lamps)) > 60
    places = [m.place for m in ALL.values()]
    assert all(isinstance(p, Place) and p.path == "tests/mutate/lamp.py" for p in places)


def test_a_part_of_an_enabled_subsystem_may_execute_always() -> None:
    """Also one between others, and in a subsystem within another; a board is no such subsystem."""
    a, b, c, d = (Block(name.upper(), [assign(v := flag(name), ~v)]) for name in "abcd")
    on, running = flag("on"), flag("running")
    inside = Enabled(running, a, b, c)
    system = in_order("nested", Enabled(press, Enabled(on, inside), name="Board 1"), Enabled(on, d))
    found = {m.id: m for m in mutants(system) if m.operator == "enabled"}
    assert list(found) == [f"{name}/block/enabled" for name in "ABCD"]
    assert found["B/block/enabled"].text == "the block B executes in every step, enabled or not"
    around = Enabled(on, Enabled(running, a)), b, Enabled(on, Enabled(running, c))
    taken_out = in_order("b", Enabled(press, *around), Enabled(on, d))
    assert same(lower(found["B/block/enabled"].system), lower(taken_out))
    always = in_order("d", Enabled(press, Enabled(on, inside)), d)
    assert same(lower(found["D/block/enabled"].system), lower(always))


def test_every_mutant_has_the_variables_of_the_original() -> None:
    """Properties keep their meaning: what is no longer written or read is there nevertheless."""
    for mutant in ALL.values():
        assert mutant.system.written.keys() == lamps.written.keys(), mutant.id
        assert mutant.system.inputs.keys() == lamps.inputs.keys(), mutant.id


def test_what_is_never_written_keeps_its_value() -> None:
    """An output that nobody writes was an input of the mutant, with any value."""
    system = in_order("one", Block("One", [assign(var("out", integer(0, 3)), 2)]))
    [missing] = [m for m in mutants(system) if m.operator == "action-missing"]
    assert "out" in missing.system.written and "out" not in missing.system.inputs
    assert lower(missing.system)


def words(expr: Expr) -> list[str]:
    return [f"{s.operator}: {s.whole}" for s in slips(expr, 20)]


def test_slips_reach_into_timers() -> None:
    assert words(duration(press & (level == 1)) > 40 * ms) == [
        "timer-up: duration(press && level == 1) > 60 ms",
        "timer-down: duration(press && level == 1) > 20 ms",
        "comparison: duration(press && level == 1) >= 40 ms",
        "and-or: duration(press || level == 1) > 40 ms",
        "dropped: duration(level == 1) > 40 ms",
        "dropped: duration(press) > 40 ms",
        "comparison: duration(press && level != 1) > 40 ms",
        "limit-up: duration(press && level == 2) > 40 ms",
        "limit-down: duration(press && level == 0) > 40 ms",
    ]


def test_regions_that_share_data_are_exchanged() -> None:
    a, b = flag("a"), flag("b")
    regions = [
        State("One", during=[assign(a, press)], states=[State("X")], default="X"),
        State("Two", during=[assign(b, a)], states=[State("Y")], default="Y"),
    ]
    chart = Chart("Both", regions, parallel=True)
    found = [m for m in mutants(in_order("both", chart)) if m.operator == "order"]
    assert [m.id for m in found] == ["Both/regions.1/order"]
    assert [s.name for s in found[0].system.charts[0].root.states] == ["Two", "One"]


def test_transitions_of_a_junction_are_faulty_too() -> None:
    from rovercheck.spec_model.lang.chart import Junction

    chart = Chart(
        "Way",
        [State("A", transitions=[to("j", when=press)]), State("B")],
        default="A",
        junctions=[Junction("j", [to("A", when=level == 0), to("B")])],
    )
    ids = {m.id for m in mutants(in_order("way", chart))}
    assert {"Way/arrow/j.1/guard-negated", "Way/arrow/j.2/target", "Way/arrow/j.1/priority"} <= ids


def test_a_part_that_is_named_is_the_only_one() -> None:
    assert {m.part for m in mutants(lamps, ["Alarm"])} == {"Alarm"}


def test_a_mutant_that_is_no_chart_is_refused() -> None:
    chart = Chart("C", [State("A", transitions=[to("B", when=press)]), State("B")], default="A")
    system = in_order("c", chart)
    [wrong] = [m for m in mutants(system) if m.id == "C/arrow/A.1/target"]
    with pytest.raises(ModelError):
        lower(wrong.system)


def test_the_original_is_unchanged() -> None:
    one: Mutant = ALL["Lamp/arrow/Off.1/guard-negated"]
    put = in_system(one.system, "Lamp", lambda _: lamps.charts[0])
    assert same(lower(put), lower(lamps))
