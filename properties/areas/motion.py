"""What must be true of the stop, the 180° rotation and backward mode of Board 1 [spec §2.2, §2.3, Fig 19]."""

from rovercheck.properties.areas.references import drives, running
from rovercheck.properties.document.causes import critical
from rovercheck.properties.forms import (
    Property,
    always,
    enters_only_if,
    holds_after,
    leaves_only_if,
    never,
    reachable,
)
from rovercheck.spec_model.board1.backward import toggle
from rovercheck.spec_model.board1.motion import motion_supervision
from rovercheck.spec_model.lang.expr import TRUE, Expr, all_of, implies
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import absolute, held, named, once, previous, rising
from rovercheck.spec_model.signals.board1 import (
    actuate_emergency_stop,
    angle_err,
    backward_enabled,
    btn1,
    btn2,
    cmd,
    current_action,
    invert_y,
    is_rotating180,
    omega_ref,
    rover_safety_state,
    v_ref,
    v_user,
    wheel_speed_rpm,
    wheels_below_2_5,
    x_norm,
    y_norm,
)

ON, EXECUTED, TOGGLE = "references", "references_executed", "backward"
stopped = actuate_emergency_stop
rotating = motion_supervision.active("Retromarcia_180")
normal = motion_supervision.active("Normale_marcia")
braking = motion_supervision.active("In_frenata_di_emergenza")
at_rest = motion_supervision.active("Motori_fermi")

# --- release of the emergency stop [spec §2.3] ----------------------------------------------------

PB1_24a = leaves_only_if(
    "PB1-24a", "The emergency stop is released only by a rover that had come to rest (Motori_fermi).",
    leaving=stopped, only_if=previous(at_rest),
    covers=["B1-EST-01"], on=ON, from_tick=2, interpretations=["S62"],
)  # fmt: skip
PB1_24b = enters_only_if(
    "PB1-24b",
    "A stop counts as done only after 51 successive executed steps of it with all wheels below 2.5 rpm.",
    entering=at_rest, only_if=previous(held(stopped & wheels_below_2_5, for_=50 * ticks)),
    covers=["B1-EST-01"], on=EXECUTED, from_tick=2, interpretations=["S62"],
)  # fmt: skip
PB1_24c = enters_only_if(
    "PB1-24c",
    "A stop counts as done only after 50 successive executed steps of it with all wheels below 2.5 rpm.",
    entering=at_rest, only_if=previous(held(stopped & wheels_below_2_5, for_=49 * ticks)),
    covers=["B1-EST-01"], on=EXECUTED, from_tick=2, interpretations=["S62"],
)  # fmt: skip

PB1_24d = always(
    "PB1-24d", "The rover counts as standing where all four wheels are slower than 2.5 rpm.",
    that=wheels_below_2_5 == all_of(*(absolute(speed) < 2.5 for speed in wheel_speed_rpm.values())),
    covers=["B1-EST-01"], on="board1", interpretations=["S62"],
)  # fmt: skip

calm = named(
    "calm",
    ~critical & (cmd == "CMD_NORMAL") & wheels_below_2_5 & (y_norm >= -0.5),
)
"""Nothing to stop for, and no new rotation asked for."""
resumed = ~stopped & (current_action == "CMD_NORMAL")

PB1_25a = holds_after(
    "PB1-25a",
    "After 53 executed steps without critical cause, with CMD_NORMAL and wheels at rest, Board 1 resumes.",
    premise=calm, for_=52 * ticks, then=resumed,
    covers=["B1-EST-01", "B1-ACT-01"], on=EXECUTED, from_tick=2, interpretations=["S62"],
)  # fmt: skip
PB1_25b = holds_after(
    "PB1-25b",
    "After 53 executed steps without critical cause, with CMD_NORMAL, wheels at rest and no 180° rotation, "
    "Board 1 resumes.",
    premise=calm & ~is_rotating180, for_=52 * ticks, then=resumed,
    covers=["B1-EST-01", "B1-ACT-01"], on=EXECUTED, from_tick=2, interpretations=["S62"],
)  # fmt: skip
RESUME_BOUND = reachable(
    "REACH1-RESUME-BOUND", "Board 1 may need 53 such steps to resume: the bound of PB1-25b is the least.",
    that=held(calm & ~is_rotating180, for_=51 * ticks) & ~resumed,
    covers=["B1-EST-01", "B1-ACT-01"], on=EXECUTED, interpretations=["S62"],
)  # fmt: skip

# --- 180° rotation [spec Fig 12] -------------------------------------------------------------------

