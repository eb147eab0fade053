"""Which updates of the snapshots Board 2 takes for valid: the document gives no meaning to NaN or infinity.

A reading that is no number counts as no reading: the values and the stamp of the last valid one stay, as
after a read that failed, so the monitor of the source finds them too old and the rover stops.
"""

from dataclasses import dataclass, field, replace
from math import isfinite

from rovercheck.supervisor.board2.signals import Board2Inputs
from rovercheck.supervisor.motion import axis


@dataclass
class Validity:
    """The last valid reading of the IMU and of the joystick, all 0 at power-up."""

    _valid: Board2Inputs = field(default_factory=Board2Inputs)

    def judge(self, read: Board2Inputs) -> Board2Inputs:
        """The inputs of a step as its blocks see them.

        Distances and wheel speeds pass as they are: their blocks take what is no number for an obstacle
        and for a wheel that turns.
        """
        if isfinite(read.x_norm) and isfinite(read.y_norm):
            inputs = replace(read, x_norm=axis(read.x_norm), y_norm=axis(read.y_norm))
        else:
            inputs = self._last_joystick(read)
        if not (isfinite(read.yaw) and isfinite(read.gz_dps)):
            inputs = self._last_imu(inputs)
        self._valid = inputs
        return inputs

    def _last_joystick(self, inputs: Board2Inputs) -> Board2Inputs:
        last = self._valid
        return replace(
            inputs,
            x_norm=last.x_norm,
            y_norm=last.y_norm,
            btn1=last.btn1,
            btn2=last.btn2,
            ble_last_valid_ms=last.ble_last_valid_ms,
        )

    def _last_imu(self, inputs: Board2Inputs) -> Board2Inputs:
        last = self._valid
        return replace(inputs, yaw=last.yaw, gz_dps=last.gz_dps, imu_last_valid_ms=last.imu_last_valid_ms)
