"""Inputs and outputs of both boards as flat columns, named as in the document: for logs and expectations."""

from rovercheck.supervisor.bench.conditions import WHEELS
from rovercheck.supervisor.board1 import Board1Inputs, Board1Outputs
from rovercheck.supervisor.board2.actuation import MotorCommand
from rovercheck.supervisor.board2.signals import Board2Inputs, Board2Outputs

Scalar = bool | int | float
"""A value of a column; a member of an enumeration is an ``IntEnum``."""


def inputs1(read: Board1Inputs) -> dict[str, Scalar]:
    """What Board 1 reads in a step."""
    payload = read.payload
    return {
        "now_ms": read.now_ms,
        "last_valid_b2_ms": read.last_valid_b2_ms,
        "b2_data_last_valid_ms": read.b2_data_last_valid_ms,
        "temp_last_valid_ms": read.temp_last_valid_ms,
        "batt_last_valid_ms": read.batt_last_valid_ms,
        "temperature_degC": read.temperature_degc,
        "battery_pct": read.battery_pct,
        **_by_wheel("wheel_speed_rpm", read.wheel_speed_rpm),
        **_by_wheel("hasNoFeedback", read.has_no_feedback),
        "cmd": payload.command,
        "x_norm": payload.x_norm,
        "y_norm": payload.y_norm,
        "current_yaw": payload.yaw,
        "btn1": payload.btn1,
        "btn2": payload.btn2,
        "isMotionConsistent": payload.is_motion_consistent,
        "crit_mask_b2": payload.critical_mask,
        "degr_mask_b2": payload.degraded_mask,
    }


def outputs1(made: Board1Outputs) -> dict[str, Scalar]:
    """What Board 1 makes of it."""
    statuses = made.statuses
    return {
        "v_ref": made.v_ref,
        "omega_ref": made.omega_ref,
        "critical_mask": made.critical_mask,
        "degraded_mask": made.degraded_mask,
        "give_b2_actuation": made.give_b2_actuation,
        "actuate_emergency_stop": made.actuate_emergency_stop,
        "current_action": made.current_action,
        "temp_status": statuses.temp_status,
        "batt_status": statuses.batt_status,
        **_by_wheel("wheel_status", statuses.wheel_status),
        "b2_sup_status": statuses.b2_sup_status,
        "rx_status": statuses.rx_status,
        "b2_critical": made.stop_required,
        "b2_degraded": made.degraded_required,
        "rover_safety_state": made.rover_safety_state,
        "backward_enabled": made.backward_enabled,
        "v_user": made.v_user,
        "omega_user": made.omega_user,
        "invert_y": made.invert_y,
        "is_rotating180": made.is_rotating180,
        "estop_recover_enabled": made.estop_recover_enabled,
        "roverIsStopped": made.rover_is_stopped,
        "targetAngle180": made.target_angle,
        "angle_err": made.angle_err,
    }


def inputs2(read: Board2Inputs) -> dict[str, Scalar]:
    """What Board 2 reads in a step."""
    left, centre, right = read.dist_cm
    return {
        "now_ms": read.now_ms,
        "last_valid_b1_ms": read.last_valid_b1_ms,
        "b1_data_last_valid_ms": read.b1_data_last_valid_ms,
        "imu_last_valid_ms": read.imu_last_valid_ms,
        "ble_last_valid_ms": read.ble_last_valid_ms,
        "sonar_last_valid_ms": read.sonar_last_valid_ms,
        "d1": left,
        "d2": centre,
        "d3": right,
        "yaw": read.yaw,
        "gz_dps": read.gz_dps,
        "bx_norm": read.x_norm,
        "ay_norm": read.y_norm,
        "btn1": read.btn1,
        "btn2": read.btn2,
        "crit_mask_b1": read.payload.critical_mask,
        "degr_mask_b1": read.payload.degraded_mask,
        **_by_wheel("wheel_speed_rpm", read.payload.wheel_speed_rpm),
    }


def outputs2(made: Board2Outputs) -> dict[str, Scalar]:
    """What Board 2 makes of it; the speeds of both sides are 0 where none are sent."""
    statuses, sent = made.statuses, made.actuated.motors
    speeds = sent or MotorCommand()
    return {
        "B2Dec": made.b2_dec,
        "command": made.command,
        "critical_mask": made.critical_mask,
        "degraded_mask": made.degraded_mask,
        "b1_sup_status": statuses.b1_sup_status,
        "esp_status": statuses.esp_status,
        "imu_status": statuses.imu_status,
        "rx_status": statuses.rx_status,
        "b2_emergency": made.b2_emergency,
        "b1_requests_switch": made.b1_requests_switch,
        "b1_emergency": made.b1_emergency,
        "autorized_to_send_command": made.autorized_to_send_command,
        "rover_safety_state": made.rover_safety_state,
        "cmd": made.cmd,
        "backward_enabled": made.backward_enabled,
        "current_action": made.current_action,
        "v_ref_actuation": made.v_ref_actuation,
        "omega_ref_actuation": made.omega_ref_actuation,
        "actuate_emergency_stop": made.actuate_emergency_stop,
        "isMotionConsistent": made.is_motion_consistent,
        "DEG_B1": made.deg_b1,
        "stop_pin": made.actuated.stop_pin,
        "sends_speeds": sent is not None,
        "left_rpm": speeds.left_rpm,
        "right_rpm": speeds.right_rpm,
    }


def _by_wheel(name: str, values: tuple[Scalar, ...]) -> dict[str, Scalar]:
    return {f"{name}_{wheel}": value for wheel, value in zip(WHEELS, values, strict=True)}
