"""Whether Board 2 may send motor commands: as soon as Board 1 cannot, until 3 s after it can again."""

from dataclasses import dataclass, field
from enum import Enum, auto

from rovercheck.supervisor.timing import Duration, steps
from rovercheck.supervisor.types import Level


class _State(Enum):
    B1_ACTUATING = auto()
    B2_TRYING_TO_ACTUATE = auto()


@dataclass
class FailureCheck:
    """The check for a failure of Board 1; the relay of Board 1 decides by itself [spec §2.5, Fig 16]."""

    autorized_to_send_command: bool = False
    _state: _State | None = None
    _sound: Duration = field(default_factory=lambda: Duration(steps(3)))

    def step(self, b1_requests_switch: bool, rx_status: Level, b1_sup_status: Level) -> bool:
        """Whether Board 2 is authorised in this step; never in the first one."""
        failed = b1_requests_switch or Level.CRITICAL in (rx_status, b1_sup_status)
        if self._state is None:
            self._enter(_State.B1_ACTUATING)
        elif self._state is _State.B1_ACTUATING:
            if failed:
                self._enter(_State.B2_TRYING_TO_ACTUATE)
        elif self._sound.test(not failed):
            self._enter(_State.B1_ACTUATING)
        self._sound.end_step(self._state is _State.B2_TRYING_TO_ACTUATE, not failed)
        return self.autorized_to_send_command

    def _enter(self, state: _State) -> None:
        self._state = state
        self._sound.enter()
        self.autorized_to_send_command = state is _State.B2_TRYING_TO_ACTUATE
