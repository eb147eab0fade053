"""What must be true of the wheel statuses of Board 1 [seed Table 2]; each sentence is for every wheel."""

from collections.abc import Callable

from properties.forms import always, reachable
from spec_model.board1.wheels import monitor_wheels
from spec_model.lang.expr import Expr, all_of, implies
from spec_model.signals.board1 import WHEELS, has_no_feedback, is_motion_consistent, wheel_status

ON = "wheels"
consistent = is_motion_consistent


def _every_wheel(sentence: Callable[[Expr, Expr, Expr, Expr], Expr]) -> Expr:
    """The sentence for each wheel, of its lost feedback and of the three levels of its status."""
    levels = ("WHEEL_OK", "WHEEL_DEGRADED_ENCODER", "WHEEL_CRITICAL_MOTOR")
    each = [sentence(has_no_feedback[w], *(wheel_status[w] == level for level in levels)) for w in WHEELS]
    return all_of(*each)


PB1_06a = always(
    "PB1-06a", "A wheel is critical if and only if its feedback is lost and the motion is inconsistent.",
    that=_every_wheel(lambda lost, ok, deg, crit: crit == (lost & ~consistent)),
    covers=["B1-WHL-03"], on=ON, from_tick=2, readings=["S28", "S29", "S30", "S31"],
)  # fmt: skip
PB1_06b = always(
    "PB1-06b", "A wheel with feedback and consistent motion is OK in the same step.",
    that=_every_wheel(lambda lost, ok, deg, crit: implies(~lost & consistent, ok)),
    covers=["B1-WHL-04"], on=ON, from_tick=2, readings=["S27", "S29"],
)  # fmt: skip
PB1_30a = always(
    "PB1-30a", "A wheel with lost feedback and consistent motion has a degraded encoder in the same step.",
    that=_every_wheel(lambda lost, ok, deg, crit: implies(lost & consistent, deg)),
    covers=["B1-WHL-01"], on=ON, from_tick=2, readings=["S29", "S30", "S32"],
)  # fmt: skip
PB1_30b = always(
    "PB1-30b", "A wheel with lost feedback is never OK.",
    that=_every_wheel(lambda lost, ok, deg, crit: implies(lost, ~ok)),
    covers=["B1-WHL-01"], on=ON, from_tick=2, readings=["S28", "S30"],
)  # fmt: skip
PB1_30c = always(
    "PB1-30c", "A wheel has a degraded encoder only if its feedback is lost.",
    that=_every_wheel(lambda lost, ok, deg, crit: implies(deg, lost)),
    covers=["B1-WHL-01"], on=ON, from_tick=2, readings=["S27"],
)  # fmt: skip

REACH_WHEELS_CRIT = reachable(
    "REACH-WHEELS-CRIT", "All four wheels can be critical at once.",
    that=all_of(*(monitor.active("Wheel_CRIT") for monitor in monitor_wheels)), covers=["B1-WHL-03"], on=ON,
)  # fmt: skip
REACH_WHEELS_ONE = reachable(
    "REACH-WHEELS-ONE", "Wheel FL can be degraded while the other three are OK.",
    that=monitor_wheels[0].active("Wheel_DEG") & all_of(*(m.active("Wheel_OK") for m in monitor_wheels[1:])),
    covers=["B1-WHL-01"], on=ON, readings=["S33"],
)  # fmt: skip
