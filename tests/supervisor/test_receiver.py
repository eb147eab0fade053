"""The receive task finds frames again after anything that can happen to bytes on a line [spec §2.4]."""

from typing import Any

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rovercheck.supervisor.link.frame import Frame, Refusal, Transmitter, decode, encode
from rovercheck.supervisor.link.payloads import FromBoard1, FromBoard2
from rovercheck.supervisor.link.receiver import Receiver, RxSnapshot, hides_sync
from rovercheck.supervisor.link.wire import B1_TO_B2, B2_TO_B1, Direction
from tests.supervisor.frames import DIRECTIONS, FROM_BOARD_1, FROM_BOARD_2, SIZE, flipped

OLD, NEW, LAST = (FromBoard1((speed, 0.0, 0.0, 0.0), 1, 2, int(speed)) for speed in (10.0, 20.0, 30.0))
F_OLD, F_NEW, F_LAST = (encode(B1_TO_B2, Frame(payload)) for payload in (OLD, NEW, LAST))
SYNC = B1_TO_B2.sync
GARBAGE = st.binary(max_size=50)


def accepted(receiver: Receiver[Any], data: bytes) -> list[Any]:
    """The payloads that some bytes bring."""
    results = [receiver.byte(value, 0) for value in data]
    return [result.payload for result in results if isinstance(result, Frame)]


# --- what is published -----------------------------------------------------------------------


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_before_the_first_frame(direction):
    assert Receiver(direction).snapshot == RxSnapshot(direction.initial, 0, 0)


def test_the_initial_payloads_are_zero_and_the_motion_counts_as_consistent():
    assert Receiver(B1_TO_B2).snapshot.payload == FromBoard1((0.0, 0.0, 0.0, 0.0), 0, 0, 0)
    initial = Receiver(B2_TO_B1).snapshot.payload
    assert initial == FromBoard2(initial.command, 0, 0, True, 0.0, 0.0, 0.0, False, False, 0)
    assert initial.command == 0


def test_the_last_byte_gives_the_time_of_a_frame():
    receiver = Receiver(B1_TO_B2)
    assert receiver.receive(F_NEW[:-1], 1000) == RxSnapshot(FromBoard1(), 0, 0)
    assert receiver.receive(F_NEW[-1:], 1001) == RxSnapshot(NEW, 1001, 1001)


@pytest.mark.parametrize("bit", [16, 200, SIZE * 8 - 1], ids=["length", "payload", "checksum"])
def test_a_refused_frame_leaves_the_data_and_shows_that_the_task_ran(bit):
    receiver = Receiver(B1_TO_B2)
    receiver.receive(F_OLD, 1000)
    assert receiver.receive(flipped(F_NEW, bit), 1020) == RxSnapshot(OLD, 1000, 1020)


def test_two_frames_at_once_are_two_frames():
    receiver = Receiver(B1_TO_B2)
    assert accepted(receiver, F_OLD + F_NEW) == [OLD, NEW]
    assert Receiver(B1_TO_B2).receive(F_OLD + F_NEW, 60) == RxSnapshot(NEW, 60, 60)


# --- the rules, one by one -------------------------------------------------------------------


def by_the_table(held: bytes, byte: int, sync: bytes) -> tuple[bytes, bytes | None]:
    """The four rows of the document: the bytes held afterwards, and a complete frame."""
    grown = held + bytes([byte])
    if len(held) < 2:
        return (grown[-1:] if len(grown) == 2 and grown != sync else grown), None
    if grown[-2:] == sync:
        return grown[-2:], None
    return (grown, None) if len(grown) < SIZE else (b"", grown)


