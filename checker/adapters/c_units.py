"""Units in which firmware holds what the charts have in another one."""

from collections.abc import Mapping
from math import pi

LINEAR: tuple[Mapping[str, float], ...] = (
    {"us": 1e-6, "µs": 1e-6, "ms": 1e-3, "s": 1.0, "min": 60.0, "h": 3600.0},
    {"mm": 1e-3, "cm": 1e-2, "m": 1.0},
    {"%": 1e-2, "‰": 1e-3, "permille": 1e-3, "ratio": 1.0},
    {"°": 1.0, "deg": 1.0, "mrad": 0.18 / pi, "rad": 180.0 / pi},
    {"°/s": 1.0, "deg/s": 1.0, "mrad/s": 0.18 / pi, "rad/s": 180.0 / pi},
    {"rpm": 1.0, "1/min": 1.0, "rps": 60.0},
    {"mV": 1e-3, "V": 1.0},
    {"mA": 1e-3, "A": 1.0},
)
"""Units of one kind, each with how much of the kind's own it is."""
TEMPERATURES: Mapping[str, tuple[float, float]] = {
    "°C": (1.0, 0.0),
    "degC": (1.0, 0.0),
    "K": (1.0, -273.15),
    "°F": (5 / 9, -160 / 9),
}
"""Degrees Celsius of one, and of 0."""


def conversion(held: str, wanted: str) -> tuple[float, float] | None:
    """How many ``wanted`` one ``held`` is, and how many 0 of it is; None where there is no such thing."""
    if held == wanted:
        return 1.0, 0.0
    if held in TEMPERATURES and wanted == "°C":
        return TEMPERATURES[held]
    for kind in LINEAR:
        if held in kind and wanted in kind:
            return _rounded(kind[held] / kind[wanted]), 0.0
    return None


def known_units(wanted: str) -> list[str]:
    """The units that become this one."""
    kinds = (*LINEAR, *([TEMPERATURES] if wanted == "°C" else []))
    return [unit for kind in kinds if wanted in kind for unit in kind]


def _rounded(factor: float) -> float:
    """1e-3 / 1e-2 as 0.1: a power of ten that two rounded ones make."""
    return float(f"{factor:.12g}") if abs(factor - float(f"{factor:.12g}")) < 1e-12 * factor else factor
