"""The supervisor of Board 1: its blocks in their order, once every 20 ms [spec §2.1, Fig 11]."""

from rovercheck.supervisor.backward import BackwardToggle
from rovercheck.supervisor.board1.classify import Requirements, classify
from rovercheck.supervisor.board1.masks import Masks, fault_masks
from rovercheck.supervisor.board1.monitors import (
    BatteryMonitor,
    TemperatureMonitor,
    UpdateMonitor,
    wheel_status,
)
from rovercheck.supervisor.board1.motion import MotionSupervision
from rovercheck.supervisor.board1.relay import Relay
from rovercheck.supervisor.board1.safety import Safety
from rovercheck.supervisor.board1.signals import Board1Inputs, Board1Outputs, Statuses
from rovercheck.supervisor.board1.states import MotionInputs
from rovercheck.supervisor.motion import axis, heading


class Board1:
    """SupervisorB1.

    While Board 2 drives, the references are not computed: safety state, backward mode and motion are frozen,
    with all their outputs, and go on from there when Board 1 drives again.
    """

    def __init__(self) -> None:
        self.reset()

    def reset(self) -> None:
        """Power-up."""
        self._temperature = TemperatureMonitor()
        self._battery = BatteryMonitor()
        self._supervisor = UpdateMonitor()
        self._reception = UpdateMonitor()
        self._relay = Relay()
        self._safety = Safety()
        self._backward = BackwardToggle()
        self._motion = MotionSupervision()

    def step(self, inputs: Board1Inputs) -> Board1Outputs:
        """One execution of the supervisor."""
        statuses = self._monitor(inputs)
        masks = fault_masks(statuses)
        required = classify(inputs.payload.critical_mask, inputs.payload.degraded_mask)
        if not self._relay.step(statuses.rx_status, statuses.b2_sup_status):
            self._compute_references(inputs, masks, required)
        return self._outputs(statuses, masks, required)

    def _monitor(self, inputs: Board1Inputs) -> Statuses:
        now = inputs.now_ms
        fl, fr, rl, rr = inputs.has_no_feedback
        consistent = inputs.payload.is_motion_consistent
        return Statuses(
            temp_status=self._temperature.step(inputs.temperature_degc, inputs.temp_last_valid_ms, now),
            batt_status=self._battery.step(inputs.battery_pct, inputs.batt_last_valid_ms, now),
            wheel_status=(
                wheel_status(fl, consistent),
                wheel_status(fr, consistent),
                wheel_status(rl, consistent),
                wheel_status(rr, consistent),
            ),
            b2_sup_status=self._supervisor.step(inputs.last_valid_b2_ms, now),
            rx_status=self._reception.step(inputs.b2_data_last_valid_ms, now),
        )

    def _compute_references(self, inputs: Board1Inputs, masks: Masks, required: Requirements) -> None:
        payload = inputs.payload
        x_norm, y_norm = axis(payload.x_norm), axis(payload.y_norm)
        self._safety.step(
            critical=masks.critical != 0 or required.stop,
            degraded=masks.degraded != 0 or required.degraded,
        )
        self._backward.step(payload.x_norm, payload.y_norm, payload.btn1, payload.btn2)
        self._motion.step(
            MotionInputs(
                cmd=payload.command,
                x_norm=x_norm,
                y_norm=y_norm,
                yaw=heading(payload.yaw),
                wheel_speed_rpm=inputs.wheel_speed_rpm,
                rover_status=self._safety.state,
                backward_enabled=self._backward.backward_enabled,
            )
        )

    def _outputs(self, statuses: Statuses, masks: Masks, required: Requirements) -> Board1Outputs:
        motion = self._motion
        return Board1Outputs(
            v_ref=motion.v_ref,
            omega_ref=motion.omega_ref,
            critical_mask=masks.critical,
            degraded_mask=masks.degraded,
            give_b2_actuation=self._relay.give_b2_actuation,
            actuate_emergency_stop=motion.emergency_stop,
            current_action=motion.current_action,
            statuses=statuses,
            stop_required=required.stop,
            degraded_required=required.degraded,
            rover_safety_state=self._safety.state,
            backward_enabled=self._backward.backward_enabled,
            v_user=motion.user.v_user,
            omega_user=motion.user.omega_user,
            invert_y=motion.user.invert_y,
            is_rotating180=motion.is_rotating180,
            estop_recover_enabled=motion.estop_recover_enabled,
            rover_is_stopped=motion.rover_is_stopped,
            target_angle=motion.target_angle,
            angle_err=motion.angle_err,
        )
