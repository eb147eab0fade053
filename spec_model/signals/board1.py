"""Signals of the Board 1 supervisor, under the document's own names [spec §2.2, §2.3, Table 2, Fig 19].

Where the document indexes a signal by wheel, the wheel's letters follow the name: FL, FR, RL, RR.
"""

from rovercheck.spec_model.lang.domain import boolean, chosen, enumeration, fixed, integer
from rovercheck.spec_model.lang.expr import Var, flag, var
from rovercheck.spec_model.signals.common import (
    B2_FAULT_MASK,
    COMMAND,
    FAULT_MASK,
    LINK_AGE,
    PHASE,
    RX_STATUS,
    SAFETY_STATUS,
    SUP_STATUS,
    USER_X,
    USER_Y,
    WHEEL_RPM,
)
from rovercheck.spec_model.signals.rotation import ERROR, ERROR_CLASSES, HEADING, TARGET

WHEELS = ("FL", "FR", "RL", "RR")
"""Front left, front right, rear left, rear right: bits 3 to 6 of the masks [spec Table 1]."""

TEMP_STATUS = enumeration("TempStatus", ["TEMP_HEALTH_OK", "TEMP_HEALTH_DEGRADED", "TEMP_HEALTH_CRITICAL"])
BATT_STATUS = enumeration("BattStatus", ["BATT_HEALTH_OK", "BATT_HEALTH_DEGRADED", "BATT_HEALTH_CRITICAL"])
WHEEL_STATUS = enumeration("WheelStatus", ["WHEEL_OK", "WHEEL_DEGRADED_ENCODER", "WHEEL_CRITICAL_MOTOR"])

# --- Board_Health [spec Fig 13] ------------------------------------------------------------------

DEGREES_C = chosen([-16, -15, -14, -6, -5, -4, 0, 25, 54, 55, 57, 59, 60, 64, 65, 66], "°C")
"""One value on each side of every limit, and 0 °C, the content of the snapshot at power-up."""

temp_update = flag("temp_update", "a valid temperature reading arrived since the last step")
temp_reading = var("temp_reading", DEGREES_C, doc="the reading that arrives with temp_update")
temperature_degC = var("temperature_degC", DEGREES_C, 0, "last valid temperature; 0 at power-up")
temp_age = var("temp_age", fixed(0, 81_520, 20, "ms"), 0, "now_ms - temp_last_valid_ms")

PERCENT = chosen([0, 10, 15, "15.1", "22.9", 23, 24, 25, "25.1", 80], "%")
"""One value on each side of every limit."""

batt_update = flag("batt_update", "a valid battery reading arrived since the last step")
batt_reading = var("batt_reading", PERCENT, doc="the reading that arrives with batt_update")
battery_pct = var("battery_pct", PERCENT, 0, "last valid battery level; 0 at power-up")
batt_age = var("batt_age", fixed(0, 155_280, 20, "ms"), 0, "now_ms - batt_last_valid_ms")
degraded_row_counts = flag("degraded_row_counts", "free: the degraded row counts before the critical one")

# --- Encoder [spec Fig 14] -----------------------------------------------------------------------

has_no_feedback = {w: flag(f"hasNoFeedback_{w}", "0 rpm read under a speed command (S32)") for w in WHEELS}
wheel_speed_rpm = {w: var(f"wheel_speed_rpm_{w}", WHEEL_RPM, 0, "measured wheel speed") for w in WHEELS}

# --- Board2_Data: the link, the heartbeat and the last accepted payload [spec §2.2] ---------------

rx_update = flag("rx_update", "a frame of Board 2 was accepted since the last step")
rx_age = var("rx_age", LINK_AGE, 0, "now_ms - Board2_Data.data_last_valid_ms")
rx_phase = var("rx_phase", PHASE, doc="how long before a step each valid frame comes")
rx_slow = flag("rx_slow", "the mean of the last ten reception intervals exceeds 40 ms")
heartbeat_update = flag("heartbeat_update", "the received heartbeat differs from the remembered one (S40)")
heartbeat_age = var("heartbeat_age", LINK_AGE, 0, "now_ms - last_valid_b2_ms")
heartbeat_slow = flag("heartbeat_slow", "the mean of the last ten heartbeat intervals exceeds 40 ms")

cmd = var("cmd", COMMAND, "CMD_NORMAL", "command of the Board 2 supervisor, as last received")
x_norm = var("x_norm", USER_X, 0, "user turning command, positive = left (S64)")
y_norm = var("y_norm", USER_Y, 0, "user speed command, positive = forward")
is_motion_consistent = var(
    "isMotionConsistent", boolean, True, "IMU and odometry agree; true before the first frame"
)
crit_mask_b2 = var("crit_mask_b2", B2_FAULT_MASK, 0, "critical mask of Board 2, as last received")
degr_mask_b2 = var("degr_mask_b2", B2_FAULT_MASK, 0, "degraded mask of Board 2, as last received")
current_yaw = var("current_yaw", HEADING, 0, "heading, clockwise positive, as last received")
btn1 = flag("btn1", "joystick button 1 is pressed, as last received")
btn2 = flag("btn2", "joystick button 2 is pressed, as last received")

