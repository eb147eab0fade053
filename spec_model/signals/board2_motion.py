"""Signals of the reference charts of Board 2: user and heading, references, what the charts remember.

Where Board 1 has a signal of the same name, the name begins with ``B2.``.
"""

from rovercheck.spec_model.lang.domain import fixed
from rovercheck.spec_model.lang.expr import flag, var
from rovercheck.spec_model.signals.common import COMMAND, USER_X, USER_Y
from rovercheck.spec_model.signals.rotation import ERROR, ERROR_CLASSES, HEADING, TARGET

# --- the user, by the joystick; the heading, by the IMU; the wheels, as Board 1 reports them --------

ay_norm = var("ay_norm", USER_Y, 0, "user speed command, positive = forward")
bx_norm = var("bx_norm", USER_X, 0, "user turning command, positive = left (S64)")
btn1 = flag("B2.btn1", "joystick button 1 is pressed")
btn2 = flag("B2.btn2", "joystick button 2 is pressed")
yaw = var("yaw", HEADING, 0, "heading, clockwise positive")
wheels_below_2_5 = flag("B2.wheels_below_2_5", "checkStop: all four wheels are slower than 2.5 rpm")

# --- references, normalised; the charts keep them in [-0.5;0.5] (E25) --------------------------------

V_REFERENCE = fixed(-1, 1, "0.05")
OMEGA_REFERENCE = fixed(-1, 1, "0.5")

v_ref_actuation = var("v_ref_actuation", V_REFERENCE, doc="linear reference while Board 2 drives")
omega_ref_actuation = var(
    "omega_ref_actuation", OMEGA_REFERENCE, doc="angular reference while Board 2 drives, positive = left"
)
actuate_emergency_stop = flag("B2.actuate_emergency_stop", "Board 2 asks for an emergency stop")
current_action = var("B2.current_action", COMMAND, "CMD_NORMAL", "action in progress while Board 2 drives")

# --- what the charts remember ------------------------------------------------------------------------

v_user = var("B2.v_user", V_REFERENCE, doc="ay_norm scaled by V_MAX, of the last execution of UPD")
omega_user = var("B2.omega_user", OMEGA_REFERENCE, doc="bx_norm scaled by OMEGA_MAX")
backward_enabled = flag("B2.backward_enabled", "backward mode, toggled by the joystick buttons")
invert_y = flag("B2.invert_y", "turned around with the stick pulled back, which now means forward")
is_rotating180 = flag("B2.is_rotating180", "Retromarcia_180 of Board 2 is active")
targetAngle = var("B2.targetAngle180", TARGET, 0, "heading at which the 180° rotation ends")
angle_err = var("B2.angle_err", ERROR, 0, "what is left of the 180° rotation, clockwise positive")
rotation_error = var("B2.rotation_error", ERROR_CLASSES, 0, "free: angleError of an arbitrary yaw")
nearly_turned = flag("B2.nearly_turned", "the last error of the rotation was below 7.5 degrees")
rover_is_stopped = flag("B2.roverIsStopped", "checkStop, as remembered by In_frenata_di_emergenza")
estop_recover_enabled = flag("B2.estop_recover_enabled", "the rover has been at rest, or 2 s have passed")
