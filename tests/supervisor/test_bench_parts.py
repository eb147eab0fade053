"""The parts of the bench by themselves: the line, the clocks, the driver, the sonars, the judge."""

from functools import partial
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.supervisor.bench import Outcome, judge, parse, simulate
from rovercheck.supervisor.bench.changes import changes
from rovercheck.supervisor.bench.columns import inputs1, inputs2, outputs1, outputs2
from rovercheck.supervisor.bench.line import Line, Port, duration_us
from rovercheck.supervisor.bench.node1 import sides
from rovercheck.supervisor.bench.record import Driver, Side, Traffic
from rovercheck.supervisor.bench.rover import MotorDriver
from rovercheck.supervisor.bench.schedule import Agenda, Clock, Rank
from rovercheck.supervisor.bench.sensors import scan
from rovercheck.supervisor.bench.signals import SIGNALS
from rovercheck.supervisor.board1 import Board1Inputs, Board1Outputs
from rovercheck.supervisor.board2.signals import Board2Inputs, Board2Outputs
from rovercheck.supervisor.link.frame import Frame, Transmitter, encode
from rovercheck.supervisor.link.payloads import FromBoard1
from rovercheck.supervisor.link.receiver import Receiver, hides_sync
from rovercheck.supervisor.link.wire import B1_TO_B2
from tests.profiles import examples
from tests.supervisor.bench_runs import scenario
from tests.supervisor.frames import MASKS, SIZE, WORDS

# --- the line ----------------------------------------------------------------------------------------


SPEEDS = st.integers(-200, 200).map(float)
PAYLOADS = st.lists(
    st.builds(FromBoard1, st.tuples(SPEEDS, SPEEDS, SPEEDS, SPEEDS), MASKS, MASKS, WORDS).filter(
        lambda payload: not hides_sync(B1_TO_B2, encode(B1_TO_B2, Frame(payload)))
    ),
    min_size=1,
    max_size=12,
)
"""What the line can carry exactly: speeds in whole rpm, and no sync word within."""


class Bytes:
    """A line with a receiver at its end, and every payload that the receiver accepted."""

    def __init__(self, **initial: Any) -> None:
        self.agenda, self.traffic = Agenda(), Traffic()
        self.port = Port(Receiver(B1_TO_B2), self.traffic)
        self.accepted: list[FromBoard1] = []
        made = parse({"duration": "10 s", "initial": initial, "seed": 7})
        self.line = Line("b1_b2", made, self.agenda, self.deliver, self.traffic)
        self.transmitter = Transmitter(B1_TO_B2)

    def deliver(self, time_us: int, byte: int) -> None:
        before = self.traffic.accepted
        self.port.byte(byte, time_us // 1000)
        if self.traffic.accepted > before:
            self.accepted.append(self.port.receiver.snapshot.payload)

    def send(self, payloads: list[FromBoard1], every_us: int = 20_000) -> None:
        for number, payload in enumerate(payloads, 1):
            self.line.send(self.transmitter.frame(payload, number), number * every_us)
        self.agenda.run(10**7)


@given(PAYLOADS)
@examples(40)
def test_a_sound_line_delivers_every_frame_in_order(payloads: list[FromBoard1]) -> None:
    line = Bytes()
    line.send(payloads)
    assert line.accepted == payloads


@given(
    PAYLOADS,
    st.sampled_from([0.001, 0.01, 0.1]),
    st.sampled_from([0.0, 0.4]),
)
@examples(60)
def test_nothing_is_accepted_that_was_not_sent(payloads: list[FromBoard1], bits: float, lost: float) -> None:
    line = Bytes(bit_errors=bits, frame_loss=lost)
    line.send(payloads)
    rest = iter(payloads)
    assert all(any(one == sent for sent in rest) for one in line.accepted), (
        "a part of what was sent, in order"
    )
    assert line.traffic.sent == len(payloads)


def test_a_frame_that_comes_before_the_last_one_is_out_is_dropped() -> None:
    line = Bytes()
    line.send([FromBoard1(alive_counter=n) for n in range(6)], every_us=duration_us(SIZE) - 1)
    assert (line.traffic.sent, line.traffic.dropped) == (3, 3)
    assert [payload.alive_counter for payload in line.accepted] == [0, 2, 4]


def test_a_frame_takes_42_bytes_of_10_bits_at_460_800_baud() -> None:
    assert duration_us(SIZE) == 912


# --- clocks ------------------------------------------------------------------------------------------


@given(st.integers(0, 10**9), st.integers(0, 10**9), st.integers(-10_000, 10_000))
@examples(200)
def test_a_clock_shows_each_of_its_milliseconds_when_it_says(start: int, ms: int, drift: int) -> None:
    clock = Clock(start, drift)
    at_us = clock.time_us(ms * 1000)
    assert clock.now_ms(at_us) == ms
    assert ms == 0 or clock.now_ms(at_us - 1) == ms - 1


def _note(seen: list[str], name: str, _time_us: int) -> None:
    seen.append(name)


def test_one_instant_has_an_order() -> None:
    agenda, seen = Agenda(), list[str]()
    for rank in reversed(Rank):
        agenda.enter(5, rank, partial(_note, seen, rank.name))
    agenda.enter(4, Rank.WATCH, partial(_note, seen, "before"))
    agenda.enter(6, Rank.WORLD, partial(_note, seen, "after"))
    agenda.run(5)
    assert seen == ["before", "WORLD", "RECEIVE", "SENSE", "SUPERVISE", "ACTUATE", "TRANSMIT", "WATCH"]


# --- driver and motors -------------------------------------------------------------------------------


def test_the_driver_hears_only_the_board_that_the_relay_connects() -> None:
    driver = MotorDriver(relay=Side.BOARD_1, stop_pins={Side.BOARD_1: False, Side.BOARD_2: True})
    driver.command(Side.BOARD_2, 10.0, 10.0, 0)
    assert driver.wanted(0) == (0.0, 0.0) and driver.source(0) is Driver.NOBODY
    driver.command(Side.BOARD_1, 20.0, 30.0, 1000)
    assert driver.wanted(300_999) == (20.0, 30.0)
    assert driver.wanted(301_000) == (0.0, 0.0) and driver.source(301_000) is Driver.NOBODY


def test_only_the_stop_pin_of_the_connected_board_acts() -> None:
    driver = MotorDriver(relay=Side.BOARD_1, stop_pins={Side.BOARD_1: False, Side.BOARD_2: True})
    driver.command(Side.BOARD_1, 20.0, 30.0, 0)
    assert driver.wanted(1) == (20.0, 30.0)
    driver.relay = Side.BOARD_2
    assert driver.wanted(1) == (0.0, 0.0), "the command of Board 1 is kept, the pin of Board 2 holds"


@given(st.floats(-1, 1), st.floats(-1, 1))
@examples(100)
def test_both_sides_are_scaled_alike_when_a_reference_asks_for_too_much(v: float, omega: float) -> None:
    left, right = sides(v, omega)
    assert max(abs(left), abs(right)) <= 160 + 1e-9
    speed, turn = 160 * v, 80 * omega
    assert left * (speed + turn) == pytest.approx(right * (speed - turn))


# --- sonars ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("distances", "found", "takes_us"),
    [
        (("none", "none", "none"), (301.0, 301.0, 301.0), 20_000),
        (("100 cm", "70.9 cm", "200 cm"), (100.0, 70.0, 200.0), 11_600),
        (("100 cm", "none", "200 cm"), (100.0, 301.0, 200.0), 20_000),
        (("344 cm", "345 cm", "0 cm"), (344.0, 301.0, 0.0), 20_000),
    ],
)
def test_a_scan_ends_with_the_last_of_three_echoes(
    distances: tuple[str, str, str], found: tuple[float, ...], takes_us: int
) -> None:
    left, centre, right = distances
    initial = {"obstacle_left": left, "obstacle_centre": centre, "obstacle_right": right}
    assert scan(scenario(initial=initial), 0) == (found, takes_us)


