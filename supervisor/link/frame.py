"""A frame of the link: header, payload and checksum, and the reasons why one is refused.

The header is the sync word, the length of the payload, a sequence number and the time stamp of the sender's
supervisor run; their widths, 2, 2, 4 and 4 bytes, are ours.  The checksum, 2 bytes, covers all before it.
"""

from dataclasses import dataclass
from enum import Enum
from struct import Struct
from typing import Generic

from rovercheck.supervisor.link.crc import crc16
from rovercheck.supervisor.link.wire import Direction, P

_HEADER = Struct(">2s H I I")
_CHECKSUM = Struct(">H")
WORD = 1 << 32
"""Sequence numbers and time stamps start again at 0 here."""


class Refusal(Enum):
    """Why bytes are no frame; the first that applies, in this order."""

    SIZE = "too few or too many bytes"
    SYNC = "the sync word is not that of the sender"
    LENGTH = "the header announces another length"
    CHECKSUM = "the checksum is wrong"
    CONTENT = "the checksum is right, yet a field has no meaning: a command above 7, a flag above 1"


@dataclass(frozen=True)
class Frame(Generic[P]):
    """What one transmission says."""

    payload: P
    sequence: int = 0
    """The number of the frame, modulo 2**32; the document gives the receiver no rule to use it."""
    supervisor_run_ms: int = 0
    """When the supervisor of the sender ran, on the clock of the sender."""


def frame_size(direction: Direction[P]) -> int:
    """The bytes of a frame."""
    return _HEADER.size + direction.payload_size + _CHECKSUM.size


def encode(direction: Direction[P], frame: Frame[P]) -> bytes:
    """The bytes of a frame.

    Raises ValueError for a payload that no board can have: a mask of more than 8 bits, no such command.
    """
    numbers = frame.sequence % WORD, frame.supervisor_run_ms % WORD
    header = _HEADER.pack(direction.sync, direction.payload_size, *numbers)
    body = header + direction.pack(frame.payload)
    return body + _CHECKSUM.pack(crc16(body))


def decode(direction: Direction[P], data: bytes) -> Frame[P] | Refusal:
    """The frame that ``data`` is, or why it is none.

    Infinite and not-a-number measurements pass: what they mean is for the supervisor to say.
    """
    if len(data) != frame_size(direction):
        return Refusal.SIZE
    sync, length, sequence, run_ms = _HEADER.unpack_from(data)
    if sync != direction.sync:
        return Refusal.SYNC
    if length != direction.payload_size:
        return Refusal.LENGTH
    if crc16(data) != 0:
        return Refusal.CHECKSUM
    try:
        payload = direction.unpack(data[_HEADER.size : -_CHECKSUM.size])
    except ValueError:
        return Refusal.CONTENT
    return Frame(payload, sequence, run_ms)


@dataclass
class Transmitter(Generic[P]):
    """Numbers the frames of one direction, from 0, and encodes them."""

    direction: Direction[P]
    _sequence: int = 0

    def frame(self, payload: P, supervisor_run_ms: int) -> bytes:
        """The next frame; ValueError as for :func:`encode`."""
        data = encode(self.direction, Frame(payload, self._sequence, supervisor_run_ms))
        self._sequence += 1
        return data
