"""What happened in a run: every change of a status, a command, the relay or an emergency stop."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from rovercheck.supervisor.bench.columns import Scalar
from rovercheck.supervisor.bench.judge import history
from rovercheck.supervisor.bench.record import Record
from rovercheck.supervisor.bench.signals import SIGNALS

TOLD = (
    *(f"board1.{name}" for name in ("temp_status", "batt_status", "b2_sup_status", "rx_status")),
    *(f"board1.wheel_status_{wheel}" for wheel in ("FL", "FR", "RL", "RR")),
    "board1.rover_safety_state",
    "board1.current_action",
    "board1.actuate_emergency_stop",
    "board1.backward_enabled",
    "board1.give_b2_actuation",
    *(f"board2.{name}" for name in ("esp_status", "imu_status", "rx_status", "b1_sup_status")),
    "board2.command",
    "board2.autorized_to_send_command",
    "board2.rover_safety_state",
    "board2.current_action",
    "board2.actuate_emergency_stop",
    "board2.backward_enabled",
    "rover.relay",
    "rover.driven_by",
)
"""The signals whose changes are told, in this order within one instant."""


@dataclass(frozen=True)
class Change:
    """A signal that has a new value, at a time in microseconds."""

    time_us: int
    signal: str
    old: Scalar
    new: Scalar


def changes(record: Record, signals: Iterable[str] = TOLD) -> list[Change]:
    """All changes in the order of time."""
    found = [change for signal in signals for change in _of(record, signal)]
    return sorted(found, key=lambda change: change.time_us)


def _of(record: Record, signal: str) -> Iterator[Change]:
    told = history(record, signal)
    last = SIGNALS[signal].initial
    for time_us, value in zip(told.times_us, told.values, strict=True):
        if value != last:
            yield Change(time_us, signal, last, value)
            last = value