# --- judging and telling -----------------------------------------------------------------------------


def judged(**expected: Any) -> Outcome:
    forward = {"at": "0.5 s", "for": "0.5 s", "stick_y": 1.0}
    made = parse({"duration": "2 s", "event": [forward], "expect": [{"signal": "board1.v_ref", **expected}]})
    [outcome] = judge(made, simulate(made))
    return outcome


JUDGED = [
    ({"at": "0.4 s", "value": 0.0}, ""),
    ({"at": "0.4 s", "value": 1.0}, "it was 0 until 520 ms."),
    ({"at": "0.4 s", "within": "0.11 s", "value": 1.0}, "it was 0 until 520 ms."),
    ({"at": "0.4 s", "within": "0.12 s", "value": 1.0}, ""),
    ({"at": "0.4 s", "within": "0.12 s", "value": 0.0}, ""),
    ({"at": "0.6 s", "during": "0.41 s", "min": 0.9}, ""),
    ({"at": "0.6 s", "during": "0.42 s", "min": 0.9, "max": 1.1}, "it was 0 at 1.02 s."),
    ({"at": "1.5 s", "value": 1.0}, "it was 0, and not so later either."),
    ({"at": "0 s", "value": 0.0}, ""),
]


@pytest.mark.parametrize(("expected", "instead"), JUDGED)
def test_an_expectation_is_met_or_says_what_happened_instead(expected: dict[str, Any], instead: str) -> None:
    outcome = judged(**expected)
    assert outcome.met == (not instead)
    assert outcome.said.endswith(instead or outcome.said)


def test_changes_are_told_once_and_in_order() -> None:
    made = scenario({"at": "0.5 s", "link": "cut"}, duration="1 s")
    told = [(c.time_us // 1000, c.signal) for c in changes(simulate(made))]
    assert told == sorted(told, key=lambda one: one[0])
    assert [time for time, signal in told if signal == "board1.rx_status"] == [620]
    assert (620, "rover.relay") in told


def test_every_column_is_a_signal() -> None:
    rows = {
        "board1": inputs1(Board1Inputs()) | outputs1(Board1Outputs()),
        "board2": inputs2(Board2Inputs()) | outputs2(Board2Outputs()),
    }
    assert {f"{place}.{name}" for place, row in rows.items() for name in row} == {
        name for name in SIGNALS if not name.startswith("rover.")
    }
