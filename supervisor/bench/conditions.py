"""What a scenario may set: the world around the rover, the hands on the joystick, and every fault."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf
from types import MappingProxyType

from rovercheck.supervisor.bench.course import Setting
from rovercheck.supervisor.bench.errors import ScenarioError, nearest, quoted
from rovercheck.supervisor.bench.quantities import CHARGE, DISTANCE, TEMPERATURE, TIME, Dimension
from rovercheck.supervisor.bench.table import number, truth

WHEELS = ("FL", "FR", "RL", "RR")
"""Front left, front right, rear left, rear right."""
SIDES = ("left", "centre", "right")
"""The sonars, in the order of their numbers."""
NO_ECHO = "none"
"""Written for an obstacle that is not there."""


@dataclass(frozen=True)
class Condition:
    """One thing that a scenario may set.

    With ``words`` it is one of them; else a number from ``low`` to ``high`` in the base unit of
    ``dimension``, or without unit; else true or false.  ``may_be_none``: ``"none"`` stands for infinity.
    """

    doc: str
    initial: Setting
    words: tuple[str, ...] = ()
    dimension: Dimension | None = None
    low: float = 0.0
    high: float = 0.0
    may_be_none: bool = False

    @property
    def is_number(self) -> bool:
        """Whether it may run evenly from one value to another."""
        return not self.words and not isinstance(self.initial, bool)

    def parse(self, path: str, written: object) -> Setting:
        """The value that is written; ScenarioError for one that this condition cannot have."""
        if self.words:
            return self._word(path, written)
        if not self.is_number:
            return truth(path, written)
        if self.may_be_none and written == NO_ECHO:
            return inf
        return self._number(path, written)

    def _word(self, path: str, written: object) -> str:
        if isinstance(written, str) and written in self.words:
            return written
        raise ScenarioError(
            path, f"{quoted(written)} has no meaning here. {nearest(str(written), self.words)}"
        )

    def _number(self, path: str, written: object) -> float:
        dimension = self.dimension
        found = float(dimension.parse(path, written) if dimension else number(path, written))
        if not self.low <= found <= self.high:
            base = f" {next(iter(self.dimension.units))}" if self.dimension else ""
            raise ScenarioError(
                path, f"{quoted(written)} is out of range; write {self.low:g}{base} to {self.high:g}{base}."
            )
        return found


def _one_of(doc: str, *words: str) -> Condition:
    return Condition(doc, words[0], words)


def _both_ways(name: str, condition: Condition) -> dict[str, Condition]:
    return {f"{name}_b1_b2": condition, f"{name}_b2_b1": condition}


_DELAY = Condition("time a frame takes besides its own length", 0.0, dimension=TIME, high=10**6)

CONDITIONS: Mapping[str, Condition] = MappingProxyType(
    {
        "stick_y": Condition("joystick, forward is 1", 0.0, low=-1, high=1),
        "stick_x": Condition("joystick, left is 1", 0.0, low=-1, high=1),
        "btn1": Condition("button 1 is pressed", False),
        "btn2": Condition("button 2 is pressed", False),
        **{
            f"obstacle_{side}": Condition(
                f"distance of the nearest thing before the {side} sonar",
                inf,
                dimension=DISTANCE,
                high=10_000,
                may_be_none=True,
            )
            for side in SIDES
        },
        "temperature": Condition("at the sensor", 25.0, dimension=TEMPERATURE, low=-100, high=200),
        "battery": Condition("charge left", 80.0, dimension=CHARGE, high=100),
        **_both_ways("link", _one_of("bytes pass", "ok", "cut")),
        **_both_ways("frame_loss", Condition("probability that a frame is lost", 0.0, high=1)),
        **_both_ways("bit_errors", Condition("probability that a bit is wrong", 0.0, high=1)),
        **_both_ways("delay", _DELAY),
        "board_1": _one_of("power", "on", "off"),
        "board_2": _one_of("power", "on", "off"),
        "supervisor_1": _one_of("is executed; the other tasks of the board are anyway", "running", "stopped"),
        "supervisor_2": _one_of("is executed; the other tasks of the board are anyway", "running", "stopped"),
        "temperature_sensor": _one_of("gives valid readings", "ok", "silent"),
        "battery_sensor": _one_of("gives valid readings", "ok", "silent"),
        "imu": _one_of("gives valid readings", "ok", "silent"),
        "joystick": _one_of("complete reads arrive", "ok", "silent"),
        "sonars": _one_of("the scans are made", "ok", "silent"),
        **{f"encoder_{w}": _one_of("dead: reads 0 rpm", "ok", "dead", "frozen") for w in WHEELS},
        **{f"wheel_{w}": _one_of("turns as its motor drives it", "ok", "blocked") for w in WHEELS},
        "grip": Condition("part of the wheels' rotation that turns the rover", 1.0, high=1),
    }
)
"""By name, with what each is when a scenario says nothing."""

BOTH: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {name: tuple(_both_ways(name, _DELAY)) for name in ("link", "frame_loss", "bit_errors", "delay")}
)
"""Short names for the same condition in both directions."""
