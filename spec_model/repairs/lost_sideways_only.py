"""Obstacles: an object that comes nearer than 100 cm was not lost sideways, so no deviation follows."""

from dataclasses import replace
from functools import partial

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.lang.edit import also, edit_state
from rovercheck.spec_model.lang.expr import Var, all_of, flag
from rovercheck.spec_model.repairs import Repair
from rovercheck.spec_model.signals.board2 import SONARS, isClose, objDetected

PAIRS = {"12": 1, "21": 2, "23": 2, "32": 3}
"""The first sonar of each window."""


def came_near(i: int) -> Var:
    return flag(f"cameNear{i}", f"S{i} measured 100 cm or less since its object was last in range")


def sideways(chart: Chart) -> Chart:
    """A detection ends without a signal when its object came near, and so does a window that is open."""
    for i in (1, 2, 3):
        chart = edit_state(chart, f"WS{i}", partial(_remember, i))
        chart = edit_state(chart, f"Waiting_S{i}", partial(_lose, i))
    for pair, first in PAIRS.items():
        nearer = to("Waiting", when=SONARS[first - 1] <= 100)
        chart = also(chart, f"timerSonar{pair}.Fall1Detected", nearer, first=True)
    return chart


def _remember(i: int, state: State) -> State:
    near = came_near(i)
    note = assign(near, ~isClose[i - 1] & (near | (SONARS[i - 1] <= 100)))
    return replace(state, entry=(*state.entry, note), during=(*state.during, note))


def _lose(i: int, state: State) -> State:
    """J0 asks the distance of the step too: ``isClose`` and ``cameNear`` are those of the step before."""
    near, d, detected = came_near(i), SONARS[i - 1], objDetected[i - 1]
    close, lost = next(j for j in state.junctions if j.name == "J0").transitions
    assert lost.guard is not None
    outcome = [
        close,
        replace(lost, guard=all_of(lost.guard, ~near, d > 100)),
        to("J4", when=detected & near, do=[assign(detected, False)]),
    ]
    junctions = [Junction("J0", outcome) if j.name == "J0" else j for j in state.junctions]
    return replace(state, junctions=tuple(junctions))


_FLAG = "It expects a signal after every fall of the flag, also for an object that came near."

lost_sideways = Repair(
    name="lost-sideways-only",
    text=(
        "Waiting_Si sends no Fall event for an object that comes nearer than 100 cm, and a window ends when "
        "its first sonar measures 100 cm or less (E17)."
    ),
    fixes=("PB2-07-S1", "PB2-07-S2", "PB2-07-S3"),
    charts={"Obstacles": sideways},
    gives_up=dict.fromkeys((f"PB2-06-{pair}" for pair in PAIRS), _FLAG),
)
