"""Motion supervision of Board 1 under other interpretations: references, emergency stop (S57, S59 to S63)."""

from dataclasses import replace

from rovercheck.spec_model.board1.motion import critical, may_move, stop_commanded
from rovercheck.spec_model.interpretations import Change, alternative
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.change import formula, formulas, guards, inside
from rovercheck.spec_model.lang.edit import edit_state
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Expr, Operand, flag, var
from rovercheck.spec_model.lang.words import maximum, minimum
from rovercheck.spec_model.signals.board1 import (
    OMEGA_GO_LEFT,
    OMEGA_GO_RIGHT,
    OMEGA_MAX,
    OMEGA_REFERENCE,
    V_MAX,
    V_REFERENCE,
    cmd,
    estop_recover_enabled,
    omega_ref,
    v_ref,
    v_user,
    x_norm,
    y_norm,
)

CHART = "Motion_Supervision"
RUNNING, ROTATION = "Stato_marcia_rover", "Retromarcia_180"
STOP, STOPPED = "In_frenata_di_emergenza", "Procedura_emergency_stop"

undefined_v_ref = var(
    "undefined_v_ref", V_REFERENCE, doc="any reference, where a command has no stated effect"
)
undefined_omega_ref = var("undefined_omega_ref", OMEGA_REFERENCE, doc="any reference, likewise")
operator_release = flag("operator_release", "the operator releases the emergency stop, by whatever control")

MANOEUVRES = ("Schivata_a_sinistra", "Schivata_a_destra", "Evita_sinistra", "Evita_destra")
NAMED_TURNS = {"Schivata_a_sinistra": OMEGA_GO_LEFT, "Schivata_a_destra": OMEGA_GO_RIGHT}
"""The states of commands whose names say a turn; those of the avoiding commands say none."""


def clipped(user: Expr, limit: Expr) -> Expr:
    return maximum(minimum(user, limit), -limit)


def references(state: str, v: Operand, omega: Operand) -> Change:
    """What a manoeuvre makes of the references."""
    return lambda chart: edit_state(
        chart, state, lambda drawn: replace(drawn, during=(assign(v_ref, v), assign(omega_ref, omega)))
    )


commanded = cmd == "CMD_ROTATE_180"

ALTERNATIVES = (
    alternative("S57", "CLIP", "The user's command is clipped at the limits, on both sides.", CHART,
        formulas((y_norm * V_MAX, clipped(y_norm, V_MAX)), (x_norm * OMEGA_MAX, clipped(x_norm, OMEGA_MAX)))),
    alternative("S59", "SIGNED", "A stick pulled back always means backwards.", CHART,
        formula(may_move, TRUE),
        guards("Normale_marcia", ROTATION, lambda _: commanded)),
    alternative("S59", "FORWARD-ONLY", "A stick pulled back never moves the rover.", CHART,
        formula(may_move, v_user > 0),
        guards("Normale_marcia", ROTATION, lambda _: commanded)),
    alternative("S60", "ASSUME-NAMES", "The name of a command says the turn, at the user's speed.", CHART,
        *(references(state, v_user, turn) for state, turn in NAMED_TURNS.items())),
    alternative("S60", "UNDEFINED", "Commands other than NORMAL have no stated effect.", CHART,
        *(references(state, undefined_v_ref, undefined_omega_ref) for state in MANOEUVRES)),
    alternative("S63", "UNCONDITIONAL", "CMD_ESTOP stops the rover whatever it does.", CHART,
        formula(stop_commanded, cmd == "CMD_ESTOP")),
    alternative("S61", "COLLISION-ONLY", "A critical safety state is no emergency stop.", CHART,
        guards(RUNNING, STOP, inside(critical, FALSE))),
    alternative("S62", "FOLLOW", "The stop ends with its causes.", CHART,
        guards(STOPPED, RUNNING, inside(estop_recover_enabled, cmd != "CMD_ESTOP"))),
    alternative("S62", "OPERATOR", "The operator ends the stop, once the rover is at rest.", CHART,
        guards(STOPPED, RUNNING, lambda ended: ended & operator_release)),
)  # fmt: skip
