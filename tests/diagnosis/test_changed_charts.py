"""Systems with the changes of a variant: every limit that they have is met from both sides, and in time."""

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import pytest

from rovercheck.checker.diagnosis.changed_charts import ChartChanges
from rovercheck.checker.diagnosis.variant import BoardVariant, WrittenChange
from rovercheck.checker.diagnosis.wider_inputs import widened
from rovercheck.checker.engines import Limits
from rovercheck.checker.model.variant import Variant, as_declared
from rovercheck.checker.verify.decide import Task, decide
from rovercheck.properties.forms import Always, Property
from rovercheck.spec_model.abstraction import boards
from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import Domain, Num, chosen, fixed
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Expr, Var, const, flag, implies, ite
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.lang.words import absolute, minimum
from rovercheck.spec_model.rover import systems

loud, update = flag("loud"), flag("update")
FEW = chosen([-110, -10, 0, 59, 60, 61, 110])
DENSE = fixed(-110, 110, Fraction(1, 4))
STEP = const(20, "ms")


def judged(name: str, environment: Block, condition: Expr) -> System:
    return in_order(name, environment, Block("Judge", [assign(loud, condition)]))


def verdict(system: System, must: Expr) -> str:
    prop = as_declared(Property("P", "It must.", Always(must), ("R",), system.name), system)
    [result] = decide(Task(system, (prop,)), {system.name: system}, "explicit", Limits())
    return result.verdict.word


# --- values beside a limit ------------------------------------------------------------------------


def oven(domain: Domain, condition: Callable[[Var], Expr]) -> System:
    """A reading that is kept, and an alarm on a condition of it."""
    reading, warmth = Var("reading", domain), Var("warmth", domain)
    readings = Block("Readings", [when(update, [assign(warmth, reading)])])
    return judged("oven", readings, condition(warmth))


def at(condition: Callable[[Expr, Fraction], Expr], limit: Fraction) -> Callable[[Var], Expr]:
    return lambda warmth: condition(warmth, limit)


CONDITIONS: dict[str, Callable[[Expr, Fraction], Expr]] = {
    "closed": lambda warmth, limit: warmth >= limit,
    "open": lambda warmth, limit: warmth > limit,
    "below": lambda warmth, limit: warmth < limit,
    "either side": lambda warmth, limit: absolute(warmth) >= limit,
    "doubled": lambda warmth, limit: warmth + warmth > limit * 2,
}
ASKED: list[Callable[[Expr], Expr]] = [
    lambda warmth: implies(warmth >= 60, loud),
    lambda warmth: implies(warmth < 60, ~loud),
    lambda warmth: implies(loud, warmth > 60),
    lambda warmth: implies(~loud, warmth <= 60),
    lambda warmth: implies(warmth <= 0, loud),
]


@pytest.mark.parametrize("kind", CONDITIONS)
def test_a_verdict_on_few_values_is_that_on_all_whatever_the_limit_is(kind: str) -> None:
    condition = CONDITIONS[kind]
    told = set[str]()
    for limit in (Fraction(half, 2) for half in (0, 3, *range(117, 124), 173)):
        drawn = oven(FEW, at(condition, Fraction(60)))
        few = widened(oven(FEW, at(condition, limit)), drawn)
        every = oven(DENSE, at(condition, limit))
        for asked in ASKED:
            found, right = (verdict(s, asked(s.written["warmth"])) for s in (few, every))
            assert found == right, (limit, asked(every.written["warmth"]))
            told.add(found)
    assert told == {"proved", "violated"}


def test_a_limit_that_is_there_as_drawn_needs_no_other_values() -> None:
    drawn = oven(FEW, lambda warmth: (warmth >= 60) & (warmth < 100))
    changed = oven(FEW, lambda warmth: (warmth > 60) & (warmth < 100))
    assert widened(changed, drawn).written["warmth"].domain == FEW


def test_beyond_the_ends_of_a_range_nothing_is_measured() -> None:
    percent = fixed(0, 100, 1)
    drawn, changed = (oven(percent, at(CONDITIONS["closed"], Fraction(limit))) for limit in (60, 120))
    assert widened(changed, drawn).written["warmth"].domain == percent


# --- ages that are counted further ------------------------------------------------------------


def link(last_ms: int, condition: Callable[[Expr], Expr]) -> System:
    """An age that stops growing, and an alarm on a condition of it."""
    age = Var("age", fixed(0, last_ms, 20, "ms"))
    clock = Block(
        "Clock", [when(update, [assign(age, 0)], [assign(age, minimum(age + STEP, const(last_ms, "ms")))])]
    )
    return judged("link", clock, condition(age))