@st.composite
def lines(draw: st.DrawFn) -> tuple[Direction[Any], bytes]:
    """Bytes as a bad line has them: frames, cut at either end or wrong, sync words, garbage, in any order."""
    direction = draw(st.sampled_from(DIRECTIONS))
    payloads = FROM_BOARD_1 if direction is B1_TO_B2 else FROM_BOARD_2
    pieces = []
    for _ in range(draw(st.integers(1, 6))):
        data = encode(direction, Frame(draw(payloads), draw(st.integers(0, 0xFFFF))))
        first, last = draw(st.integers(0, SIZE)), draw(st.integers(0, SIZE))
        wrong = flipped(data, draw(st.integers(0, SIZE * 8 - 1)))
        syncs = b"\xaa", b"\xaa\xaa", b"\xaa\x55", b"\xaa\x56"
        pieces.append(draw(st.sampled_from((data, data[:last], data[first:], wrong, *syncs)) | GARBAGE))
    return direction, b"".join(pieces)


@given(lines())
def test_every_byte_does_what_the_table_says(line):
    direction, data = line
    receiver, held = Receiver(direction), b""
    for value in data:
        held, complete = by_the_table(held, value, direction.sync)
        expected = None if complete is None else decode(direction, complete)
        assert receiver.byte(value, 0) == expected


@given(lines(), st.integers(0, 300))
def test_it_does_not_matter_how_bytes_come_in_pieces(line, at):
    direction, data = line
    whole, parts = Receiver(direction), Receiver(direction)
    parts.receive(data[:at], 40)
    assert parts.receive(data[at:], 40) == whole.receive(data, 40)


# --- finding frames again --------------------------------------------------------------------


@given(st.binary(max_size=SIZE - 1))
def test_a_frame_is_found_after_garbage_shorter_than_a_frame(garbage):
    """Unless the garbage is a sync word and, with the start of the frame, a whole frame."""
    assume(not (len(garbage) == SIZE - 1 and garbage.startswith(SYNC)))
    assert accepted(Receiver(B1_TO_B2), garbage + F_NEW) == [NEW]


@given(st.binary(max_size=300))
def test_after_any_garbage_the_second_frame_is_found(garbage):
    assert accepted(Receiver(B1_TO_B2), garbage + F_OLD + F_NEW)[-1] == NEW


@given(st.binary(max_size=300), st.binary(max_size=300))
def test_garbage_around_frames_brings_no_payload_of_its_own(before, between):
    data = before + F_OLD + between + F_NEW + F_LAST
    assert set(accepted(Receiver(B1_TO_B2), data)) <= {OLD, NEW, LAST}


@pytest.mark.parametrize("size", range(SIZE - 1))
def test_a_frame_that_ends_early_does_not_cost_the_next(size):
    receiver = Receiver(B1_TO_B2)
    assert accepted(receiver, F_OLD[:size] + F_NEW + F_LAST) == [NEW, LAST]


@pytest.mark.parametrize("size", range(1, SIZE + 1))
def test_a_frame_that_starts_late_does_not_cost_the_next(size):
    assert accepted(Receiver(B1_TO_B2), F_OLD[size:] + F_NEW) == [NEW]


@pytest.mark.parametrize("at", range(SIZE))
def test_a_lost_byte_costs_two_frames_unless_it_is_in_the_sync_word(at):
    """The first byte of the next frame completes the one that is short, and is used up."""
    assert F_OLD[-1] != SYNC[0]
    data = F_OLD[:at] + F_OLD[at + 1 :]
    assert accepted(Receiver(B1_TO_B2), data + F_NEW + F_LAST) == ([NEW, LAST] if at < 2 else [LAST])


@given(st.integers(1, SIZE - 1), st.integers(0, 255))
def test_a_byte_too_many_costs_one_frame(at, byte):
    data = F_OLD[:at] + bytes([byte]) + F_OLD[at:]
    assume(data != F_OLD + data[-1:] and data[:2] == SYNC)
    assert accepted(Receiver(B1_TO_B2), data + F_NEW) == [NEW]


@pytest.mark.parametrize("bit", range(SIZE * 8))
def test_a_wrong_bit_costs_one_frame(bit):
    assert accepted(Receiver(B1_TO_B2), flipped(F_OLD, bit) + F_NEW) == [NEW]


