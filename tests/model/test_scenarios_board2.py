"""The scenarios that tell the interpretations of the obstacle sentences apart, run on the charts as drawn.

A scenario is a list of blocks: a number of steps, and what the sonars measure meanwhile (301 cm, no
echo, where nothing is said).  The expected outputs start with step 2: in step 1 the chart is entered.
"""

from itertools import groupby

import pytest

from rovercheck.spec_model.ambiguity import fixed
from rovercheck.spec_model.board2.heading import headings, measured
from rovercheck.spec_model.board2.obstacles import obstacles_n
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.rover import systems

Block = tuple[int, dict[str, int]]
SYSTEM = systems()
NOMINAL = dict(d1=301, d2=301, d3=301, yaw=0)

# One of the values of the model for each set of distances that no limit divides.
TOUCHING, GAP, IN_RANGE, FAR = 70, 71, 200, 301


def run(system: System, blocks: list[Block], *signals: str) -> list[tuple[int, ...]]:
    """The signals in every step from 2 on."""
    rover = Interpreter(system)
    seen = []
    for steps, given in blocks:
        inputs = {name: {**NOMINAL, **given}.get(name, 0) for name in system.inputs}
        for _ in range(steps):
            rover.step(inputs)
            seen.append(tuple(rover.valuation()[s] for s in signals))
    return seen[1:]


def episodes(system: System, blocks: list[Block], signal: str = "B2Decision") -> list[tuple[int, int]]:
    """Value and number of steps, for each stay of the signal at one value."""
    return [(v, len(list(group))) for (v,), group in groupby(run(system, blocks, signal))]


FOREVER = 600

# id -> (blocks, stays of B2Decision: value and steps)
DECISIONS: dict[str, tuple[list[Block], list[tuple[int, int]]]] = {
    "E01 no rule from 71 to 100 cm": (
        [(50, dict(d1=GAP)), (5, {}), (50, dict(d2=GAP))], [(0, 104)]),
    "E02 exactly 70 stops and suspends the detection": (
        [(10, dict(d1=200, d3=70)), (10, dict(d3=70)), (20, dict(d2=200, d3=70))], [(1, 39)]),
    "E03 300 is in range": (
        [(25, dict(d1=300)), (30, dict(d2=200))], [(0, 25), (2, 29)]),
    "E03 100 is not in range": (
        [(25, dict(d1=100)), (5, {}), (30, dict(d2=200))], [(0, 59)]),
    "E05 toward the centre sonar: straight on for 25 steps": (
        [(10, dict(d2=200)), (50, dict(d1=200))], [(0, 10), (3, 25), (0, 24)]),
    "E08 no time limit on a deviation": (
        [(10, dict(d1=200)), (FOREVER, dict(d2=200))], [(0, 10), (2, FOREVER - 1)]),
    "E10 the stop ends by itself": (
        [(10, {}), (10, dict(d2=TOUCHING)), (10, {})], [(0, 10), (1, 10), (0, 9)]),
    "E12 the stop comes one step after the obstacle": (
        [(5, {}), (5, dict(d2=TOUCHING))], [(0, 5), (1, 4)]),
    "E14 149 steps after S1 left are within the window": (
        [(10, dict(d1=200)), (149, {}), (5, dict(d2=200))], [(0, 159), (2, 4)]),
    "E14 150 steps after S1 left are not": (
        [(10, dict(d1=200)), (150, {}), (5, dict(d2=200))], [(0, 164)]),
    "E15 the second sonar may detect already": (
        [(10, dict(d1=200, d2=200)), (5, dict(d2=200))], [(0, 10), (2, 4)]),
    "E16 a second loss does not restart the window": (
        [(10, dict(d1=200)), (120, {}), (10, dict(d1=200)), (70, {}), (10, dict(d2=200))], [(0, 219)]),
    "E17 any exit from the range counts": (
        [(10, dict(d1=200, d2=200)), (5, dict(d1=GAP, d2=200))], [(0, 10), (2, 4)]),
    "E18 a detection is kept across a stop, 20 steps": (
        [(10, dict(d1=200)), (10, dict(d1=TOUCHING)), (20, {}), (5, dict(d2=200))],
        [(0, 10), (1, 10), (0, 20), (2, 4)]),
    "E18 a detection is kept across a stop, 145 steps": (
        [(10, dict(d1=200)), (10, dict(d1=TOUCHING)), (145, {}), (5, dict(d2=200))],
        [(0, 10), (1, 10), (0, 145), (2, 4)]),
    "E19 a signal during a deviation is lost": (
        [(10, dict(d1=200, d2=200)), (10, dict(d2=200, d3=200)), (10, dict(d2=200))], [(0, 10), (2, 19)]),
    "E20 of two signals the left one counts": (
        [(10, dict(d1=200, d2=200, d3=200)), (10, dict(d2=200))], [(0, 10), (2, 9)]),
    "E27 any sonar suspends the detection": (
        [(10, dict(d1=200)), (3, dict(d1=200, d3=TOUCHING)), (7, dict(d3=TOUCHING)), (145, {}),
         (5, dict(d2=200))],
        [(0, 10), (1, 10), (0, 145), (2, 4)]),
}  # fmt: skip