PB1_26 = always(
    "PB1-26", "During the 180° rotation the linear reference is zero.",
    that=implies(current_action == "CMD_ROTATE_180", v_ref == 0),
    covers=["B1-ACT-01"], on=ON, from_tick=2, interpretations=["S60"],
)  # fmt: skip
PB1_26b = always(
    "PB1-26b", "During the 180° rotation the linear reference keeps the value of the step before.",
    that=implies(rotating, v_ref == previous(v_ref)),
    covers=["B1-ACT-01"], on=ON, from_tick=2, interpretations=["S60"],
)  # fmt: skip
PB1_26c = always(
    "PB1-26c", "The rotation begins with the opposite heading as its target: an error of -180°.",
    that=implies(rotating & ~previous(rotating), angle_err == -180),
    covers=["B1-ACT-01"], on=ON, from_tick=2, interpretations=["S60"],
)  # fmt: skip
still = rotating & previous(rotating) & drives
shorter_way = (omega_ref > 0) == (angle_err < 0)
CRITICAL = rover_safety_state == "SAFETY_CRITICAL"
PB1_26d = always(
    "PB1-26d", "Far from its target the rover turns at full angular speed, the shorter way.",
    that=implies(
        still & (rover_safety_state == "SAFETY_OK"),
        implies(angle_err > 45, omega_ref == -1) & implies(angle_err < -45, omega_ref == 1),
    ),
    covers=["B1-ACT-01", "B1-REF-04"], on=ON, from_tick=2, interpretations=["S60", "S64"],
)  # fmt: skip
PB1_26e = always(
    "PB1-26e", "At 45° and less the healthy rover turns the shorter way, at 0.075 to 0.225.",
    that=implies(
        still & (rover_safety_state == "SAFETY_OK") & (absolute(angle_err) <= 45) & (angle_err != 0),
        (absolute(omega_ref) >= 0.075) & (absolute(omega_ref) <= 0.225) & shorter_way,
    ),
    covers=["B1-ACT-01", "B1-REF-04"], on=ON, from_tick=2, interpretations=["S60", "S64"],
)  # fmt: skip
PB1_26f = always(
    "PB1-26f", "In a 180° rotation, at 45° and less, the degraded rover turns the shorter way.",
    that=implies(
        still & (rover_safety_state == "SAFETY_DEGRADED") & (absolute(angle_err) <= 45) & (angle_err != 0),
        shorter_way,
    ),
    covers=["B1-ACT-01", "B1-REF-05"], on=ON, from_tick=2, interpretations=["S60", "S64"],
)  # fmt: skip
PB1_26g = leaves_only_if(
    "PB1-26g", "The rotation ends less than 7.5° from its target, or by a critical safety state.",
    leaving=rotating, only_if=(absolute(previous(angle_err)) < 7.5) | CRITICAL,
    covers=["B1-ACT-01"], on=ON, from_tick=2, interpretations=["S60", "S61"],
)  # fmt: skip
PB1_26h = always(
    "PB1-26h", "The flag of the rotation is set in the rotation and nowhere else.",
    that=is_rotating180 == rotating,
    covers=["B1-ACT-01"], on=ON, interpretations=["S60"],
)  # fmt: skip
PB1_26i = enters_only_if(
    "PB1-26i", "A rotation begins only for a stick pulled back beyond half, outside backward mode.",
    entering=rotating, only_if=(y_norm < -0.5) & ~backward_enabled & drives,
    covers=["B1-ACT-01"], on=ON, from_tick=2, interpretations=["S59", "S60"],
)  # fmt: skip

# --- a stick pulled back means forward after the rotation ------------------------------------------

PB1_26j = enters_only_if(
    "PB1-26j", "The stick changes its meaning only where a rotation ends with the stick pulled back.",
    entering=invert_y, only_if=previous(rotating) & normal & (y_norm < 0),
    covers=["B1-REF-02"], on=ON, from_tick=2, interpretations=["S59"],
)  # fmt: skip
PB1_26k = leaves_only_if(
    "PB1-26k", "It keeps that meaning until the stick is no longer pulled back or the rover must stop.",
    leaving=invert_y, only_if=(y_norm >= 0) | ~running | CRITICAL,
    covers=["B1-REF-02"], on=ON, from_tick=2, interpretations=["S59"],
)  # fmt: skip
PB1_26l = always(
    "PB1-26l", "Outside backward mode normal running never moves the rover with the stick pulled back.",
    that=implies(drives & normal & previous(normal) & (y_norm < 0) & ~backward_enabled, v_ref == 0),
    covers=["B1-REF-02"], on=ON, from_tick=2, interpretations=["S59"],
)  # fmt: skip

# --- backward mode [spec §2.2] ----------------------------------------------------------------------

