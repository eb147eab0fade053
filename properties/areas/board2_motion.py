"""What must be true of the references with which Board 2 moves the rover [spec §3.1, §3.4.2, Fig 20]."""

from rovercheck.properties.document.causes import emergency
from rovercheck.properties.document.distances import within
from rovercheck.properties.forms import (
    Property,
    always,
    enters_only_if,
    holds_after,
    leaves_only_if,
    never,
    reachable,
)
from rovercheck.spec_model.board2.backward import toggle_2
from rovercheck.spec_model.board2.motion import motion_supervision_2
from rovercheck.spec_model.lang.expr import TRUE, Expr, all_of, any_of, implies
from rovercheck.spec_model.lang.time import Span, tick, ticks
from rovercheck.spec_model.lang.words import absolute, held, named, previous, rising
from rovercheck.spec_model.signals.board2_motion import (
    actuate_emergency_stop,
    angle_err,
    ay_norm,
    backward_enabled,
    btn1,
    btn2,
    bx_norm,
    current_action,
    invert_y,
    is_rotating180,
    omega_ref_actuation,
    v_ref_actuation,
    v_user,
    wheels_below_2_5,
)
from rovercheck.spec_model.signals.board2_supervisor import (
    autorized_to_send_command,
    cmd,
    rover_safety_state,
    rx_status,
)

ON, EXECUTED, TOGGLE = "references_2", "references_2_executed", "backward_2"
v_ref, omega_ref = v_ref_actuation, omega_ref_actuation
drives = named("Board 2 drives", autorized_to_send_command)
zero = named("zero references of Board 2", (v_ref == 0) & (omega_ref == 0))
obstacle = named("obstacle within 300 cm while Board 2 drives", drives & within(300))
critical_cause = named("emergency while Board 2 drives", drives & emergency)
normal = motion_supervision_2.active("Normale_marcia")
rotating = motion_supervision_2.active("Retromarcia_180")
braking = motion_supervision_2.active("In_frenata_di_emergenza")
at_rest = motion_supervision_2.active("Motori_fermi")
forward = ay_norm > 0

# --- an obstacle within 3 m stops the rover [spec §3.4, §3.4.2] ------------------------------------


def _stops(id: str, text: str, premise: Expr, steps: Span, then: Expr) -> Property:
    return holds_after(
        f"PB2-13{id}", text, premise=premise, for_=steps, then=then,
        covers=["B2-OBS-04"], on=ON, from_tick=2, interpretations=["E09", "E11", "E12"],
    )  # fmt: skip


PB2_13a0 = always(
    "PB2-13a-0", "While Board 2 drives, an obstacle within 300 cm makes the linear reference zero at once.",
    that=implies(obstacle, v_ref == 0),
    covers=["B2-OBS-04"], on=ON, from_tick=2, interpretations=["E09", "E11", "E12"],
)  # fmt: skip
PB2_13a1 = _stops(
    "a-1",
    "While Board 2 drives, with an obstacle within 300 cm in two successive steps the linear reference is "
    "zero in the second.",
    obstacle, 1 * tick, v_ref == 0,
)  # fmt: skip
PB2_13a2 = _stops(
    "a-2",
    "While Board 2 drives, with an obstacle within 300 cm in three successive steps the linear reference is "
    "zero in the third.",
    obstacle, 2 * ticks, v_ref == 0,
)  # fmt: skip
PB2_13b0 = always(
    "PB2-13b-0",
    "While Board 2 drives with the stick forward, an obstacle within 300 cm makes the linear reference zero "
    "at once.",
    that=implies(obstacle & forward, v_ref == 0),
    covers=["B2-OBS-04"], on=ON, from_tick=2, interpretations=["E09", "E11", "E12"],
)  # fmt: skip
PB2_13b1 = _stops(
    "b-1",
    "While Board 2 drives with the stick forward, with an obstacle within 300 cm in two successive steps the "
    "linear reference is zero in the second.",
    obstacle & forward, 1 * tick, v_ref == 0,
)  # fmt: skip
PB2_13b2 = _stops(
    "b-2",
    "While Board 2 drives with the stick forward, with an obstacle within 300 cm in three successive steps "
    "the linear reference is zero in the third.",
    obstacle & forward, 2 * ticks, v_ref == 0,
)  # fmt: skip
PB2_13c0 = always(
    "PB2-13c-0",
    "While Board 2 drives with the stick forward, an obstacle within 300 cm makes the angular reference zero "
    "at once.",
    that=implies(obstacle & forward, omega_ref == 0),
    covers=["B2-OBS-04"], on=ON, from_tick=2, interpretations=["E09", "E11", "E12"],
)  # fmt: skip
PB2_13c2 = _stops(
    "c-2",
    "While Board 2 drives with the stick forward, with an obstacle within 300 cm in three successive steps "
    "the angular reference is zero in the third.",
    obstacle & forward, 2 * ticks, omega_ref == 0,
)  # fmt: skip
PB2_13c3 = _stops(
    "c-3",
    "While Board 2 drives, with an obstacle within 300 cm in three successive steps the angular reference is "
    "zero in the third, whatever the user commands.",
    obstacle, 2 * ticks, omega_ref == 0,
)  # fmt: skip
PB2_13d1 = _stops(
    "d-1", "Stick forward and no 180° rotation: both references are zero in the second of two steps.",
    obstacle & forward & ~is_rotating180, 1 * tick, zero,
)  # fmt: skip

