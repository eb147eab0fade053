"""Frames come back as they were sent, and nothing else is taken for a frame."""

import math
from dataclasses import replace
from itertools import combinations
from typing import Any

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rovercheck.supervisor.link.crc import crc16
from rovercheck.supervisor.link.frame import Frame, Refusal, Transmitter, decode, encode, frame_size
from rovercheck.supervisor.link.payloads import FromBoard1, FromBoard2
from rovercheck.supervisor.link.wire import B1_TO_B2, B2_TO_B1, Direction, single
from rovercheck.supervisor.types import SupervisorCommand
from tests.supervisor.frames import DIRECTIONS, NUMBERS, SIZE, flipped, sent

B1 = Frame(FromBoard1((60.0, 59.5, -2.5, 0.0), 0x84, 0x01, 1000), 77, 20_000)
B2 = Frame(FromBoard2(SupervisorCommand.CMD_ESTOP, 2, 4, False, 359.9, -0.7, 0.4, True, False, 9), 5, 180)
SAMPLES: tuple[tuple[Direction[Any], Frame[Any]], ...] = ((B1_TO_B2, B1), (B2_TO_B1, B2))


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_a_frame_takes_about_nine_tenths_of_a_millisecond(direction):
    assert frame_size(direction) == SIZE
    assert 0.85 < SIZE * 10 / 460.8 < 0.95


def test_the_bytes_of_board_1():
    words = "aa55 001c 0000004d 00004e20 42700000 426e0000 c0200000 00000000 00000084 00000001 000003e8"
    body = bytes.fromhex(words)
    assert encode(B1_TO_B2, B1) == body + crc16(body).to_bytes(2, "big")


def test_the_bytes_of_board_2():
    words = "aa56 001c 00000005 000000b4 07 00000002 00000004 00 43b3f333 bf333333 3ecccccd 01 00 00000009"
    body = bytes.fromhex(words)
    assert encode(B2_TO_B1, B2) == body + crc16(body).to_bytes(2, "big")


@given(sent())
def test_what_is_decoded_is_what_was_encoded(case):
    direction, frame = case
    decoded = decode(direction, encode(direction, frame))
    assert isinstance(decoded, Frame)
    assert (decoded.sequence, decoded.supervisor_run_ms) == (frame.sequence, frame.supervisor_run_ms)
    assert encode(direction, decoded) == encode(direction, frame)
    assert decode(direction, encode(direction, decoded)) == decoded


@pytest.mark.parametrize(("direction", "frame"), SAMPLES)
def test_ordinary_values_come_back_exactly(direction, frame):
    assert decode(direction, encode(direction, frame)) == frame


