"""What must be true of the references and the emergency stop of Board 1 [spec §2.2, §2.3, §2.7, Fig 20]."""

from rovercheck.properties.document.causes import critical, degraded
from rovercheck.properties.forms import always, holds_after, reachable, until
from rovercheck.spec_model.board1.motion import motion_supervision
from rovercheck.spec_model.lang.expr import Expr, all_of, any_of, implies
from rovercheck.spec_model.lang.time import tick, ticks
from rovercheck.spec_model.lang.words import absolute, named, once, previous
from rovercheck.spec_model.signals.board1 import (
    OMEGA_GO_LEFT,
    OMEGA_GO_RIGHT,
    OMEGA_MAX,
    V_MAX,
    V_MAX_MANEUVER,
    actuate_emergency_stop,
    backward_enabled,
    cmd,
    current_action,
    give_b2_actuation,
    omega_ref,
    rover_safety_state,
    v_ref,
    v_user,
    x_norm,
    y_norm,
)

ON = "references"
drives = named("Board 1 actuates", ~give_b2_actuation)
zero = named("zero references", (v_ref == 0) & (omega_ref == 0))
critical_cause = named("critical cause while Board 1 actuates", drives & critical)
running = motion_supervision.active("Stato_marcia_rover")
DEGRADED = drives & (rover_safety_state == "SAFETY_DEGRADED")
CRITICAL = drives & (rover_safety_state == "SAFETY_CRITICAL")

# --- a critical cause stops the rover ------------------------------------------------------------

PB1_17a = always(
    "PB1-17a", "While Board 1 actuates, a critical cause makes both references zero in the same step.",
    that=implies(critical_cause, zero),
    covers=["B1-REF-03", "B1-REF-06"], on=ON, from_tick=2, interpretations=["S48", "S55"],
)  # fmt: skip
PB1_17b = always(
    "PB1-17b", "While Board 1 actuates, a critical safety state makes both references zero in the same step.",
    that=implies(CRITICAL, zero),
    covers=["B1-REF-06"], on=ON, from_tick=2, interpretations=["S48"],
)  # fmt: skip
PB1_18a = holds_after(
    "PB1-18a",
    "A critical cause in two successive steps of actuation makes both references zero in the second.",
    premise=critical_cause, for_=1 * tick, then=zero,
    covers=["B1-REF-06"], on=ON, from_tick=2, interpretations=["S55"],
)  # fmt: skip
PB1_18b = holds_after(
    "PB1-18b",
    "A critical cause in three successive steps of actuation makes both references zero in the third.",
    premise=critical_cause, for_=2 * ticks, then=zero,
    covers=["B1-REF-06"], on=ON, from_tick=2, interpretations=["S55"],
)  # fmt: skip
PB1_19 = until(
    "PB1-19",
    "Zero references with a critical cause stay zero until the cause or the actuation of Board 1 ends.",
    start=critical_cause & zero, holds=zero, release=~critical_cause,
    covers=["B1-REF-06"], on=ON, from_tick=2, interpretations=["S62"],
)  # fmt: skip

# --- limits [spec Fig 20] ------------------------------------------------------------------------

PB1_20a = always(
    "PB1-20a",
    "While Board 1 actuates, the linear reference is within V_MAX of the safety state of the step.",
    that=implies(drives, absolute(v_ref) <= V_MAX),
    covers=["B1-REF-04", "B1-REF-05", "B1-REF-06"], on=ON, from_tick=2, interpretations=["S57"],
)  # fmt: skip
PB1_20b = always(
    "PB1-20b",
    "While Board 1 actuates, the angular reference is within OMEGA_MAX of the safety state of the step.",
    that=implies(drives, absolute(omega_ref) <= OMEGA_MAX),
    covers=["B1-REF-04", "B1-REF-05", "B1-REF-06"], on=ON, from_tick=2, interpretations=["S57"],
)  # fmt: skip
PB1_20c = always(
    "PB1-20c", "While Board 1 actuates and is degraded, both references are at most 0.5.",
    that=implies(DEGRADED, (absolute(v_ref) <= 0.5) & (absolute(omega_ref) <= 0.5)),
    covers=["B1-REF-05"], on=ON, from_tick=2, interpretations=["S57"],
)  # fmt: skip
PB1_20d = holds_after(
    "PB1-20d", "Degraded in ten successive steps of actuation, both references are at most 0.5 in the last.",
    premise=DEGRADED, for_=9 * ticks, then=(absolute(v_ref) <= 0.5) & (absolute(omega_ref) <= 0.5),
    covers=["B1-REF-05"], on=ON, from_tick=2, interpretations=["S57"],
)  # fmt: skip
PB1_20e = holds_after(
    "PB1-20e",
    "Degraded in two successive steps of actuation under one command, both references are at most 0.5.",
    premise=DEGRADED & (cmd == previous(cmd)), for_=1 * tick,
    then=(absolute(v_ref) <= 0.5) & (absolute(omega_ref) <= 0.5),
    covers=["B1-REF-05"], on=ON, from_tick=2, interpretations=["S57"],
)  # fmt: skip