@pytest.mark.parametrize("scenario", DECISIONS)
def test_the_decision_under_the_default_reading(scenario: str) -> None:
    blocks, stays = DECISIONS[scenario]
    assert episodes(SYSTEM["obstacles_n"], blocks) == stays


def test_E02_the_detection_flags_are_frozen_at_70() -> None:
    blocks = [(10, dict(d1=200, d3=70)), (10, dict(d3=70)), (20, dict(d2=200, d3=70))]
    flags = run(SYSTEM["obstacles_n"], blocks, "obj1Detected", "obj2Detected", "obj3Detected")
    assert set(flags) == {(0, 0, 0)}


# --- the heading [spec §3.4.1 (1)] ----------------------------------------------------------------

five_degrees = fixed({}).system(in_order("heading_in_5_degrees", obstacles_n(measured(*headings(5)))))
SEEN_LEFT: Block = (10, dict(d1=200, d2=200))


def turning(*yaws: int) -> list[Block]:
    return [
        SEEN_LEFT,
        *((5, dict(d2=200, yaw=y % 360)) for y in yaws),
        (300, dict(d2=200, yaw=yaws[-1] % 360)),
    ]


def test_E06_a_turn_of_40_degrees_does_not_end_the_deviation() -> None:
    assert episodes(five_degrees, turning(0, -15, -30, -40)) == [(0, 10), (2, 319)]


def test_E06_a_turn_of_45_degrees_does() -> None:
    assert episodes(five_degrees, turning(0, -15, -30, -45)) == [(0, 10), (2, 14), (0, 305)]


def test_E06_a_turn_of_140_degrees_the_other_way_ends_it_too() -> None:
    yaws = range(0, 141, 20)
    assert episodes(five_degrees, turning(*yaws)) == [(0, 10), (2, 5 * len(yaws) - 6), (0, 305)]


def test_E07_the_initial_direction_is_that_of_the_decision() -> None:
    blocks = [(10, dict(d1=200)), (10, {}), (5, dict(yaw=20)), (5, dict(d2=200, yaw=20))]
    assert run(five_degrees, blocks, "B2Decision", "targetAngle")[-1] == (2, 335)


# --- selection and command [spec Figs 12, 24, 28] --------------------------------------------------

NORMAL, GO_LEFT, GO_RIGHT, ESTOP = 0, 2, 3, 7


