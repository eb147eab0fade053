"""Numbers with their units, as a scenario writes them: ``"2.5 s"``, ``"25 °C"``, ``"60 cm"``."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from rovercheck.supervisor.bench.errors import ScenarioError, quoted

_QUANTITY = re.compile(r"([+-]?\d{1,12}(?:\.\d{1,12})?)\s*([^\s\d.]\S*)")


@dataclass(frozen=True)
class Dimension:
    """A kind of quantity: its units by name, each as a multiple of the one in which the bench computes."""

    name: str
    units: Mapping[str, Fraction]
    example: str

    def parse(self, path: str, text: object) -> Fraction:
        """The number of base units that ``text`` stands for; ScenarioError for anything else."""
        found = _QUANTITY.fullmatch(text.strip()) if isinstance(text, str) else None
        if found is None:
            raise ScenarioError(
                path, f"{quoted(text)} is no {self.name}; write a number and its unit, {self._as}."
            )
        number, unit = found.groups()
        if unit not in self.units:
            known = ", ".join(self.units)
            raise ScenarioError(
                path, f"{quoted(unit)} is no unit of a {self.name}; write {known}, {self._as}."
            )
        return Fraction(number) * self.units[unit]

    @property
    def _as(self) -> str:
        return f'as in "{self.example}"'


TIME = Dimension("time", {"us": Fraction(1), "ms": Fraction(1000), "s": Fraction(10**6)}, "2.5 s")
"""In microseconds."""
TEMPERATURE = Dimension("temperature", {"°C": Fraction(1), "degC": Fraction(1)}, "25 °C")
CHARGE = Dimension("charge", {"%": Fraction(1)}, "80 %")
DISTANCE = Dimension("distance", {"cm": Fraction(1), "m": Fraction(100)}, "60 cm")
DRIFT = Dimension("drift of a clock", {"ppm": Fraction(1)}, "50 ppm")


def time_us(path: str, text: object) -> int:
    """A time of the scenario in whole microseconds, 0 or later."""
    microseconds = TIME.parse(path, text)
    if microseconds < 0 or microseconds.denominator != 1:
        raise ScenarioError(path, f"{quoted(text)} is no time of a run; write whole microseconds, 0 or more.")
    return int(microseconds)


def shown(time: int) -> str:
    """A time in microseconds as a person writes it: ``2.5 s``, ``20 ms``."""
    if time >= 10**6:
        return f"{time / 10**6:.6f}".rstrip("0").rstrip(".") + " s"
    return f"{time / 1000:.3f}".rstrip("0").rstrip(".") + " ms"