# --- fault detection and masks [spec §2.4, §2.6] --------------------------------------------------

temp_status = var("temp_status", TEMP_STATUS)
batt_status = var("batt_status", BATT_STATUS)
wheel_status = {w: var(f"wheel_status_{w}", WHEEL_STATUS) for w in WHEELS}
b2_sup_status = var("b2_sup_status", SUP_STATUS)
rx_status = var("rx_status", RX_STATUS)

critical_mask = var("critical_mask", FAULT_MASK, doc="critical faults of Board 1, bits as in Table 1")
degraded_mask = var("degraded_mask", FAULT_MASK, doc="degraded components of Board 1, bits as in Table 1")
b1_critical = flag("b1_critical", "critical_mask != 0")
b1_degraded = flag("b1_degraded", "degraded_mask != 0")
b2_critical = flag("b2_critical", "stop_required: a fault of Board 2 that stops the rover")
b2_degraded = flag("b2_degraded", "degraded_required: a fault of Board 2 that slows the rover")

# --- relay, safety state, limits, references [spec §2.3, §2.5, §2.7] -------------------------------

give_b2_actuation = flag("give_b2_actuation", "relay open: Board 2 moves the rover")
rover_safety_state = var("rover_safety_state", SAFETY_STATUS, doc="safety_status of the document")

V_MAX = var("V_MAX", chosen([0, "0.5", 1]), 1, "limit of the linear reference")
OMEGA_MAX = var("OMEGA_MAX", chosen([0, "0.5", 1]), 1, "limit of the angular reference")
V_MAX_MANEUVER = var("V_MAX_MANEUVER", chosen([0, "0.4", "0.8"]), "0.8", "limit of v_ref while dodging")
OMEGA_GO_LEFT = var("OMEGA_GO_LEFT", chosen([0, "0.2", "0.4"]), "0.4", "least left turn in GO_LEFT")
OMEGA_GO_RIGHT = var("OMEGA_GO_RIGHT", chosen(["-0.4", "-0.2", 0]), "-0.4", "least right turn in GO_RIGHT")

V_REFERENCE = fixed(-1, 1, "0.05")
"""Normalised linear reference (S58): every product of a user command and a limit is exact."""
OMEGA_REFERENCE = fixed(-1, 1, "0.0125")
"""Normalised angular reference (S58), positive = left (S64): also 0.005 per 2.5 degrees of rotation."""

v_user = var("v_user", V_REFERENCE, doc="y_norm scaled by V_MAX, of the last execution of UPD")
omega_user = var("omega_user", OMEGA_REFERENCE, doc="x_norm scaled by OMEGA_MAX")
backward_enabled = flag("backward_enabled", "backward mode, toggled by the joystick buttons")
wheels_below_2_5 = flag("wheels_below_2_5", "checkStop: all four wheels are slower than 2.5 rpm")
rover_is_stopped = flag("roverIsStopped", "checkStop, as remembered by In_frenata_di_emergenza")
invert_y = flag("invert_y", "turned around with the stick pulled back, which now means forward")
is_rotating180 = flag("is_rotating180", "Retromarcia_180 is active")
targetAngle = var("targetAngle180", TARGET, 0, "heading at which the 180° rotation ends")
angle_err = var("angle_err", ERROR, 0, "what is left of the 180° rotation, clockwise positive")
rotation_error = var("rotation_error", ERROR_CLASSES, 0, "free: angleError of an arbitrary yaw")
nearly_turned = flag("nearly_turned", "the last error of the rotation was below 7.5 degrees")
estop_recover_enabled = flag("estop_recover_enabled", "the rover has been at rest since the emergency stop")

v_ref = var("v_ref", V_REFERENCE, doc="linear velocity reference")
omega_ref = var("omega_ref", OMEGA_REFERENCE, doc="angular velocity reference")
actuate_emergency_stop = flag("actuate_emergency_stop", "the rover must be stopped at once")
current_action = var("current_action", COMMAND, "CMD_NORMAL", "action in progress")


def sent(received: Var) -> Var:
    """The content of the frame that arrives with ``rx_update``, for a field of the payload."""
    doc = f"{received.name} in the arriving frame"
    return Var(f"frame_{received.name}", received.domain, received.init, doc)


heartbeat_moves = var("heartbeat_moves", integer(1, 3), doc="by how much a new heartbeat has moved (S40)")

rx_mean_slow = flag("rx_mean_slow", "free: whether the mean exceeds 40 ms at this update")
heartbeat_mean_slow = flag("heartbeat_mean_slow", "free: whether the mean exceeds 40 ms at this update")
