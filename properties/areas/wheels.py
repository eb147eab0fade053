"""What must be true of the wheel statuses of Board 1 [spec Table 2]; a sentence is one property per wheel."""

from collections.abc import Callable, Iterator

from rovercheck.properties.document.masks import WHEELS
from rovercheck.properties.forms import Property, always, reachable
from rovercheck.properties.past import STEPPED
from rovercheck.spec_model.board1.wheels import monitor_wheel_FL, monitor_wheel_FR
from rovercheck.spec_model.lang.expr import Expr, implies, ite
from rovercheck.spec_model.signals.board1 import has_no_feedback, is_motion_consistent, wheel_status

consistent = is_motion_consistent


def _ok(wheel: str) -> Expr:
    return wheel_status[wheel] == "WHEEL_OK"


def _degraded(wheel: str) -> Expr:
    return wheel_status[wheel] == "WHEEL_DEGRADED_ENCODER"


def _critical(wheel: str) -> Expr:
    return wheel_status[wheel] == "WHEEL_CRITICAL_MOTOR"


def _each(
    id: str,
    text: str,
    that: Callable[[str, Expr], Expr],
    covers: str,
    interpretations: list[str],
    from_tick: int = 2,
) -> Iterator[Property]:
    """The sentence for FL, FR, RL and RR, of a wheel and its lost feedback."""
    for wheel in WHEELS:
        yield always(
            f"{id}-{wheel}", f"Wheel {wheel} {text}", that=that(wheel, has_no_feedback[wheel]),
            covers=[covers], on=f"wheel_{wheel}", from_tick=from_tick, interpretations=interpretations,
        )  # fmt: skip


PB1_06a_FL, PB1_06a_FR, PB1_06a_RL, PB1_06a_RR = _each(
    "PB1-06a", "is critical if and only if its feedback is lost and the motion is inconsistent.",
    lambda wheel, lost: _critical(wheel) == (lost & ~consistent),
    "B1-WHL-03", ["S28", "S29", "S30", "S31"],
)  # fmt: skip
PB1_06b_FL, PB1_06b_FR, PB1_06b_RL, PB1_06b_RR = _each(
    "PB1-06b", "with feedback and consistent motion is OK in the same step.",
    lambda wheel, lost: implies(~lost & consistent, _ok(wheel)),
    "B1-WHL-04", ["S27", "S29"],
)  # fmt: skip
PB1_30a_FL, PB1_30a_FR, PB1_30a_RL, PB1_30a_RR = _each(
    "PB1-30a", "with lost feedback and consistent motion has a degraded encoder in the same step.",
    lambda wheel, lost: implies(lost & consistent, _degraded(wheel)),
    "B1-WHL-01", ["S29", "S30", "S32"],
)  # fmt: skip
PB1_30b_FL, PB1_30b_FR, PB1_30b_RL, PB1_30b_RR = _each(
    "PB1-30b", "with lost feedback is not OK.",
    lambda wheel, lost: implies(lost, ~_ok(wheel)),
    "B1-WHL-01", ["S28", "S30"],
)  # fmt: skip
PB1_30c_FL, PB1_30c_FR, PB1_30c_RL, PB1_30c_RR = _each(
    "PB1-30c", "has a degraded encoder only if its feedback is lost.",
    lambda wheel, lost: implies(_degraded(wheel), lost),
    "B1-WHL-01", ["S27"],
)  # fmt: skip
PB1_30d_FL, PB1_30d_FR, PB1_30d_RL, PB1_30d_RR = _each(
    "PB1-30d", "with feedback and inconsistent motion has a degraded encoder in the same step.",
    lambda wheel, lost: implies(~lost & ~consistent, _degraded(wheel)),
    "B1-WHL-04", ["S27", "S29", "S31"],
)  # fmt: skip
PB1_30e_FL, PB1_30e_FR, PB1_30e_RL, PB1_30e_RR = _each(
    "PB1-30e",
    "is classified in the very first step, too: with consistent motion it has a degraded encoder if its "
    "feedback is lost, else it is OK.",
    lambda wheel, lost: implies(~STEPPED & consistent, ite(lost, _degraded(wheel), _ok(wheel))),
    "B1-WHL-01", ["S30", "S65"], from_tick=1,
)  # fmt: skip

REACH_WHEEL_DEG = reachable(
    "REACH-WHEEL-DEG", "A wheel can have a degraded encoder.",
    that=monitor_wheel_FL.active("Wheel_DEG"), covers=["B1-WHL-01"], on="wheel_FL",
)  # fmt: skip
REACH_WHEEL_CRIT = reachable(
    "REACH-WHEEL-CRIT", "A wheel can be critical.",
    that=monitor_wheel_FL.active("Wheel_CRIT"), covers=["B1-WHL-03"], on="wheel_FL",
)  # fmt: skip
REACH_WHEELS_DIFFER = reachable(
    "REACH-WHEELS-DIFFER", "One wheel can be critical while another is not.",
    that=monitor_wheel_FL.active("Wheel_CRIT") & ~monitor_wheel_FR.active("Wheel_CRIT"),
    covers=["B1-WHL-03"], on="board1", interpretations=["S33"],
)  # fmt: skip