@given(st.sets(st.integers(0, SIZE * 8 - 1), min_size=2, max_size=2))
def test_two_wrong_bits_cost_one_frame(bits):
    assert accepted(Receiver(B1_TO_B2), flipped(F_OLD, *bits) + F_NEW) == [NEW]


# --- the sync word where it should not be ----------------------------------------------------


@pytest.mark.parametrize(
    ("direction", "payload"),
    [
        (B1_TO_B2, FromBoard1((0.0, 85.166016, 0.0, 0.0))),
        (B2_TO_B1, FromBoard2(yaw=85.16797)),
        (B2_TO_B1, FromBoard2(alive_counter=0xAA56)),
    ],
)
def test_a_frame_that_contains_the_sync_word_never_arrives_and_the_next_does(direction, payload):
    data = encode(direction, Frame(payload))
    good = encode(direction, Frame(direction.initial))
    assert isinstance(decode(direction, data), Frame)
    assert hides_sync(direction, data) and not hides_sync(direction, good)
    receiver = Receiver(direction)
    assert accepted(receiver, data * 10) == []
    assert receiver.snapshot.task_last_run_ms == 0
    assert accepted(receiver, good) == [direction.initial]


def test_three_hours_after_power_up_the_time_stamp_silences_the_link_for_a_quarter_of_a_second():
    """A weakness of the protocol: reception is critical after 120 ms [spec Table 2]."""
    transmitter, receiver, gaps = Transmitter(B2_TO_B1), Receiver(B2_TO_B1), []
    for now in range(0xAA5500, 0xAA5800, 20):
        snapshot = receiver.receive(transmitter.frame(FromBoard2(), now), now)
        gaps.append(now - snapshot.data_last_valid_ms)
    assert max(gaps) == 260


@pytest.mark.parametrize(("direction", "sequence"), [(B1_TO_B2, 46609), (B2_TO_B1, 45982)])
def test_a_checksum_that_is_the_sync_word_starts_a_frame(direction, sequence):
    """The sync word has priority over the completion of a frame."""
    data = encode(direction, Frame(direction.initial, sequence))
    assert data.endswith(direction.sync) and hides_sync(direction, data)
    good = encode(direction, Frame(direction.initial))
    receiver = Receiver(direction)
    assert accepted(receiver, data) == []
    assert accepted(receiver, good[2:]) == [direction.initial]


def test_the_first_byte_of_the_sync_word_may_be_repeated():
    assert accepted(Receiver(B1_TO_B2), b"\xaa\xaa" + F_NEW) == [NEW]


def ignores(direction: Direction[Any], own: bytes, foreign: bytes) -> bool:
    """Whether a receiver takes nothing from foreign frames, and its own frame between them."""
    receiver = Receiver(direction)
    untouched = receiver.receive(foreign * 3, 20) == RxSnapshot(direction.initial)
    return untouched and len(accepted(receiver, own + foreign)) == 1


@given(FROM_BOARD_1, FROM_BOARD_2)
def test_the_frames_of_the_other_direction_are_no_frames(from_1, from_2):
    data_1, data_2 = encode(B1_TO_B2, Frame(from_1)), encode(B2_TO_B1, Frame(from_2))
    assume((data_1 + data_2).count(B1_TO_B2.sync) == (data_1 + data_2).count(B2_TO_B1.sync) == 1)
    assert ignores(B1_TO_B2, data_1, data_2)
    assert ignores(B2_TO_B1, data_2, data_1)


@given(st.lists(FROM_BOARD_2, min_size=1, max_size=5))
def test_whatever_board_2_sends_arrives_unless_it_contains_the_sync_word(payloads):
    transmitter, receiver = Transmitter(B2_TO_B1), Receiver(B2_TO_B1)
    frames = [transmitter.frame(payload, 20 * k) for k, payload in enumerate(payloads)]
    arrive = [decode(B2_TO_B1, frame) for frame in frames if not hides_sync(B2_TO_B1, frame)]
    expected = [frame.payload for frame in arrive if isinstance(frame, Frame)]
    assert accepted(receiver, b"".join(frames)) == expected
    assert not any(isinstance(frame, Refusal) for frame in arrive)