# --- limits and authority ----------------------------------------------------------------------------

PB2_16a = always(
    "PB2-16a", "The references of Board 2 are at most half of full speed, whatever happens to the links.",
    that=(absolute(v_ref) <= 0.5) & (absolute(omega_ref) <= 0.5),
    covers=["B2-ACT-01", "B1-REF-05"], on=ON, interpretations=["E22", "E25"],
)  # fmt: skip
PB2_16b = always(
    "PB2-16b", "References, emergency stop and current action of Board 2 change only while it drives.",
    that=implies(
        any_of(*(out != previous(out) for out in (v_ref, omega_ref, current_action)),
               actuate_emergency_stop != previous(actuate_emergency_stop)),
        drives,
    ),
    covers=["B2-ACT-01"], on=ON, interpretations=["E22"],
)  # fmt: skip
PB2_16c = always(
    "PB2-16c", "The emergency stop of Board 2 implies zero references.",
    that=implies(actuate_emergency_stop, zero),
    covers=["B2-REF-01"], on=ON,
)  # fmt: skip
PB2_16d = enters_only_if(
    "PB2-16d", "The linear reference of Board 2 becomes negative only in backward mode.",
    entering=v_ref < 0, only_if=backward_enabled & (ay_norm < 0) & drives,
    covers=["B2-REF-01"], on=ON, interpretations=["S59"],
)  # fmt: skip
PB2_16e = always(
    "PB2-16e", "During a 180° rotation of Board 2 the linear reference is zero.",
    that=implies(current_action == "CMD_ROTATE_180", v_ref == 0),
    covers=["B2-REF-01"], on=ON, interpretations=["S60"],
)  # fmt: skip
PB2_16f = always(
    "PB2-16f", "At 45° and less Board 2 still turns toward the target of the rotation.",
    that=implies(
        drives & rotating & previous(rotating) & (angle_err != 0) & (absolute(angle_err) <= 45),
        (omega_ref > 0) == (angle_err < 0),
    ),
    covers=["B2-REF-01"], on=ON, interpretations=["S60", "S64"],
)  # fmt: skip
PB2_16g = always(
    "PB2-16g", "Above 45° the rover turns at half of full angular speed, the shorter way.",
    that=implies(
        drives & rotating & previous(rotating),
        implies(angle_err > 45, omega_ref == -0.5) & implies(angle_err < -45, omega_ref == 0.5),
    ),
    covers=["B2-REF-01"], on=ON, interpretations=["S60", "S64"],
)  # fmt: skip
PB2_16h = leaves_only_if(
    "PB2-16h", "The emergency stop of Board 2 is released only from Motori_fermi.",
    leaving=actuate_emergency_stop, only_if=previous(at_rest),
    covers=["B2-REF-01"], on=ON, interpretations=["S62"],
)  # fmt: skip
PB2_16i = never(
    "PB2-16i", "With the reception critical the stop of Board 2 lasts at most 2 s of executed steps.",
    that=held(braking & (rx_status == "RX_CRITICAL"), for_=100 * ticks),
    covers=["B2-REF-01"], on=EXECUTED, interpretations=["S62"],
)  # fmt: skip

# --- a critical cause stops the rover [spec §2.7, Fig 20] --------------------------------------------

PB2_17 = always(
    "PB2-17", "While Board 2 drives, a critical cause makes both references zero in the same step.",
    that=implies(critical_cause, zero),
    covers=["B2-REF-01", "B1-REF-06"], on=ON, from_tick=2,
)  # fmt: skip
PB2_18a = holds_after(
    "PB2-18a", "A critical cause in two successive steps makes both references zero in the second.",
    premise=critical_cause, for_=1 * tick, then=zero,
    covers=["B2-REF-01", "B1-REF-06"], on=ON, from_tick=2,
)  # fmt: skip
PB2_18b = holds_after(
    "PB2-18b", "A critical cause in three successive steps makes both references zero in the third.",
    premise=critical_cause, for_=2 * ticks, then=zero,
    covers=["B2-REF-01", "B1-REF-06"], on=ON, from_tick=2,
)  # fmt: skip

# --- backward mode -------------------------------------------------------------------------------------

hands_off = (bx_norm == 0) & (ay_norm == 0)
PB2_16j = always(
    "PB2-16j", "Backward mode of Board 2 changes only with a press of btn2, hands off the stick.",
    that=implies(backward_enabled != previous(backward_enabled), rising(btn2) & hands_off),
    covers=["B2-REF-01"], on=TOGGLE, from_tick=2, interpretations=["S59"],
)  # fmt: skip
PB2_16k = never(
    "PB2-16k", "No step of the combination lasts longer than 1 s of executed steps.",
    that=any_of(*(held(toggle_2.active(step), for_=50 * ticks) for step in ("Step2", "Step3", "Step4"))),
    covers=["B2-REF-01"], on=TOGGLE, interpretations=["S59"],
)  # fmt: skip

