"""What drives Board 1, or one of its sensors, step by step in the tests."""

from dataclasses import replace

from rovercheck.supervisor.board1 import Board1, Board1Inputs
from rovercheck.supervisor.link.payloads import FromBoard2
from rovercheck.supervisor.timing import CLOCK


class Sensor:
    """A monitor fed with fresh interpretations, one per step of 20 ms."""

    def __init__(self, monitor, start_ms=1000):
        self.monitor, self.now = monitor, start_ms - 20

    def fresh(self, *interpretations):
        for interpretation in interpretations:
            self.now += 20
            self.monitor.step(interpretation, self.now % CLOCK, self.now % CLOCK)
        return self.monitor.status

    def stale(self, interpretation, age):
        """One step so long after the interpretation."""
        return self.monitor.step(interpretation, (self.now - age) % CLOCK, self.now % CLOCK)


class Bench:
    """Board 1 on a clock of 20 ms with a live link, fresh sensors and a joystick at rest."""

    def __init__(self, start_ms=20):
        self.board, self.now = Board1(), start_ms - 20
        self.payload = FromBoard2()
        self.inputs = Board1Inputs(temperature_degc=25.0, battery_pct=80.0)
        self.link_ms = self.heart_ms = 0
        self.link = self.heart = True

    def set(self, **changes):
        """Change the payload or the inputs from now on."""
        names = FromBoard2.__dataclass_fields__
        self.payload = replace(self.payload, **{n: v for n, v in changes.items() if n in names})
        self.inputs = replace(self.inputs, **{n: v for n, v in changes.items() if n not in names})
        return self

    def step(self, steps=1):
        for _ in range(steps):
            self.now = (self.now + 20) % CLOCK
            if self.link:
                self.link_ms, received = self.now, self.payload
                self.heart_ms = self.now if self.heart else self.heart_ms
                self.inputs = replace(self.inputs, payload=received)
            self.inputs = replace(
                self.inputs,
                now_ms=self.now,
                last_valid_b2_ms=self.heart_ms,
                b2_data_last_valid_ms=self.link_ms,
                temp_last_valid_ms=self.now,
                batt_last_valid_ms=self.now,
            )
            out = self.board.step(self.inputs)
        return out


def references(out):
    return out.v_ref, out.omega_ref


def lose_link(bench):
    """Board 1 gives actuation away in the seventh step without a frame."""
    bench.link = False
    assert not bench.step(6).give_b2_actuation
    return bench.step()