def _limits(v: float, omega: float, maneuver: float, left: float) -> Expr:
    turns = (OMEGA_GO_LEFT == left) & (OMEGA_GO_RIGHT == -left)
    return all_of(V_MAX == v, OMEGA_MAX == omega, V_MAX_MANEUVER == maneuver, turns)


PB1_20f = always(
    "PB1-20f", "The five limits are nominal, halved or zero as the safety state is OK, degraded or critical.",
    that=all_of(
        implies(drives & (rover_safety_state == "SAFETY_OK"), _limits(1.0, 1.0, 0.8, 0.4)),
        implies(DEGRADED, _limits(0.5, 0.5, 0.4, 0.2)),
        implies(CRITICAL, _limits(0, 0, 0, 0)),
    ),
    covers=["B1-REF-04", "B1-REF-05", "B1-REF-06"], on=ON, from_tick=2,
)  # fmt: skip

PB1_20g = always(
    "PB1-20g", "Before Board 1 drives for the first time the five limits are nominal.",
    that=once(drives) | _limits(1.0, 1.0, 0.8, 0.4), covers=["B1-REF-04"], on=ON,
)  # fmt: skip

# --- nominal references [spec §2.2] ----------------------------------------------------------------

nominal = named("nominal", drives & ~critical & ~degraded & (cmd == "CMD_NORMAL") & running)
as_commanded = (v_ref == y_norm) & (omega_ref == x_norm)

PB1_21a = always(
    "PB1-21a", "Without anomaly and with CMD_NORMAL for two steps, the references are the user's commands.",
    that=implies(previous(nominal) & nominal, as_commanded),
    covers=["B1-REF-01", "B1-REF-02"], on=ON, from_tick=2, interpretations=["S59"],
)  # fmt: skip
PB1_21b = always(
    "PB1-21b",
    "Without anomaly and with CMD_NORMAL for two steps, the references are the user's commands while the "
    "stick is forward.",
    that=implies(previous(nominal) & nominal & (y_norm > 0), as_commanded),
    covers=["B1-REF-01", "B1-REF-02"], on=ON, from_tick=2, interpretations=["S59"],
)  # fmt: skip
PB1_21c = always(
    "PB1-21c",
    "Without anomaly and with CMD_NORMAL for two steps, the references are the user's commands in backward "
    "mode.",
    that=implies(previous(nominal) & nominal & backward_enabled, as_commanded),
    covers=["B1-REF-01", "B1-REF-02"], on=ON, from_tick=2, interpretations=["S59"],
)  # fmt: skip

# --- emergency stop [spec §2.3] --------------------------------------------------------------------

