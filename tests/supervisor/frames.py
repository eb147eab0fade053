"""Payloads and frames for the tests of the link."""

from typing import Any

from hypothesis import strategies as st

from rovercheck.supervisor.link.frame import Frame
from rovercheck.supervisor.link.payloads import FromBoard1, FromBoard2
from rovercheck.supervisor.link.wire import B1_TO_B2, B2_TO_B1, Direction
from rovercheck.supervisor.types import SupervisorCommand

DIRECTIONS: tuple[Direction[Any], ...] = (B1_TO_B2, B2_TO_B1)
SIZE = 42
WORDS = st.integers(0, 2**32 - 1)
MASKS = st.integers(0, 0xFF)
NUMBERS = st.floats(width=32, allow_nan=False)

FROM_BOARD_1 = st.builds(
    FromBoard1,
    wheel_speed_rpm=st.tuples(NUMBERS, NUMBERS, NUMBERS, NUMBERS),
    critical_mask=MASKS,
    degraded_mask=MASKS,
    alive_counter=WORDS,
)
FROM_BOARD_2 = st.builds(
    FromBoard2,
    command=st.sampled_from(SupervisorCommand),
    critical_mask=MASKS,
    degraded_mask=MASKS,
    is_motion_consistent=st.booleans(),
    yaw=st.floats(0, 360, width=32),
    x_norm=st.floats(-1, 1, width=32),
    y_norm=st.floats(-1, 1, width=32),
    btn1=st.booleans(),
    btn2=st.booleans(),
    alive_counter=WORDS,
)


@st.composite
def sent(draw: st.DrawFn) -> tuple[Direction[Any], Frame[Any]]:
    """A direction, and a frame that its sender may send."""
    direction = draw(st.sampled_from(DIRECTIONS))
    payload = draw(FROM_BOARD_1 if direction is B1_TO_B2 else FROM_BOARD_2)
    return direction, Frame(payload, draw(WORDS), draw(WORDS))


def flipped(data: bytes, *bits: int) -> bytes:
    """``data`` with some bits changed; bit 0 is the most significant one of the first byte."""
    changed = bytearray(data)
    for bit in bits:
        changed[bit // 8] ^= 0x80 >> bit % 8
    return bytes(changed)
