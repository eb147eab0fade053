"""What a change may make otherwise: outputs of its own region and data, and what is computed from them."""

from functools import cache
from random import Random

import pytest

from rovercheck.checker.conformance.recording import Raw, Recording
from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.hypotheses import (
    delay_changes,
    extra_changes,
    mutant_changes,
    rewrite_changes,
    signals_of,
    timer_changes,
)
from rovercheck.checker.diagnosis.influence import ChangeInfluence
from rovercheck.spec_model.abstraction import boards
from rovercheck.spec_model.lang.chart import parts
from rovercheck.spec_model.lang.errors import ModelError
from tests.diagnosis.planted import recorded, restless

BOARDS = boards()


@cache
def influence(board: str) -> ChangeInfluence:
    return ChangeInfluence(BOARDS[board].system, BOARDS[board].outputs)


@cache
def changes(board: str) -> tuple[ChartChange, ...]:
    own, only = BOARDS[board], frozenset(p.name for p in parts(BOARDS[board].system.components))
    return (
        *mutant_changes(own.system, only),
        *rewrite_changes(own.system, signals_of(own), only),
        *timer_changes(own.system, [3], only),
        *delay_changes(own.system, only, frozenset(o.var.name for o in own.outputs)),
        *extra_changes(own.system, only),
    )


def values(run: Recording, name: str) -> list[Raw | None]:
    return [value for block in run.blocks() for value in block.values[name]]


def differs(one: list[Raw | None], other: list[Raw | None]) -> bool:
    """Where both are compared: outputs have no meaning meanwhile, such as the heading when nothing turns."""
    return any(a != b for a, b in zip(one, other, strict=True) if a is not None and b is not None)


def test_what_is_not_compared_any_more_is_not_explained() -> None:
    """A stop from power-up on would explain every reference of the stick, which a stop gives up."""
    [one] = [c for c in changes("board1") if c.at == "data/actuate_emergency_stop/initial"]
    assert influence("board1").outputs(one) == {"actuate_emergency_stop"}


@pytest.mark.parametrize("board", ["board1", "board2"])
@pytest.mark.parametrize("seed", range(6))
def test_no_other_output_is_otherwise_with_a_change(board: str, seed: int) -> None:
    """On the whole board, where much depends on much."""
    rows = restless(board, seed, 250)
    drawn = recorded(board, BOARDS[board].system, rows, "drawn")
    tried = differing = 0
    for change in Random(seed).sample(changes(board), 40):
        try:
            run = recorded(board, change.make(), rows, "changed")
        except (ModelError, ValueError, AssertionError, TypeError, ZeroDivisionError):
            continue  # a search leaves it out, too
        tried += 1
        other = {o.name for o in BOARDS[board].outputs if differs(values(run, o.name), values(drawn, o.name))}
        differing += bool(other)
        assert other <= influence(board).outputs(change), change.key
    assert tried > 20 and differing


def change(kind: str, chart: str, at: str, old: str = "", new: str = "") -> ChartChange:
    own = [c for c in changes("board2") if (c.kind, c.chart, c.at) == (kind, chart, at)]
    return next(c for c in own if (not old or c.old == old) and (not new or c.new == new))


@pytest.mark.parametrize(
    ("one", "concerns"),
    [
        (("missing", "Monitors_2", "state/Rx.OK/entry/action-missing"), "rx_status"),
        (("shared", "Monitors_2", "buffers", "B2.rx_", "imu_"), "rx_status imu_status"),
        (("timer", "Monitors_2", "everywhere", "duration(!deg_imu) > 1 s"), "imu_status"),
        (("exchanged", "Monitors_2", "everywhere", "esp_age", "imu_age"), "esp_status imu_status"),
    ],
)
def test_regions_of_a_parallel_chart_are_apart(one: tuple[str, ...], concerns: str) -> None:
    statuses = {"rx_status", "imu_status", "esp_status", "b1_sup_status"}
    assert influence("board2").outputs(change(*one)) & statuses == set(concerns.split())
