"""The receive task of a board: collects bytes, finds frames again after an error, keeps the last good one."""

from dataclasses import dataclass
from typing import Generic

from rovercheck.supervisor.link.frame import Frame, Refusal, decode, frame_size
from rovercheck.supervisor.link.wire import Direction, P


@dataclass(frozen=True)
class RxSnapshot(Generic[P]):
    """What the receive task publishes [spec §2.2, §2.4]."""

    payload: P
    """That of the last accepted frame."""
    data_last_valid_ms: int = 0
    """When the last frame was accepted; 0 before the first."""
    task_last_run_ms: int = 0
    """When the last frame was complete, accepted or not; 0 before the first."""


def hides_sync(direction: Direction[P], data: bytes) -> bool:
    """Whether a frame has its sync word a second time: the receiver starts anew there and loses the frame.

    About one frame in 10 000 does by chance.  A field that keeps such a value silences the link for as long:
    a heading at standstill, or the time stamp, which has it in its middle for 256 ms every 4.7 hours.
    """
    return data.rfind(direction.sync) > 0


class Receiver(Generic[P]):
    """Takes the bytes of one direction as they arrive.

    A sync word starts a frame wherever it stands, also within a frame and in its last two bytes; once a frame
    has its length it is tested and all its bytes are used up, be it accepted or not.  No time runs out: an
    unfinished frame waits for its next byte.  So a frame that contains the sync word (:func:`hides_sync`)
    never arrives, and a byte lost on the line costs two frames: the next one completes this with its first.
    """

    def __init__(self, direction: Direction[P]) -> None:
        self._direction: Direction[P] = direction
        self._held = bytearray()
        self.snapshot: RxSnapshot[P] = RxSnapshot(direction.initial)

    def receive(self, data: bytes, now_ms: int) -> RxSnapshot[P]:
        """Take bytes that arrive at ``now_ms`` on the clock of this board; what is published after them."""
        for value in data:
            self.byte(value, now_ms)
        return self.snapshot

    def byte(self, value: int, now_ms: int) -> Frame[P] | Refusal | None:
        """Take one byte, 0 to 255: the frame or refusal that it completes, None if it completes nothing."""
        held, sync = self._held, self._direction.sync
        held.append(value)
        if held.endswith(sync):
            held[:] = sync
        elif len(held) == len(sync):
            del held[0]
        elif len(held) == frame_size(self._direction):
            return self._complete(now_ms)
        return None

    def _complete(self, now_ms: int) -> Frame[P] | Refusal:
        result = decode(self._direction, bytes(self._held))
        self._held.clear()
        if isinstance(result, Frame):
            self.snapshot = RxSnapshot(result.payload, now_ms, now_ms)
        else:
            kept = self.snapshot
            self.snapshot = RxSnapshot(kept.payload, kept.data_last_valid_ms, now_ms)
        return result