# --- every state and every transition ---------------------------------------------------------------------


def _move(id: str, text: str, source: str, target: str, why: Expr, on: str = EXECUTED) -> Property:
    """A companion: one transition of the motion chart can be taken."""
    chart = motion_supervision_2
    that = all_of(previous(chart.active(source)), chart.active(target), why)
    return reachable(f"REACH2-{id}", text, that=that, covers=["B2-REF-01"], on=on)


N, R, F, M = "Normale_marcia", "Retromarcia_180", "In_frenata_di_emergenza", "Motori_fermi"
link_down = rx_status == "RX_CRITICAL"
always_turning = ~wheels_below_2_5 & held(~wheels_below_2_5, for_=102 * ticks)

REACH2_N = reachable(
    "REACH2-NORMALE", "Board 2 can drive at half of full speed.",
    that=normal & (current_action == "CMD_NORMAL") & (v_ref == 0.5) & (omega_ref == -0.5),
    covers=["B2-REF-01"], on=ON, interpretations=["E25"],
)  # fmt: skip
REACH2_BACK = reachable(
    "REACH2-BACKWARD", "Board 2 can drive backward in backward mode.",
    that=normal & (v_ref == -0.5) & backward_enabled, covers=["B2-REF-01"], on=EXECUTED,
    interpretations=["S59"],
)  # fmt: skip
REACH2_INVERTED = reachable(
    "REACH2-INVERTED", "After a rotation a stick pulled back can count as forward.",
    that=invert_y & (v_user == 0.5) & (ay_norm == -1), covers=["B2-REF-01"], on=EXECUTED,
    interpretations=["S59"],
)  # fmt: skip
REACH2_ESTOP_IGNORED = reachable(
    "REACH2-ESTOP-IGNORED", "A rotation can go on under CMD_ESTOP with the stick pushed forward.",
    that=rotating & previous(rotating & (v_user > 0)) & (cmd == "CMD_ESTOP"),
    covers=["B2-REF-01"], on=EXECUTED, interpretations=["S63"],
)  # fmt: skip
REACH2_N_R = _move(
    "NORMAL-ROTATE", "The transition of Normale_marcia.", N, R, current_action == "CMD_ROTATE_180"
)
REACH2_R_N_INV = _move("ROTATED-INVERTED", "The rotation ends, stick pulled back.", R, N, invert_y)
REACH2_R_N = _move("ROTATED", "The rotation ends, stick not pulled back.", R, N, ~invert_y)
REACH2_N_F = _move("NORMAL-STOP", "Running ends by an obstacle.", N, F, cmd == "CMD_ESTOP")
REACH2_CRIT_F = _move("CRITICAL-STOP", "Running ends by a critical state.", N, F, cmd == "CMD_NORMAL")
REACH2_R_F = _move("ROTATION-STOP", "A rotation ends by a critical state.", R, F, emergency)
REACH2_F_M_1 = _move("STOP-2S", "With the link down the stop ends, wheels turning.", F, M, always_turning)
REACH2_F_M_2 = _move("STOP-REST", "The rover comes to rest after a stop.", F, M, ~link_down)
REACH2_M_N = _move("REST-NORMAL", "The stop is released.", M, N, rover_safety_state == "SAFETY_DEGRADED")


def _press(id: str, text: str, source: str, target: str, why: Expr = TRUE) -> Property:
    """A companion: one transition of the toggle can be taken."""
    that = previous(toggle_2.active(source)) & toggle_2.active(target) & why
    return reachable(
        f"REACH2-{id}", text, that=that, covers=["B2-REF-01"], on=TOGGLE, interpretations=["S59"]
    )


START = "Combo_starting_point"
LATE = hands_off & ~btn1 & ~btn2
REACH2_START_2 = _press("COMBO-1", "The first press of btn1.", START, "Step2")
REACH2_2_3 = _press("COMBO-2", "The second press of btn1.", "Step2", "Step3")
REACH2_3_4 = _press("COMBO-3", "The first press of btn2.", "Step3", "Step4")
REACH2_ON = _press("COMBO-ON", "The second press of btn2 can switch it on.", "Step4", START, backward_enabled)
REACH2_OFF = _press(
    "COMBO-OFF", "The combination can switch backward mode off.", "Step4", START,
    previous(backward_enabled) & ~backward_enabled,
)  # fmt: skip
REACH2_2_LATE = _press("COMBO-LATE-2", "Too late for the second press.", "Step2", START, LATE)
REACH2_3_LATE = _press("COMBO-LATE-3", "Too late for the third press.", "Step3", START, LATE)
REACH2_4_LATE = _press("COMBO-LATE-4", "Too late for the fourth press.", "Step4", START, LATE)
REACH2_TOUCHED = _press("COMBO-TOUCHED", "The stick ends the combination.", "Step4", START, ~hands_off)
