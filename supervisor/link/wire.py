"""How each payload is laid out in bytes: the document names the fields, the widths and the order are ours.

Everything is most significant byte first, as the document has it for the sync word.  Measurements are single
precision [spec Fig 10, Fig 13, Fig 14], stamps and counters have 32 bits [spec Fig 10], the 8-bit masks
travel in 32 bits, a command and a truth value in 8.  A payload has 28 bytes then and a frame 42 in either
direction: 0.91 ms at 460 800 baud.
"""

from collections.abc import Callable
from ctypes import c_float
from dataclasses import dataclass
from struct import Struct
from typing import Generic, TypeVar

from rovercheck.supervisor.link.payloads import FromBoard1, FromBoard2
from rovercheck.supervisor.types import SupervisorCommand

P = TypeVar("P", FromBoard1, FromBoard2)

_FROM_BOARD_1 = Struct(">4f I I I")
_FROM_BOARD_2 = Struct(">B I I B 3f B B I")


@dataclass(frozen=True)
class Direction(Generic[P]):
    """One direction of the link: who sends, and how the payload becomes bytes and back.

    ``pack`` raises ValueError for a payload that no board can have, ``unpack`` for bytes without meaning.
    """

    sync: bytes
    """The message identifier, two bytes: where a frame starts."""
    payload_size: int
    initial: P
    """What the receiver has before the first accepted frame."""
    pack: Callable[[P], bytes]
    unpack: Callable[[bytes], P]


def single(value: float) -> float:
    """The number that single precision makes of ``value``, as the shortest decimal that stands for it.

    So a limit of the document survives the wire: 0.4 stays 0.4, as ``y < 0.4f`` would see it in C, and
    numbers keep their order.  What is too large becomes infinite; infinity and not-a-number pass.
    """
    held: float = c_float(value).value
    decimals = (float(f"{held:.{digits}g}") for digits in range(6, 10))
    return next((decimal for decimal in decimals if c_float(decimal).value == held), held)


def _mask(bits: int) -> int:
    if not 0 <= bits <= 0xFF:
        raise ValueError(f"{bits:#x} is no fault mask: it has 8 bits, so write 0 to 0xff")
    return bits


def _flag(byte: int) -> bool:
    if byte not in (0, 1):
        raise ValueError(f"{byte:#04x} is no truth value: write 0 or 1")
    return byte == 1


def _counter(value: int) -> int:
    if not 0 <= value < 1 << 32:
        raise ValueError(f"{value} is no alive counter: it has 32 bits, so write it modulo 2**32")
    return value


def _pack_1(payload: FromBoard1) -> bytes:
    return _FROM_BOARD_1.pack(
        *(c_float(speed).value for speed in payload.wheel_speed_rpm),
        _mask(payload.critical_mask),
        _mask(payload.degraded_mask),
        _counter(payload.alive_counter),
    )


def _unpack_1(data: bytes) -> FromBoard1:
    w1, w2, w3, w4, critical, degraded, alive = _FROM_BOARD_1.unpack(data)
    speeds = single(w1), single(w2), single(w3), single(w4)
    return FromBoard1(speeds, _mask(critical), _mask(degraded), alive)


def _pack_2(payload: FromBoard2) -> bytes:
    return _FROM_BOARD_2.pack(
        SupervisorCommand(payload.command),
        _mask(payload.critical_mask),
        _mask(payload.degraded_mask),
        _flag(payload.is_motion_consistent),
        *(c_float(number).value for number in (payload.yaw, payload.x_norm, payload.y_norm)),
        _flag(payload.btn1),
        _flag(payload.btn2),
        _counter(payload.alive_counter),
    )


def _unpack_2(data: bytes) -> FromBoard2:
    command, critical, degraded, consistent, yaw, x, y, btn1, btn2, alive = _FROM_BOARD_2.unpack(data)
    return FromBoard2(
        command=SupervisorCommand(command),
        critical_mask=_mask(critical),
        degraded_mask=_mask(degraded),
        is_motion_consistent=_flag(consistent),
        yaw=single(yaw),
        x_norm=single(x),
        y_norm=single(y),
        btn1=_flag(btn1),
        btn2=_flag(btn2),
        alive_counter=alive,
    )


B1_TO_B2 = Direction(b"\xaa\x55", _FROM_BOARD_1.size, FromBoard1(), _pack_1, _unpack_1)
B2_TO_B1 = Direction(b"\xaa\x56", _FROM_BOARD_2.size, FromBoard2(), _pack_2, _unpack_2)
