"""Models written for tests: the one that ``init`` writes, and variations of it."""

from pathlib import Path

from rovercheck.checker import model

START = Path(str(model.__file__)).parent / "start"
HEATER = (START / "heater.py").read_text(encoding="utf-8")
BASELINE = (START / "baseline.toml").read_text(encoding="utf-8")
FIRMWARE = """
class Heater:
    limit, rest = 22, 250

    def __init__(self):
        self.state, self.steps = None, 0

    def step(self, given):
        warm, door = given["temperature"], given["door_open"]
        self.steps += 1
        if self.state is None:
            self.turn("Off")
        elif self.state == "Off" and warm < 18 and not door:
            self.turn("On")
        elif self.state == "On" and (door or warm > self.limit):
            self.turn("Off")
        elif self.state == "On" and self.steps >= 500:
            self.turn("Pause")
        elif self.state == "Pause" and self.steps >= self.rest:
            self.turn("Off")
        return {"heating": self.state == "On", "Heater": ["", "Off", "On", "Pause"].index(self.state)}

    def turn(self, state):
        self.state, self.steps = state, 0


class Hot(Heater):
    limit = 25


class Brief(Heater):
    rest = 249


class HotAndBrief(Heater):
    limit, rest = 25, 249
"""
"""A firmware of the heater that does what its chart does, and three that do not."""

CRITICAL_AT_59_5 = """
[[change]]
kind = "limit"
chart = "Monitor_temperature"
at = "everywhere"
from = "temperature_degC >= 60"
to = "temperature_degC >= 59.5"
"""
"""A change of the rover's charts, as a variant holds it: a limit between two values of its domain."""


def heater_files(folder: Path, firmware: str = FIRMWARE) -> Path:
    """The folder, with the heater's model, its baseline, and firmwares of it."""
    for name, text in (("heater.py", HEATER), ("baseline.toml", BASELINE), ("firmware.py", firmware)):
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def but(old: str, new: str) -> str:
    """The heater with another text in one place."""
    assert HEATER.count(old) >= 1, old
    return HEATER.replace(old, new, 1)


def line_of(words: str, text: str) -> int:
    """The line of a text, from 1, in which words stand first."""
    return next(n for n, line in enumerate(text.splitlines(), 1) if words in line)
