"""How the obstacle chart knows that the rover has turned by 45 degrees: exactly, or as a free predicate.

The chart reads the heading only in ``gyroTargetDiff`` and in ``angleCalculator``, which stores the
target of the deviation [seed §3.4.1 (1)].  Checked alone, the chart meets an arbitrary yaw in every
step.  Then the heading may be replaced by one input, ``turned_45``, without losing or adding a run:

* the test is examined only in MoveToS1 and MoveToS3, and nothing else reads yaw or the target;
* in the step of entry it is false, because the target is 45 degrees away from the yaw of that very
  step: ``after(1 tick)`` says so (unless the initial direction is an earlier one, E07);
* in every later step some yaw makes it true and some makes it false, whatever the target is.

Multiplying the timers of the chart by a grid of headings would gain nothing but states.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from rovercheck.spec_model.lang.action import Action, assign, when
from rovercheck.spec_model.lang.domain import Num, chosen, fixed
from rovercheck.spec_model.lang.expr import TRUE, Expr, Var, flag, ite, var
from rovercheck.spec_model.lang.time import tick
from rovercheck.spec_model.lang.words import absolute, after, maximum, minimum, named, wrap
from rovercheck.spec_model.readings import choose, under
from rovercheck.spec_model.signals.board2 import B2Decision, number

turned_45 = flag("turned_45", "the rover has turned 45 degrees toward the sonar that detected first")


@dataclass(frozen=True)
class Heading:
    """What the chart needs: the guard that ends a turn, and what its states and windows remember.

    ``store_target``, ``follow`` and ``forget`` are entry, during and exit actions of a turn.
    """

    turned: Expr
    store_target: tuple[Action, ...] = ()
    follow: tuple[Action, ...] = ()
    forget: tuple[Action, ...] = ()
    local_to: Sequence[tuple[Var, Sequence[str]]] = ()
    yaw: Var | None = None

    def at_detection(self, i: int, detected: Var) -> list[Action]:
        """Si begins to detect an object (E07 AT-FIRST-DETECTION)."""
        if self.yaw is None:
            return []
        first = under("E07", "AT-FIRST-DETECTION") & ~detected
        return [when(first, [assign(_remembered(self.yaw, f"detected{i}"), self.yaw)])]

    def at_fall(self, i: int, pair: str) -> list[Action]:
        """The window of a pair opens, because its first sonar Si lost the object (E07)."""
        if self.yaw is None:
            return []
        yaw, window = self.yaw, _remembered(self.yaw, f"window{pair}")
        return [
            when(under("E07", "AT-FALL") & leads_to_a_turn(pair), [assign(window, yaw)]),
            when(
                under("E07", "AT-FIRST-DETECTION") & leads_to_a_turn(pair),
                [assign(window, _remembered(yaw, f"detected{i}"))],
            ),
        ]

    def at_signal(self, pair: str) -> list[Action]:
        """The window of a pair is about to send its signal (E07)."""
        if self.yaw is None:
            return []
        earlier = under("E07", "AT-FALL", "AT-FIRST-DETECTION") & leads_to_a_turn(pair)
        window = _remembered(self.yaw, f"window{pair}")
        return [when(earlier, [assign(_remembered(self.yaw, "initial"), window)])]


def leads_to_a_turn(pair: str) -> Expr:
    """Whether the rover turns for an object of the pair; for one at the centre sonar only by E05."""
    return TRUE if pair in ("12", "32") else under("E05", "OPPOSITE")


def _remembered(yaw: Var, what: str) -> Var:
    return Var(f"yaw_{what}", yaw.domain, yaw.init, "yaw as remembered for the initial direction (E07)")


FREE = Heading(named(
    "gyroTargetDiff(yaw, targetAngle)",
    turned_45 & choose("E07", {
        "AT-DECISION": after(1 * tick),
        "AT-FALL": TRUE,
        "AT-FIRST-DETECTION": TRUE,
    }),
))  # fmt: skip
"""The heading as the free predicate ``turned_45``."""


def measured(yaw: Var, targetAngle: Var) -> Heading:
    """The heading as it is measured; ``targetAngle`` is dead data outside a deviation."""
    earlier = _remembered(yaw, "initial")
    initial = choose("E07", {"AT-DECISION": yaw, "AT-FALL": earlier, "AT-FIRST-DETECTION": earlier})
    before, so_far = _turning(yaw)
    by_sum = under("E06", "PASS")
    turn = maximum(minimum(so_far + wrap(yaw - before), FULL_TURN), -FULL_TURN)
    return Heading(
        turned=gyroTargetDiff(yaw, targetAngle),
        store_target=(
            assign(targetAngle, angleCalculator(initial, B2Decision)),
            when(by_sum, [assign(so_far, 0), assign(before, yaw)]),
        ),
        follow=(when(by_sum, [assign(so_far, turn), assign(before, yaw)]),),
        forget=(when(by_sum, [assign(so_far, 0), assign(before, before.init)]),),
        local_to=[(targetAngle, ("MoveToS1", "MoveToS3"))],
        yaw=yaw,
    )


def headings(grid: int) -> tuple[Var, Var]:
    """``yaw`` and ``targetAngle`` on multiples of ``grid`` degrees, which must divide 45."""
    yaw = var("yaw", chosen(range(0, 360, grid), "°"), doc="heading, clockwise positive")
    target = var("targetAngle", chosen(range(0, 361, grid), "°"), doc="heading at which the deviation ends")
    return yaw, target


FULL_TURN = 360
"""A sum that stands for every larger one, in degrees (E06 PASS)."""


def _turning(yaw: Var) -> tuple[Var, Var]:
    """What E06 PASS adds up: yaw in the step before, and the turn so far."""
    assert isinstance(yaw.domain.sort, Num)
    sums = fixed(-FULL_TURN, FULL_TURN, yaw.domain.sort.resolution, "°")
    turn = var("turn_so_far", sums, 0, "sum of the changes of yaw in this turn (E06 PASS)")
    return Var("yaw_before", yaw.domain, yaw.init, "yaw in the step before, during a turn (E06 PASS)"), turn


def angleCalculator(yaw: Expr, decision: Expr) -> Expr:
    """The heading 45 degrees toward the first sonar: left of now for decision 2, else right (E07)."""
    left, right = yaw - 45, yaw + 45
    return named(
        "angleCalculator(yaw, B2Decision)",
        ite(decision == number(2), ite(left < 0, left + 360, left), ite(right > 360, right - 360, right)),
    )


def gyroTargetDiff(yaw: Var, target: Var) -> Expr:
    """The rover has turned at least 45 degrees toward the first sonar (E06)."""
    rest = wrap(target - yaw)
    before, so_far = _turning(yaw)
    turn = so_far + wrap(yaw - before)
    return named(
        "gyroTargetDiff(yaw, targetAngle)",
        choose("E06", {
            "EXACT": _either_way(rest >= 0, rest <= 0),
            "TOL-12": absolute(rest) <= 12,
            "PASS": _either_way(turn <= -45, turn >= 45),
        }),
    )  # fmt: skip


def _either_way(left: Expr, right: Expr) -> Expr:
    """The condition for a turn to the left, decision 2, and to the right, decision 4."""
    return ((B2Decision == number(2)) & left) | ((B2Decision == number(4)) & right)