@pytest.mark.parametrize(("direction", "frame"), SAMPLES)
def test_every_wrong_bit_is_refused_with_its_reason(direction, frame):
    data = encode(direction, frame)
    for bit in range(SIZE * 8):
        reason = {0: Refusal.SYNC, 1: Refusal.LENGTH}.get(bit // 16, Refusal.CHECKSUM)
        assert decode(direction, flipped(data, bit)) is reason


@pytest.mark.parametrize(("direction", "frame"), SAMPLES)
def test_every_two_wrong_bits_are_refused(direction, frame):
    data = encode(direction, frame)
    for bits in combinations(range(SIZE * 8), 2):
        assert isinstance(decode(direction, flipped(data, *bits)), Refusal)


@given(sent(), st.sets(st.integers(0, SIZE * 8 - 1), min_size=1, max_size=2))
def test_one_or_two_wrong_bits_are_refused_whatever_is_sent(case, bits):
    direction, frame = case
    assert isinstance(decode(direction, flipped(encode(direction, frame), *bits)), Refusal)


@given(sent(), st.binary(min_size=1, max_size=50))
def test_every_truncation_and_every_excess_is_refused(case, more):
    direction, frame = case
    data = encode(direction, frame)
    assert all(decode(direction, data[:size]) is Refusal.SIZE for size in range(SIZE))
    assert decode(direction, data + more) is Refusal.SIZE


@given(sent())
def test_a_board_does_not_take_its_own_frames(case):
    direction, frame = case
    (other,) = (each for each in DIRECTIONS if each is not direction)
    assert decode(other, encode(direction, frame)) is Refusal.SYNC


def resealed(data: bytes, at: int, new: bytes) -> bytes:
    """A frame with other bytes in some place and the checksum that fits them."""
    body = data[:at] + new + data[at + len(new) : -2]
    return body + crc16(body).to_bytes(2, "big")


def test_a_wrong_length_is_refused_though_the_checksum_fits():
    assert decode(B2_TO_B1, resealed(encode(B2_TO_B1, B2), 2, b"\0\x1d")) is Refusal.LENGTH


@pytest.mark.parametrize(("at", "byte"), [(12, 8), (12, 255), (13, 1), (19, 1), (21, 2), (34, 2), (35, 0x80)])
def test_a_field_without_meaning_is_refused_though_the_checksum_fits(at, byte):
    assert decode(B2_TO_B1, resealed(encode(B2_TO_B1, B2), at, bytes([byte]))) is Refusal.CONTENT


@pytest.mark.parametrize("at", [28, 30, 34])
def test_a_mask_of_board_1_has_8_bits(at):
    assert decode(B1_TO_B2, resealed(encode(B1_TO_B2, B1), at, b"\1")) is Refusal.CONTENT


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"critical_mask": 256}, "8 bits"),
        ({"degraded_mask": -1}, "8 bits"),
        ({"alive_counter": 1 << 32}, "modulo"),
        ({"alive_counter": -1}, "modulo"),
        ({"command": 8}, "8 is not a valid SupervisorCommand"),
        ({"btn2": 2}, "no truth value"),
    ],
)
def test_what_no_board_says_is_not_sent(change, text):
    with pytest.raises(ValueError, match=text):
        encode(B2_TO_B1, Frame(replace(B2.payload, **change)))


@pytest.mark.parametrize("speed", [math.inf, -math.inf, 1e39, -1e300])
def test_infinite_and_too_large_measurements_arrive_as_infinite(speed):
    payload = FromBoard1((speed, 0.0, 0.0, 0.0))
    decoded = decode(B1_TO_B2, encode(B1_TO_B2, Frame(payload)))
    assert isinstance(decoded, Frame)
    assert decoded.payload.wheel_speed_rpm[0] == math.copysign(math.inf, speed)


def test_not_a_number_arrives_as_such():
    decoded = decode(B2_TO_B1, encode(B2_TO_B1, Frame(replace(B2.payload, yaw=math.nan))))
    assert isinstance(decoded, Frame)
    assert math.isnan(decoded.payload.yaw)
    assert replace(decoded.payload, yaw=B2.payload.yaw) == B2.payload


@example(0.000976565)
@given(st.decimals(-999, 999, places=3).map(float))
def test_limits_with_six_digits_survive_single_precision(value):
    assert single(value) == value


@example(101.46162414550781, 101.5)
@given(NUMBERS, NUMBERS)
def test_single_precision_keeps_the_order_and_the_number(a, b):
    assert (single(a) < single(b)) == (a < b)
    assert single(a) == float(f"{single(a):.9g}")
    assert single(single(a)) == single(a) == pytest.approx(a, rel=2**-23)


def test_frames_are_numbered_and_the_number_and_the_clock_wrap():
    transmitter = Transmitter(B1_TO_B2, 2**32 - 1)
    clocks = 2**32 - 10, 10, 2**32 + 30
    frames = [decode(B1_TO_B2, transmitter.frame(B1.payload, now)) for now in clocks]
    numbers = [(f.sequence, f.supervisor_run_ms) for f in frames if isinstance(f, Frame)]
    assert numbers == [(2**32 - 1, 2**32 - 10), (0, 10), (1, 30)]


def test_the_first_frame_has_number_0():
    assert decode(B2_TO_B1, Transmitter(B2_TO_B1).frame(B2.payload, 20)) == Frame(B2.payload, 0, 20)
