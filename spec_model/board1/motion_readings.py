"""The sentences about references and emergency stop that can be read in several ways (S57, S59 to S63)."""

from collections.abc import Sequence

from rovercheck.spec_model.lang.action import Action, assign, when
from rovercheck.spec_model.lang.expr import Expr, Operand, flag, var
from rovercheck.spec_model.lang.words import maximum, minimum
from rovercheck.spec_model.readings import choose
from rovercheck.spec_model.signals.board1 import (
    OMEGA_REFERENCE,
    V_REFERENCE,
    backward_enabled,
    cmd,
    estop_recover_enabled,
    is_rotating180,
    omega_ref,
    rover_safety_state,
    v_ref,
    v_user,
    y_norm,
)

undefined_v_ref = var(
    "undefined_v_ref", V_REFERENCE, doc="any reference, where a command has no stated effect"
)
undefined_omega_ref = var("undefined_omega_ref", OMEGA_REFERENCE, doc="any reference, likewise")
operator_release = flag("operator_release", "the operator releases the emergency stop, by whatever control")

critical = rover_safety_state == "SAFETY_CRITICAL"


def limited(user: Expr, limit: Expr) -> Expr:
    """The user's command under the limit of the safety state (S57); clipped, it is so on both sides."""
    return choose("S57", {"SCALE": user * limit, "CLIP": maximum(minimum(user, limit), -limit)})


def follow_user(turning: Expr) -> Sequence[Action]:
    """Normal motion: backwards only in backward mode, or always, or never (S59)."""
    may_move = backward_enabled | (y_norm > 0)
    moves = choose("S59", {"MOTION-CHART": may_move, "SIGNED": True, "FORWARD-ONLY": v_user > 0})
    return [when(moves, [assign(v_ref, v_user)], [assign(v_ref, 0)]), assign(omega_ref, turning)]


def manoeuvre(v: Expr, omega: Expr, *, named_turn: Operand | None = None) -> Sequence[Action]:
    """What a command other than NORMAL makes of the references (S60).

    Its name may say the turn: then the rover turns that way with the user's speed.  The names of the
    avoiding commands say no turn.
    """
    by_name = (v, omega) if named_turn is None else (v_user, named_turn)
    return [
        assign(
            v_ref,
            choose("S60", {"MOTION-CHART": v, "ASSUME-NAMES": by_name[0], "UNDEFINED": undefined_v_ref}),
        ),
        assign(
            omega_ref,
            choose(
                "S60", {"MOTION-CHART": omega, "ASSUME-NAMES": by_name[1], "UNDEFINED": undefined_omega_ref}
            ),
        ),
    ]


turn_back = (y_norm < -0.5) & ~backward_enabled
by_command = cmd == "CMD_ROTATE_180"
# Where a stick pulled back is no request to rotate, the command of that name is one (S59).
must_rotate = choose("S59", {"MOTION-CHART": turn_back, "SIGNED": by_command, "FORWARD-ONLY": by_command})

stop_commanded = choose(
    "S63",
    {
        "ONLY-FORWARD": (cmd == "CMD_ESTOP") & (v_user > 0) & ~is_rotating180,
        "UNCONDITIONAL": cmd == "CMD_ESTOP",
    },
)
must_stop = choose("S61", {"ANY-CRITICAL": stop_commanded | critical, "COLLISION-ONLY": stop_commanded})
may_go_on = choose(
    "S62",
    {
        "LATCH-UNTIL-STOPPED": ~critical & estop_recover_enabled,
        "FOLLOW": ~critical & (cmd != "CMD_ESTOP"),
        "OPERATOR": ~critical & estop_recover_enabled & operator_release,
    },
)
