"""The supervisor of Board 2: its blocks in their order, once every 20 ms."""

from rovercheck.supervisor.board2.actuation import Actuated, Actuation
from rovercheck.supervisor.board2.coherence import Coherence
from rovercheck.supervisor.board2.driving import Driving
from rovercheck.supervisor.board2.failure_check import FailureCheck
from rovercheck.supervisor.board2.faults import FaultFinder, Faults
from rovercheck.supervisor.board2.selection import Selected, Selection
from rovercheck.supervisor.board2.signals import Board2Inputs, Board2Outputs
from rovercheck.supervisor.board2.validity import Validity


class Board2:
    """The executable supervisor of Board 2 [spec §3.1]."""

    def __init__(self) -> None:
        self.reset()

    def reset(self) -> None:
        """Back to the state at power-up."""
        self._validity = Validity()
        self._selection = Selection()
        self._fault_finder = FaultFinder()
        self._failure_check = FailureCheck()
        self._driving = Driving()
        self._coherence = Coherence()
        self._actuation = Actuation()

    def step(self, inputs: Board2Inputs) -> Board2Outputs:
        """One execution, with the snapshots as they are at its start.

        Readings that are no numbers are judged first (``validity``); nothing raises, whatever they hold.
        """
        inputs = self._validity.judge(inputs)
        selected = self._select(inputs)
        faults = self._fault_finder.step(inputs)
        statuses = faults.statuses
        autorized = self._failure_check.step(
            faults.classification.b1_requests_switch, statuses.rx_status, statuses.b1_sup_status
        )
        if autorized:
            self._driving.step(inputs, faults)
        actuated = self._actuate(autorized)
        is_motion_consistent = self._coherence.step(
            inputs.last_valid_b1_ms, inputs.imu_last_valid_ms, inputs.payload.wheel_speed_rpm, inputs.gz_dps
        )
        return self._outputs(selected, faults, actuated, is_motion_consistent)

    def _select(self, inputs: Board2Inputs) -> Selected:
        """The decision for Board 1 knows only the authorisation of the step before."""
        payload, autorized = inputs.payload, self._failure_check.autorized_to_send_command
        return self._selection.step(
            inputs.dist_cm, inputs.yaw, payload.critical_mask, payload.degraded_mask, autorized
        )

    def _actuate(self, autorized: bool) -> Actuated:
        motion = self._driving.motion
        return self._actuation.step(autorized, motion.v_ref, motion.omega_ref, motion.emergency_stop)

    def _outputs(
        self, selected: Selected, faults: Faults, actuated: Actuated, is_motion_consistent: bool
    ) -> Board2Outputs:
        driving, motion = self._driving, self._driving.motion
        return Board2Outputs(
            b2_dec=selected.b2_dec,
            command=selected.command,
            critical_mask=faults.critical_mask,
            degraded_mask=faults.degraded_mask,
            is_motion_consistent=is_motion_consistent,
            autorized_to_send_command=self._failure_check.autorized_to_send_command,
            v_ref_actuation=motion.v_ref,
            omega_ref_actuation=motion.omega_ref,
            actuate_emergency_stop=motion.emergency_stop,
            current_action=motion.current_action,
            actuated=actuated,
            deg_b1=selected.deg_b1,
            statuses=faults.statuses,
            b2_emergency=faults.classification.b2_emergency,
            b1_requests_switch=faults.classification.b1_requests_switch,
            b1_emergency=faults.classification.b1_emergency,
            rover_safety_state=driving.safety.rover_safety_state,
            cmd=driving.cmd,
            backward_enabled=driving.backward.backward_enabled,
        )