PB1_27a = always(
    "PB1-27a", "The linear reference is negative only in backward mode.",
    that=implies(drives & (v_ref < 0), backward_enabled),
    covers=["B1-REF-02"], on=ON, from_tick=2, interpretations=["S59"],
)  # fmt: skip
PB1_27b = always(
    "PB1-27b", "In normal running the linear reference is negative only in backward mode.",
    that=implies(drives & normal & previous(normal) & (v_ref < 0), backward_enabled),
    covers=["B1-REF-02"], on=ON, from_tick=2, interpretations=["S59"],
)  # fmt: skip

hands_off = (x_norm == 0) & (y_norm == 0)
edge1 = named("btn1 pressed", rising(btn1) & hands_off)
edge2 = named("btn2 pressed", rising(btn2) & hands_off)


def _lately(what: Expr) -> Expr:
    """In one of the 50 steps before this one: at most 1 s ago."""
    return named(f"{what} lately", previous(once(what) & ~held(~what, for_=49 * ticks)))


press_2 = named("second press", edge1 & _lately(edge1))
press_3 = named("third press", edge2 & _lately(press_2))


changed = backward_enabled != previous(backward_enabled)
PB1_27c = always(
    "PB1-27c", "Backward mode changes only with a press of btn2, hands off the stick.",
    that=implies(changed, edge2),
    covers=["B1-REF-02"], on=TOGGLE, from_tick=2, interpretations=["S59"],
)  # fmt: skip
PB1_27d = always(
    "PB1-27d", "Backward mode changes only at most 1 s after an earlier press of btn2.",
    that=implies(changed, _lately(edge2)),
    covers=["B1-REF-02"], on=TOGGLE, from_tick=2, interpretations=["S59"],
)  # fmt: skip
PB1_27e = always(
    "PB1-27e", "Backward mode changes only after btn1, btn1, btn2, btn2, at most 1 s apart, hands off.",
    that=implies(changed, edge2 & _lately(press_3)),
    covers=["B1-REF-02"], on=TOGGLE, from_tick=2, interpretations=["S59"],
)  # fmt: skip
PB1_27f = never(
    "PB1-27f", "No step of the combination lasts longer than 1 s of executed steps.",
    that=held(toggle.active("Step2"), for_=50 * ticks)
    | held(toggle.active("Step3"), for_=50 * ticks)
    | held(toggle.active("Step4"), for_=50 * ticks),
    covers=["B1-REF-02"], on=TOGGLE, interpretations=["S59"],
)  # fmt: skip
PB1_27g = never(
    "PB1-27g", "No step of the combination lasts longer than 1 s, whoever moves the rover meanwhile.",
    that=held(toggle.active("Step2"), for_=50 * ticks),
    covers=["B1-REF-02"], on="backward_frozen", interpretations=["S48", "S59"],
)  # fmt: skip
PB1_27h = always(
    "PB1-27h", "The combination goes on only while the stick is at rest.",
    that=implies(toggle.active("Combo_toggle_backward"), hands_off),
    covers=["B1-REF-02"], on=TOGGLE, from_tick=2, interpretations=["S59"],
)  # fmt: skip

# --- every state and every transition ---------------------------------------------------------------------


def _move(id: str, text: str, source: str, target: str, why: Expr = TRUE) -> Property:
    """A companion: one transition of the motion chart can be taken."""
    that = previous(motion_supervision.active(source)) & motion_supervision.active(target) & why
    return reachable(
        f"REACH1-{id}", text, that=that, covers=["B1-ACT-01"], on=EXECUTED, interpretations=["S60"]
    )


REACH_ROTATION = reachable(
    "REACH1-RETROMARCIA", "The rover can rotate by 180°, and is then told to turn to the left.",
    that=rotating & (current_action == "CMD_ROTATE_180") & (omega_ref == 1) & (v_ref == 0),
    covers=["B1-ACT-01"], on=EXECUTED, interpretations=["S60"],
)  # fmt: skip
REACH_SLOW = reachable(
    "REACH1-ROTATION-SLOW", "Near its target the rover turns slowly, to the right too.",
    that=rotating & (omega_ref == -0.075), covers=["B1-ACT-01"], on=EXECUTED, interpretations=["S60", "S64"],
)  # fmt: skip
REACH_AT_45 = reachable(
    "REACH1-ROTATION-45", "At 45° the rover turns with 0.225.",
    that=rotating & (angle_err == 45) & (omega_ref == -0.225),
    covers=["B1-ACT-01"], on=EXECUTED, interpretations=["S60"],
)  # fmt: skip
REACH_FORWARD = reachable(
    "REACH1-INVERTED", "After a rotation a stick pulled back can count as forward.",
    that=invert_y & (v_user == 1) & (y_norm == -1), covers=["B1-REF-02"], on=EXECUTED,
    interpretations=["S59"],
)  # fmt: skip
REACH_ESTOP_IN_ROTATION = reachable(
    "REACH1-ESTOP-IGNORED", "A rotation can go on under CMD_ESTOP with the stick pushed forward.",
    that=rotating & previous(rotating & (v_user > 0)) & (cmd == "CMD_ESTOP"),
    covers=["B1-EST-01"], on=EXECUTED, interpretations=["S63"],
)  # fmt: skip

