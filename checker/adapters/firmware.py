"""Where the supervisors of ``supervisor/`` hold what the boards call by name."""

from collections.abc import Mapping

WHEELS = ("FL", "FR", "RL", "RR")
Paths = Mapping[str, str]


def same(*names: str, inside: str = "") -> dict[str, str]:
    """Names that the firmware uses too, in a record inside the outer one."""
    return {name: f"{inside}{name}" for name in names}


def wheels(name: str, tuple_of_four: str) -> dict[str, str]:
    """A quantity of each wheel."""
    return {f"{name}_{wheel}": f"{tuple_of_four}[{index}]" for index, wheel in enumerate(WHEELS)}


BOARD1_INPUTS: Paths = {
    **same("now_ms", "last_valid_b2_ms", "b2_data_last_valid_ms", "temp_last_valid_ms", "batt_last_valid_ms"),
    **same("battery_pct"),
    **same("x_norm", "y_norm", "btn1", "btn2", inside="payload."),
    **wheels("wheel_speed_rpm", "wheel_speed_rpm"),
    **wheels("hasNoFeedback", "has_no_feedback"),
    "temperature_degC": "temperature_degc",
    "cmd": "payload.command",
    "current_yaw": "payload.yaw",
    "isMotionConsistent": "payload.is_motion_consistent",
    "crit_mask_b2": "payload.critical_mask",
    "degr_mask_b2": "payload.degraded_mask",
}
BOARD1_OUTPUTS: Paths = {
    **same("v_ref", "omega_ref", "critical_mask", "degraded_mask", "give_b2_actuation"),
    **same("actuate_emergency_stop", "current_action", "rover_safety_state", "backward_enabled"),
    **same("v_user", "omega_user", "invert_y", "is_rotating180", "estop_recover_enabled", "angle_err"),
    **same("temp_status", "batt_status", "b2_sup_status", "rx_status", inside="statuses."),
    **wheels("wheel_status", "statuses.wheel_status"),
    "b2_critical": "stop_required",
    "b2_degraded": "degraded_required",
    "roverIsStopped": "rover_is_stopped",
    "targetAngle180": "target_angle",
}
BOARD2_INPUTS: Paths = {
    **same("now_ms", "last_valid_b1_ms", "b1_data_last_valid_ms", "sonar_last_valid_ms"),
    **same("imu_last_valid_ms", "ble_last_valid_ms", "yaw", "gz_dps", "btn1", "btn2"),
    **wheels("wheel_speed_rpm", "payload.wheel_speed_rpm"),
    "d1": "dist_cm[0]",
    "d2": "dist_cm[1]",
    "d3": "dist_cm[2]",
    "bx_norm": "x_norm",
    "ay_norm": "y_norm",
    "crit_mask_b1": "payload.critical_mask",
    "degr_mask_b1": "payload.degraded_mask",
}
BOARD2_OUTPUTS: Paths = {
    **same("command", "critical_mask", "degraded_mask", "b2_emergency", "b1_requests_switch", "b1_emergency"),
    **same("autorized_to_send_command", "rover_safety_state", "cmd", "backward_enabled", "current_action"),
    **same("v_ref_actuation", "omega_ref_actuation", "actuate_emergency_stop"),
    **same("b1_sup_status", "esp_status", "imu_status", "rx_status", inside="statuses."),
    "B2Dec": "b2_dec",
    "isMotionConsistent": "is_motion_consistent",
    "DEG_B1": "deg_b1",
    "stop_pin": "actuated.stop_pin",
    "sends_speeds": "actuated.motors?",
    "left_rpm": "actuated.motors.left_rpm",
    "right_rpm": "actuated.motors.right_rpm",
}

INPUTS = {"Board1Inputs": BOARD1_INPUTS, "Board2Inputs": BOARD2_INPUTS}
OUTPUTS = {"Board1Outputs": BOARD1_OUTPUTS, "Board2Outputs": BOARD2_OUTPUTS}
"""By the class of the record; the fields of any other record have the names of the board themselves."""


def _paths(tables: Mapping[str, Paths], record: type) -> Paths:
    from dataclasses import fields

    ours = record.__module__.startswith("rovercheck.supervisor.")
    return tables[record.__name__] if ours else same(*(field.name for field in fields(record)))


def inputs_of(record: type) -> Paths:
    """Where a dataclass of inputs holds each name."""
    return _paths(INPUTS, record)


def outputs_of(record: type) -> Paths:
    """Where a dataclass of outputs holds each name."""
    return _paths(OUTPUTS, record)
