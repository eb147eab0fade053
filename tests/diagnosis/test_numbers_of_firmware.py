"""Numbers as firmware has them: in fewer digits, and times that are added up in single precision."""

from collections.abc import Callable
from fractions import Fraction
from math import ceil, floor
from random import Random
from struct import pack, unpack

import pytest

from rovercheck.checker.commands.shared.cause_text import untold
from rovercheck.checker.diagnosis.causes import cause_groups, followed
from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.evidence import EvidenceCollector, PartEvidence
from rovercheck.checker.diagnosis.hypotheses import age_changes, mutant_changes, rewrite_changes
from rovercheck.checker.diagnosis.trial import TrialBench
from rovercheck.checker.diagnosis.variant import with_changes
from rovercheck.checker.mutate.rounding import STEPS, rounded
from rovercheck.spec_model.abstraction import boards
from rovercheck.spec_model.abstraction.readings import AGES, StampReading
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import fixed
from rovercheck.spec_model.lang.expr import const, var
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.system import in_order
from tests.diagnosis.planted import Held, Row, diagnosis, inputs, recorded_on


def truncated(number: Fraction) -> int:
    return floor(number) if number >= 0 else ceil(number)


def away(number: Fraction) -> int:
    return truncated(number + (Fraction(1, 2) if number >= 0 else Fraction(-1, 2)))


ROUND: dict[str, Callable[[Fraction], int]] = {
    "rounded": away,
    "rounded to even": round,
    "cut off": truncated,
}


@pytest.mark.parametrize("way", ROUND)
@pytest.mark.parametrize("digits", STEPS)
@pytest.mark.parametrize("place", ["signal/x", "everywhere y", "where multiplied"])
def test_numbers_in_fewer_digits(place: str, digits: str, way: str) -> None:
    x, y = var("x", fixed(-5, 5, Fraction(1, 1000))), var("y", fixed(-50, 50, Fraction(1, 1000)))
    part = Block("gain", [assign(y, x * const(3))])
    [one] = [r for r in rounded(part) if r.site == place and r.new == f"{digits}, {way}"]
    run, step = Interpreter(in_order("gain", one.part)), STEPS[digits]

    def in_steps(number: Fraction) -> Fraction:
        return ROUND[way](number / step) * step

    for raw in (*range(-40, 41), *range(-1510, 1511, 5), -5000, 5000):
        run.step({"x": raw})
        given = Fraction(raw, 1000)
        wanted = 3 * in_steps(given) if place == "signal/x" else in_steps(3 * given)
        assert Fraction(run.data["y"], 1000) == wanted


def _of(part: str, changes: list[ChartChange], runs: list[list[Row]]) -> tuple[PartEvidence, TrialBench]:
    board = next(b for b in boards().values() if any(p.name == part for p in b.system.charts))
    made = with_changes(board, [c.key for c in changes])
    collector = EvidenceCollector(board)
    for number, rows in enumerate(runs):
        collector.add(recorded_on(made, rows, f"run {number}"))
    [found] = [one for one in collector.evidence().parts if one.name == part]
    return found, TrialBench(found)


BATTERY = boards()["board1"]
FALLS = (5, 10, 15, 20, 25, 30, 40, 45)
"""Seconds after which the assumed charge is 15 % to the last digit."""


@pytest.mark.parametrize("how", AGES)
def test_a_time_that_is_added_up_in_single_precision(how: str) -> None:
    """Whether 15 % is reached after exactly so long depends on how the sum was rounded so far."""
    every = list(age_changes(BATTERY, BATTERY.system, frozenset({"Monitor_battery"})))
    [planted] = [c for c in every if c.new == how and c.at == "signal/batt_age"]
    runs = [
        inputs("board1", [
            (10, {"battery_pct": 15 + 0.42 * fall}),
            (50 * fall + 3, {"batt_last_valid_ms": 200 - rest}),
        ])
        for fall in FALLS
        for rest in (0, 7)
    ]  # fmt: skip
    part, bench = _of("Monitor_battery", [planted], runs)

    def explains(change: ChartChange) -> bool:
        return bench.with_reading(change.reading).trial(part.group.cone(change.make())).full

    assert planted.key in [c.key for c in every if explains(c)]
    closed = [c for c in mutant_changes(part.group.system) if "<=" in c.text and "assumed_b" in c.text]
    assert closed and not any(map(explains, closed)), "after some of these times the sum is on the other side"


