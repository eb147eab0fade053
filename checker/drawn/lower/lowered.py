"""A model as a system, or the data that keep it from being one."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from rovercheck.checker.drawn.lower.symbols import NotLowered
from rovercheck.checker.drawn.lower.view import ChartView
from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.system import System


@dataclass(frozen=True)
class LoweredModel:
    """A model as a system.

    ``inputs`` and ``outputs`` are formulas by their flat names, as ``probe.level``; ``data`` those of charts,
    as ``Oven.left``; ``views`` the charts as they are drawn, by the name of the chart in the system.
    """

    model: DrawnModel
    system: System
    inputs: Mapping[str, Expr]
    outputs: Mapping[str, Expr]
    data: Mapping[str, Expr]
    views: Mapping[str, ChartView]
    notes: Sequence[str] = ()
    taken: frozenset[str] = frozenset()
    """The names of all data that a domain may be given to, beside inputs."""
    real: bool = False
    """Whether it computes with real numbers, which are exact fractions here."""
    free: Mapping[str, str] = field(default_factory=dict)
    """The inputs for values that are free, each with the name of what it is a value of."""


class RangeNotKnown(NotLowered):
    """The values of some data do not follow from the file: a person must give their domains."""

    def __init__(self, said: str, names: Sequence[str]) -> None:
        shown = ", ".join(names[:5]) + (f" and {len(names) - 5} more" if len(names) > 5 else "")
        super().__init__(
            f"{said.format(shown)}. `rovercheck import MODEL.slx --propose-domains` writes a file to fill in"
        )
        self.names = tuple(names)


__all__ = ["LoweredModel", "RangeNotKnown"]
