"""How the obstacle chart knows that the rover has turned by 45 degrees: exactly, or as a free predicate.

The chart reads the heading only in ``gyroTargetDiff`` and in ``angleCalculator``, which stores the
target of the deviation [spec §3.4.1 (1)].  Checked alone, the chart meets an arbitrary yaw in every
step.  Then the heading may be replaced by one input, ``turned_45``, without losing or adding a run:

* the test is examined only in MoveToS1 and MoveToS3, and nothing else reads yaw or the target;
* in the step of entry it is false, because the target is 45 degrees away from the yaw of that very
  step: ``after(1 tick)`` says so (unless the initial direction is an earlier one, E07);
* in every later step some yaw makes it true and some makes it false, whatever the target is.

Multiplying the timers of the chart by a grid of headings would gain nothing but states.
"""

from dataclasses import dataclass
from functools import cache

from rovercheck.spec_model.lang.action import Action, assign
from rovercheck.spec_model.lang.domain import chosen
from rovercheck.spec_model.lang.expr import Expr, Var, flag, ite, var
from rovercheck.spec_model.lang.time import tick
from rovercheck.spec_model.lang.words import after, named, wrap
from rovercheck.spec_model.signals.board2 import B2Decision, number

turned_45 = flag("turned_45", "the rover has turned 45 degrees toward the sonar that detected first")


@dataclass(frozen=True)
class Heading:
    """What the chart needs: the guard that ends a turn, and the entry actions of one."""

    turned: Expr
    store_target: tuple[Action, ...] = ()
    local_to: tuple[tuple[Var, tuple[str, ...]], ...] = ()


FREE = Heading(named("gyroTargetDiff(yaw, targetAngle)", turned_45 & after(1 * tick)))
"""The heading as the free predicate ``turned_45``."""


@cache
def measured(yaw: Var, targetAngle: Var) -> Heading:
    """The heading as it is measured; ``targetAngle`` is dead data outside a deviation."""
    return Heading(
        turned=gyroTargetDiff(yaw, targetAngle),
        store_target=(assign(targetAngle, angleCalculator(yaw, B2Decision)),),
        local_to=((targetAngle, ("MoveToS1", "MoveToS3")),),
    )


def headings(grid: int) -> tuple[Var, Var]:
    """``yaw`` and ``targetAngle`` on multiples of ``grid`` degrees, which must divide 45."""
    yaw = var("yaw", chosen(range(0, 360, grid), "°"), doc="heading, clockwise positive")
    target = var("targetAngle", chosen(range(0, 361, grid), "°"), doc="heading at which the deviation ends")
    return yaw, target


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
    return named("gyroTargetDiff(yaw, targetAngle)", either_way(rest >= 0, rest <= 0))


def either_way(left: Expr, right: Expr) -> Expr:
    """The condition for a turn to the left, decision 2, and to the right, decision 4."""
    return ((B2Decision == number(2)) & left) | ((B2Decision == number(4)) & right)