N, SL, SR, EL, ER, R, F, M = (
    "Normale_marcia", "Schivata_a_sinistra", "Schivata_a_destra", "Evita_sinistra", "Evita_destra",
    "Retromarcia_180", "In_frenata_di_emergenza", "Motori_fermi",
)  # fmt: skip
COMMANDED = (cmd == "CMD_ESTOP") & (rover_safety_state == "SAFETY_OK")

REACH_N_SL = _move("NORMAL-LEFT", "TakenTransition 1 of Normale_marcia.", N, SL, cmd == "CMD_GO_LEFT")
REACH_N_EL = _move(
    "NORMAL-AVOID-LEFT", "TakenTransition 2 of Normale_marcia.", N, EL, cmd == "CMD_AVOID_LEFT"
)
REACH_N_ER = _move(
    "NORMAL-AVOID-RIGHT", "TakenTransition 3 of Normale_marcia.", N, ER, cmd == "CMD_AVOID_RIGHT"
)
REACH_N_SR = _move("NORMAL-RIGHT", "TakenTransition 4 of Normale_marcia.", N, SR, cmd == "CMD_GO_RIGHT")
REACH_N_R = _move("NORMAL-ROTATE", "TakenTransition 5 of Normale_marcia.", N, R, y_norm == -1)
REACH_SL_N = _move("LEFT-NORMAL", "The transition of Schivata_a_sinistra.", SL, N)
REACH_SR_N = _move("RIGHT-NORMAL", "The transition of Schivata_a_destra.", SR, N)
REACH_EL_N = _move("AVOID-LEFT-NORMAL", "The transition of Evita_sinistra.", EL, N)
REACH_ER_N = _move("AVOID-RIGHT-NORMAL", "The transition of Evita_destra.", ER, N)
REACH_R_N_INV = _move("ROTATED-INVERTED", "The rotation ends, stick pulled back.", R, N, invert_y)
REACH_R_N = _move("ROTATED", "The rotation ends, stick not pulled back.", R, N, ~invert_y)
REACH_N_F = _move("NORMAL-STOP", "Normale_marcia is left by CMD_ESTOP.", N, F, COMMANDED)
REACH_SL_F = _move("LEFT-STOP", "Schivata_a_sinistra is left by CMD_ESTOP.", SL, F, COMMANDED)
REACH_EL_F = _move("AVOID-LEFT-STOP", "Evita_sinistra is left by CMD_ESTOP.", EL, F, COMMANDED)
REACH_CRIT_F = _move("CRITICAL-STOP", "Running ends by a critical state.", N, F, cmd == "CMD_NORMAL")
REACH_R_F = _move("ROTATION-STOP", "A rotation ends by a critical state.", R, F, critical)
REACH_F_M = _move("STOP-REST", "The rover comes to rest after a stop.", F, M)
REACH_M_N = _move("REST-NORMAL", "The stop is released.", M, N)


def _press(id: str, text: str, source: str, target: str, why: Expr) -> Property:
    """A companion: one transition of the toggle can be taken."""
    that = previous(toggle.active(source)) & toggle.active(target) & why
    return reachable(
        f"REACH1-{id}", text, that=that, covers=["B1-REF-02"], on=TOGGLE, interpretations=["S59"]
    )


START = "Combo_starting_point"
TOUCHED, LATE = ~hands_off, hands_off & ~btn1 & ~btn2
REACH_START_2 = _press("COMBO-1", "The first press of btn1.", START, "Step2", btn1)
REACH_2_3 = _press("COMBO-2", "The second press of btn1.", "Step2", "Step3", btn1)
REACH_3_4 = _press("COMBO-3", "The first press of btn2.", "Step3", "Step4", btn2)
REACH_ON = _press("COMBO-ON", "The second press of btn2 can switch it on.", "Step4", START, backward_enabled)
REACH_OFF = _press(
    "COMBO-OFF", "The combination can switch backward mode off.", "Step4", START,
    previous(backward_enabled) & ~backward_enabled,
)  # fmt: skip
REACH_2_LATE = _press("COMBO-LATE-2", "Too late for the second press.", "Step2", START, LATE)
REACH_3_LATE = _press("COMBO-LATE-3", "Too late for the third press.", "Step3", START, LATE)
REACH_4_LATE = _press("COMBO-LATE-4", "Too late for the fourth press.", "Step4", START, LATE)
REACH_TOUCHED = _press("COMBO-TOUCHED", "The stick ends the combination.", "Step4", START, TOUCHED)
