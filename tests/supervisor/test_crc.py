"""The checksum has the value the document's parameters give it, and finds what such a checksum must find."""

from itertools import combinations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.supervisor.link.crc import crc16
from tests.supervisor.frames import SIZE, flipped

BITS = SIZE * 8


def by_division(data: bytes) -> int:
    """The checksum bit by bit, straight from its parameters."""
    register = 0xFFFF
    for position in range(len(data) * 8):
        bit = data[position // 8] >> (7 - position % 8) & 1
        leaves = register >> 15 ^ bit
        register = (register << 1 & 0xFFFF) ^ (0x1021 if leaves else 0)
    return register


@pytest.mark.parametrize(
    ("data", "checksum"), [(b"", 0xFFFF), (b"123456789", 0x29B1), (b"\0", 0xE1F0), (b"A", 0xB915)]
)
def test_published_values(data, checksum):
    assert crc16(data) == checksum


@given(st.binary(max_size=100))
def test_it_is_the_remainder_of_a_division(data):
    assert crc16(data) == by_division(data)


@given(st.binary(max_size=100))
def test_data_with_its_own_checksum_leaves_nothing(data):
    assert crc16(data + crc16(data).to_bytes(2, "big")) == 0


def syndrome(*bits: int) -> int:
    """How the checksum of any 42 bytes changes when these bits do: it depends on the bits alone."""
    return crc16(flipped(bytes(SIZE), *bits)) ^ crc16(bytes(SIZE))


@given(st.binary(min_size=SIZE, max_size=SIZE), st.sets(st.integers(0, BITS - 1)))
def test_the_change_depends_on_the_wrong_bits_alone(data, bits):
    assert crc16(flipped(data, *bits)) ^ crc16(data) == syndrome(*bits)


def test_one_or_two_wrong_bits_change_the_checksum_of_every_frame():
    """With the test above: exhaustive over positions, and so for every content."""
    changes = {syndrome(bit) for bit in range(BITS)}
    assert len(changes) == BITS and 0 not in changes


def test_two_changes_are_never_equal_up_to_the_length_of_the_code():
    """x has order 32 767 modulo the polynomial, so 42 bytes are far below what two wrong bits can hide in."""
    register, order = 1, 0
    while order == 0 or register != 1:
        register = (register << 1) ^ (0x11021 if register & 0x8000 else 0)
        order += 1
    assert order == 32767


@given(st.integers(1, 0xFFFF), st.integers(0, BITS - 16))
def test_every_burst_of_up_to_16_bits_is_found(pattern, first):
    bits = [first + position for position in range(16) if pattern >> position & 1]
    assert syndrome(*bits) != 0


@given(st.sets(st.integers(0, BITS - 1)).filter(lambda bits: len(bits) % 2))
def test_every_odd_number_of_wrong_bits_is_found(bits):
    assert syndrome(*bits) != 0


def test_pairs_of_neighbouring_bytes_never_commute():
    """Bytes in the wrong order are noticed as well."""
    assert all(crc16(bytes((a, b))) != crc16(bytes((b, a))) for a, b in combinations(range(256), 2))