PB1_22 = always(
    "PB1-22", "The emergency stop implies zero references.",
    that=implies(actuate_emergency_stop, zero),
    covers=["B1-EST-01"], on=ON, from_tick=2, interpretations=["S62"],
)  # fmt: skip
stop_commanded = named("CMD_ESTOP while Board 1 actuates", drives & (cmd == "CMD_ESTOP"))
PB1_23a = always(
    "PB1-23a", "While Board 1 actuates, CMD_ESTOP actuates the emergency stop in the same step.",
    that=implies(stop_commanded, actuate_emergency_stop),
    covers=["B1-EST-01"], on=ON, from_tick=2, interpretations=["S63", "E11"],
)  # fmt: skip
PB1_23b = holds_after(
    "PB1-23b", "CMD_ESTOP in two successive steps of actuation actuates the emergency stop in the second.",
    premise=stop_commanded, for_=1 * tick, then=actuate_emergency_stop,
    covers=["B1-EST-01"], on=ON, from_tick=2, interpretations=["S63", "E11"],
)  # fmt: skip
PB1_23c = always(
    "PB1-23c", "While Board 1 actuates, CMD_ESTOP with a forward user command stops in the same step.",
    that=implies(stop_commanded & (v_user > 0), actuate_emergency_stop),
    covers=["B1-EST-01"], on=ON, from_tick=2, interpretations=["S63", "E11"],
)  # fmt: skip
PB1_23d = holds_after(
    "PB1-23d",
    "CMD_ESTOP with a forward user command in two successive steps of actuation stops in the second.",
    premise=stop_commanded & (y_norm > 0), for_=1 * tick, then=actuate_emergency_stop,
    covers=["B1-EST-01"], on=ON, from_tick=2, interpretations=["S63", "E11"],
)  # fmt: skip
PB1_23e = always(
    "PB1-23e", "CMD_ESTOP to a rover that runs forward since the step before stops it in the same step.",
    that=implies(stop_commanded & previous(drives & running & (v_user > 0)), actuate_emergency_stop),
    covers=["B1-EST-01"], on=ON, from_tick=2, interpretations=["S63", "E11"],
)  # fmt: skip
PB1_23f = always(
    "PB1-23f", "While Board 1 actuates, CMD_ESTOP makes both references zero in the same step.",
    that=implies(stop_commanded, (v_ref == 0) & (omega_ref == 0)),
    covers=["B1-EST-01", "B2-OBS-01"], on=ON, from_tick=2, interpretations=["S63", "E11"],
)  # fmt: skip

# --- outputs of a board that does not actuate [spec §2.1] --------------------------------------------

PB1_34 = always(
    "PB1-34", "References, emergency stop and current action change only in steps in which Board 1 actuates.",
    that=implies(
        any_of(*(out != previous(out) for out in (v_ref, omega_ref, current_action)),
               actuate_emergency_stop != previous(actuate_emergency_stop)),
        drives,
    ),
    covers=["B1-GEN-05"], on=ON, from_tick=2, interpretations=["S48"],
)  # fmt: skip

# --- every state can be entered ----------------------------------------------------------------------


def _can_be_active(state: str, action: str) -> Expr:
    return motion_supervision.active(state) & (current_action == action)


REACH_SCHIVATA_SINISTRA = reachable(
    "REACH-SCHIVATA-SINISTRA", "The rover can dodge to the left.",
    that=_can_be_active("Schivata_a_sinistra", "CMD_GO_LEFT") & (v_ref == 0.8) & (omega_ref == 0.4),
    covers=["B1-ACT-01", "B1-REF-04"], on=ON, interpretations=["S60"],
)  # fmt: skip
REACH_SCHIVATA_DESTRA = reachable(
    "REACH-SCHIVATA-DESTRA", "The rover can dodge to the right, half as fast when degraded.",
    that=_can_be_active("Schivata_a_destra", "CMD_GO_RIGHT") & (v_ref == 0.4) & (omega_ref == -0.2),
    covers=["B1-ACT-01", "B1-REF-05"], on=ON, interpretations=["S60"],
)  # fmt: skip
REACH_EVITA_SINISTRA = reachable(
    "REACH-EVITA-SINISTRA", "The rover can avoid the left.",
    that=_can_be_active("Evita_sinistra", "CMD_AVOID_LEFT"), covers=["B1-ACT-01"], on=ON,
    interpretations=["S60"],
)  # fmt: skip
REACH_EVITA_DESTRA = reachable(
    "REACH-EVITA-DESTRA", "The rover can avoid the right.",
    that=_can_be_active("Evita_destra", "CMD_AVOID_RIGHT"), covers=["B1-ACT-01"], on=ON,
    interpretations=["S60"],
)  # fmt: skip
REACH_MOTORI_FERMI = reachable(
    "REACH-MOTORI-FERMI", "The rover can come to rest after an emergency stop.",
    that=motion_supervision.active("Motori_fermi") & (current_action == "CMD_STOP"),
    covers=["B1-ACT-01", "B1-EST-01"], on="references_executed",
)  # fmt: skip
REACH_RECOVERY = reachable(
    "REACH-RECOVERY", "The emergency stop can be released.",
    that=running & previous(actuate_emergency_stop) & ~actuate_emergency_stop,
    covers=["B1-EST-01"], on="references_executed", interpretations=["S62"],
)  # fmt: skip