@pytest.mark.parametrize(
    ("scenario", "blocks", "decision", "command"),
    [
        ("E04 a stop is CMD_ESTOP", [(5, dict(d2=TOUCHING))], 1, ESTOP),
        ("E04 toward sonar 1 is CMD_GO_LEFT", [(9, dict(d1=200, d2=200)), (5, dict(d2=200))], 2, GO_LEFT),
        ("E04 toward sonar 3 is CMD_GO_RIGHT", [(9, dict(d3=200, d2=200)), (5, dict(d2=200))], 4, GO_RIGHT),
        ("E09 Board 1 degraded: stop at 200", [(5, dict(d2=200, deg_mask_b1=1))], 6, ESTOP),
        ("E09 Board 1 critical: stop at 200", [(5, dict(d2=200, crit_mask_b1=1))], 6, ESTOP),
        ("E09 Board 2 drives: stop at 200", [(5, dict(d2=200, autorized_prev=1))], 6, ESTOP),
        ("E09 faults of Board 2 only: no stop", [(5, dict(d2=200))], 0, NORMAL),
        ("E09 degraded without obstacle", [(5, dict(deg_mask_b1=1))], 5, NORMAL),
        ("E31 straight on is CMD_NORMAL", [(9, dict(d1=200, d2=200)), (5, dict(d1=200))], 3, NORMAL),
        ("E32 both charts run", [(99, dict(d2=TOUCHING, deg_mask_b1=1)), (1, dict(d2=TOUCHING))], 1, ESTOP),
    ],
)  # fmt: skip
def test_the_command_under_the_default_reading(
    scenario: str, blocks: list[Block], decision: int, command: int
) -> None:
    assert run(SYSTEM["obstacles"], blocks, "B2Dec", "command")[-1] == (decision, command)


# --- the order of effects in one step ---------------------------------------------------------------


def test_the_order_of_effects_in_one_step() -> None:
    """The obstacles at S1 and S3 vanish together: one step ends the stop and begins a deviation."""
    system = SYSTEM["obstacles_n"]
    rover = Interpreter(system)
    for steps, d1, d3 in ((5, IN_RANGE, FAR), (5, IN_RANGE, TOUCHING), (2, FAR, FAR)):
        for _ in range(steps):
            fired = rover.step({name: dict(d1=d1, d2=200, d3=d3).get(name, 0) for name in system.inputs})
    assert [(f.event, *f.source[-2:], f.target[-1]) for f in fired] == [
        ("safe", "B2Decisions", "InEmergency", "Waiting"),
        (None, "distance_70", "check_sonars_for_moving_again", "check_sonars_for_stopping"),
        ("Fall1", "timerSonar12", "Waiting", "Fall1Detected"),
        (None, "Waiting_S1", "WS1", "WS1"),
        (None, "Waiting_S2", "WS2", "WS2"),
        ("moveToS1", "B2Decisions", "Waiting", "MoveToS1"),
        (None, "timerSonar12", "Fall1Detected", "Waiting"),
    ]


def test_a_signal_in_the_last_step_of_a_stop_is_lost() -> None:
    """S1 saw the obstacle go beyond 300 cm in the step in which the stop is not yet lifted."""
    blocks = [(5, dict(d1=200, d2=200)), (5, dict(d1=TOUCHING, d2=200)), (10, dict(d2=200))]
    assert episodes(SYSTEM["obstacles_n"], blocks) == [(0, 5), (1, 5), (0, 9)]


@pytest.mark.parametrize(
    ("signal", "values"),
    [
        ("stop", [0, 1, 1, 0, 0]),           # recomputed from the distances of the same step
        ("B2Decision", [0, 0, 1, 1, 0]),     # its guard reads what the step before left
        ("isClose1", [0, 0, 0, 1, 1]),       # recomputed after the guards of Waiting_S1
        ("obj1Detected", [0, 0, 0, 0, 1]),   # its guard reads what the step before left
    ],
)  # fmt: skip
def test_what_a_guard_reads_of_the_step_before(signal: str, values: list[int]) -> None:
    blocks = [(2, {}), (2, dict(d1=TOUCHING)), (2, dict(d1=IN_RANGE))]
    assert [v for (v,) in run(SYSTEM["obstacles_n"], blocks, signal)] == values


def test_the_first_step_enters_the_charts_and_tests_nothing() -> None:
    rover = Interpreter(SYSTEM["obstacles"])
    rover.step({name: dict(d1=70, d2=70, d3=70).get(name, 1) for name in SYSTEM["obstacles"].inputs})
    at = rover.valuation()
    assert (at["stop"], at["B2Decision"], at["B2DecDegraded"], at["B2Dec"]) == (1, 0, 5, 5)
