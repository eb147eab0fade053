"""How the obstacle chart knows that the rover has turned, under other interpretations (E06, E07)."""

from rovercheck.spec_model.ambiguity import under
from rovercheck.spec_model.board2.heading import angleCalculator, either_way, turned_45
from rovercheck.spec_model.interpretations import Alternative, Change, alternative
from rovercheck.spec_model.lang.action import Action, assign, when
from rovercheck.spec_model.lang.change import before, doing, formula, in_state, then
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.domain import Num, fixed
from rovercheck.spec_model.lang.expr import Var, var
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.words import absolute, maximum, minimum, named, wrap
from rovercheck.spec_model.signals.board2 import B2Decision, objDetected

CHART = "Obstacles"
TURNED = "gyroTargetDiff(yaw, targetAngle)"
TURNS = ("MoveToS1", "MoveToS3")
PAIRS = ("12", "21", "23", "32")


def measures(system: System) -> bool:
    """The obstacle chart reads the heading; else the test of it is a free input."""
    return any(chart.name == CHART and "yaw" in chart.read for chart in system.charts)


def free(system: System) -> bool:
    return not measures(system)


# --- the initial direction (E07) -------------------------------------------------------------------------


def remembered(yaw: Var, what: str) -> Var:
    return Var(f"yaw_{what}", yaw.domain, yaw.init, "yaw as remembered for the initial direction (E07)")


def earlier(at_the_fall: bool) -> Change:
    """The target is 45 degrees from the yaw at the fall, or at the first detection before it."""

    def change(chart: Chart) -> Chart:
        yaw = chart.read["yaw"]
        initial = remembered(yaw, "initial")
        for pair in PAIRS:
            window, of_first = remembered(yaw, f"window{pair}"), remembered(yaw, f"detected{pair[0]}")
            opens = _for_a_turn(pair, assign(window, yaw if at_the_fall else of_first))
            signals = _for_a_turn(pair, assign(initial, window))
            chart = doing(f"timerSonar{pair}.Waiting", "Fall1Detected", before(opens))(chart)
            chart = doing(f"timerSonar{pair}.J2", "J3", before(signals))(chart)
        for i in (1, 2, 3):
            if not at_the_fall:
                note = when(~objDetected[i - 1], [assign(remembered(yaw, f"detected{i}"), yaw)])
                chart = doing(f"Waiting_S{i}.J1", "J2", before(note))(chart)
        return formula("angleCalculator(yaw, B2Decision)", angleCalculator(initial, B2Decision))(chart)

    return change


def _for_a_turn(pair: str, action: Action) -> Action:
    """What is done for a pair for which the rover turns: for one at the centre sonar, only by E05."""
    return action if pair in ("12", "32") else when(under("E05", "OPPOSITE"), [action])


# --- the end of a turn (E06) -------------------------------------------------------------------------------

FULL_TURN = 360
"""A sum that stands for every larger one, in degrees."""


def within_12(chart: Chart) -> Chart:
    test = named(TURNED, absolute(wrap(_target(chart) - chart.read["yaw"])) <= 12)
    return formula(TURNED, test)(chart)


def _target(chart: Chart) -> Var:
    [(target, _)] = chart.local_to
    return target


def by_sum(chart: Chart) -> Chart:
    """The changes of yaw are added up, from one step to the next, while the rover turns."""
    yaw = chart.read["yaw"]
    assert isinstance(yaw.domain.sort, Num)
    sums = fixed(-FULL_TURN, FULL_TURN, yaw.domain.sort.resolution, "°")
    so_far = var("turn_so_far", sums, 0, "sum of the changes of yaw in this turn (E06 PASS)")
    last = Var("yaw_before", yaw.domain, yaw.init, "yaw in the step before, during a turn (E06 PASS)")
    turn = so_far + wrap(yaw - last)
    kept = maximum(minimum(turn, FULL_TURN), -FULL_TURN)
    for state in TURNS:
        chart = in_state(
            state,
            entry=then(assign(so_far, 0), assign(last, yaw)),
            during=then(assign(so_far, kept), assign(last, yaw)),
            exit=then(assign(so_far, 0), assign(last, last.init)),
        )(chart)
    return formula(TURNED, named(TURNED, either_way(turn <= -45, turn >= 45)))(chart)


def _alternatives(name: str, text: str, at_the_fall: bool) -> tuple[Alternative, ...]:
    return (
        alternative("E07", name, text, CHART, earlier(at_the_fall), among=measures),
        alternative("E07", name, "A free test may be true in the step of entry.", CHART,
            formula(TURNED, named(TURNED, turned_45)), among=free),
    )  # fmt: skip


ALTERNATIVES = (
    *_alternatives("AT-FALL", "The turn is counted from the yaw when the first sonar lost the object.", True),
    *_alternatives("AT-FIRST-DETECTION", "The turn is counted from the yaw at the first detection.", False),
    alternative("E06", "TOL-12", "The turn ends at most 12 degrees from the target.", CHART,
        within_12, among=measures),
    alternative("E06", "PASS", "The turn ends when the changes of yaw add up to 45 degrees.", CHART,
        by_sum, among=measures),
)  # fmt: skip