def test_single_precision_comes_before_a_limit_and_names_it() -> None:
    """Of one log that shows both a limit that is closed was told, and the sum was not even tried."""
    every = age_changes(BATTERY, BATTERY.system, frozenset({"Monitor_battery"}))
    [planted] = [c for c in every if c.new == "added up in single precision" and c.at == "signal/batt_age"]
    made = with_changes(BATTERY, [planted.key])
    falls: list[Held] = [
        [(10, {"battery_pct": 15 + 0.42 * fall}), (50 * fall + 3, {"batt_last_valid_ms": 200})]
        for fall in FALLS
    ]
    runs = [recorded_on(made, inputs("board1", held), f"{n}") for n, held in enumerate(falls)]
    collector = EvidenceCollector(BATTERY)
    for run in runs:
        collector.add(run)
    evidence = collector.evidence()
    name = next(name for name, behaviour in evidence.behaviours.items() if behaviour.deviations)
    one = next(run for run in runs if run.name == name)
    found = [d for d in evidence.behaviours[name].deviations if d.scope.part == "Monitor_battery"]
    groups = cause_groups(followed(BATTERY, [one]), found, ["Monitor_battery"], 10, at_once=1)
    [cause] = groups.causes
    assert cause.change is not None and cause.change.kind == "single-precision"
    assert cause.rivals and all(rival.kind != "single-precision" for rival in cause.rivals)
    assert "nothing in these logs tells it apart" in untold(cause, "logs")


def test_the_sum_is_that_of_c() -> None:
    reading = StampReading("batt_last_valid_ms", "added up in single precision")

    def single(number: float) -> float:
        found: float = unpack("f", pack("f", number))[0]
        return found

    total = 0.0
    for step in range(1, 500):
        total = single(total + single(0.02))
        assert reading.age(20 * step + 19) == Fraction(total) * 1000
    assert reading.age(10_000) != 10_000


def test_rounded_references_are_told_as_such() -> None:
    """They were told as two findings without a cause."""
    board, random = boards()["board2"], Random(3)
    [planted] = [
        c for c in rewrite_changes(board.system, {}, frozenset({"Actuation"}))
        if (c.kind, c.at, c.new) == ("rounded", "where multiplied", "tenths, rounded")
    ]  # fmt: skip
    ahead, aside = (0.1371, 0.3729, -0.2193, 0.5), (0.0, 0.3337, -0.0719)
    steps: list[tuple[int, Row]] = [(170, {"ay_norm": 0.0, "bx_norm": 0.0})]
    for _ in range(12):
        steps.append((20, {"ay_norm": random.choice(ahead), "bx_norm": random.choice(aside)}))
    parts = diagnosis("board2", planted.make(), inputs("board2", steps)).parts
    found = [c.key for part in parts if part.cause for c in part.cause.changes]
    assert found == [planted.key]


def test_what_comes_behind_a_loss_is_explained_too() -> None:
    """An initial value hides for how long the chart is lost: what is missing later was never asked about."""
    board = boards()["board2"]
    only = [c for c in mutant_changes(board.system) if c.chart in ("Actuation", "Motion_Supervision_2")]
    [pin] = [c for c in only if c.kind == "initial" and "stop_pin begins as false" in c.text]
    [braking] = [c for c in only if c.text == "`omega_ref_actuation := 0` is missing"]
    made = with_changes(board, [pin.key, braking.key])
    stamps = ("b1_data_last_valid_ms", "last_valid_b1_ms", "imu_last_valid_ms", "ble_last_valid_ms")
    silent = (15, dict.fromkeys(stamps, 1000))
    left, right = (inputs("board2", [(50, {"ay_norm": 0.0, "bx_norm": x}), silent]) for x in (1.0, -1.0))
    parts = diagnosis("board2", made.system, left, right, left[:40]).parts
    found = {c.key for part in parts if part.cause for c in part.cause.changes}
    assert found == {pin.key, braking.key}