AGES: dict[str, Callable[[Expr, int], Expr]] = {
    "open": lambda age, limit: age > limit,
    "closed": lambda age, limit: age >= limit,
    "rest": lambda age, limit: const(1000, "ms") - age < 1000 - limit,
    "with what it means": lambda age, limit: age * const(Fraction(1, 1000), "°C/ms") > Fraction(limit, 1000),
    "only while on": lambda age, limit: ite(update, const(0, "ms"), age) > limit,
}


@pytest.mark.parametrize("limit", [60, 120, 140, 150, 160, 400])
@pytest.mark.parametrize("kind", AGES)
def test_an_age_is_counted_to_where_the_new_limit_decides(kind: str, limit: int) -> None:
    condition = AGES[kind]
    drawn = link(140, lambda age: condition(age, 120))
    few = widened(link(140, lambda age: condition(age, limit)), drawn)
    every = link(2000, lambda age: condition(age, limit))
    for must in (~loud, implies(few.written["age"] > 120, loud), implies(loud, few.written["age"] > 120)):
        assert verdict(few, must) == verdict(every, must)
    assert verdict(few, ~loud) == "violated"  # the alarm is reached at all


# --- the rover's systems --------------------------------------------------------------------------


def changes(*rows: tuple[str, ...], board: str = "board1") -> ChartChanges:
    written = BoardVariant(board, tuple(WrittenChange(*row) for row in rows))
    return ChartChanges(Path("variant.toml"), written, boards()[board])


LATER = ("limit", "Monitor_reception", "arrow/decide.1 guard", "rx_age > 120", "rx_age > 200")


def test_a_change_is_made_in_every_system_that_has_the_chart() -> None:
    made = changes(LATER)
    concerned = [s for s in systems().values() if made.touches(s)]
    assert {"reception", "reception_exact", "reception_ms", "relay_links", "board1"} <= {
        s.name for s in concerned
    }
    for system in concerned:
        [chart] = [c for c in made.changed(system).charts if c.name == "Monitor_reception"]
        assert any(" > 200" in str(e) for e in chart.expressions)


def test_the_age_of_a_link_goes_on_beyond_a_later_limit() -> None:
    found = changes(LATER).changed(systems()["reception"]).written["rx_age"].domain
    assert isinstance(found.sort, Num)
    assert found.high * found.sort.resolution > 200


def test_what_no_system_shows_is_named() -> None:
    made = changes(
        LATER, ("stamp", "Monitor_reception", "stamp/b2_data_last_valid_ms", "as it is given", "in 16 bits")
    )
    assert made.name == "with variant.toml but for change 2"
    assert made.board_name == "with variant.toml", "compare and check-log follow it"
    variant = Variant({}, changes=made)
    assert (variant.name, variant.board_name) == (made.name, made.board_name)
    assert "verdicts leave it out, as the charts see ages and no stamps" in "".join(made.notes())


def test_a_signal_that_a_system_does_not_have_is_refused_there() -> None:
    other = ("signal", "Monitor_wheel_RL", "arrow/decide.1 guard", "hasNoFeedback_RL", "rx_slow")
    system = systems()["wheel_RL"]
    with pytest.raises(ModelError, match=r"change 1 .* cannot be made in wheel_RL: "):
        changes(other).changed(system)
    variant = Variant({}, changes=changes(other))
    assert "wheel_RL" not in list(variant.systems())
    of_wheel = [p for p in variant.properties().values() if p.on == "wheel_RL"]
    asked, left = variant.askable(of_wheel)
    assert not asked
    [why] = left
    assert f"{of_wheel[0].id}, " in why
    assert "left out: variant.toml, change 1 (signal in Monitor_wheel_RL) cannot be made" in why


def test_a_number_between_the_steps_of_a_datum_is_refused_in_the_words_of_the_change() -> None:
    """It was "it reads (the number 7/2), which the system does not have"."""
    slower = ("constant", "updateSafetyLimits", "block V_MAX_MANEUVER", "0.8", "0.7")
    made = changes(slower)
    told = r"change 1 \(constant in updateSafetyLimits\) cannot be made in references: 0\.7 lies between"
    with pytest.raises(ModelError, match=told):
        made.changed(systems()["references"])


def test_a_change_of_one_monitor_leaves_systems_of_the_others_as_they_are() -> None:
    never = ("always", "Monitors_2", "arrow/BLE.DEG.2/guard-true", "as drawn", "as drawn")
    made = changes(never, board="board2")
    assert made.touches(systems()["monitors_2_BLE_exact"])
    assert not made.touches(systems()["monitors_2_IMU_exact"])
