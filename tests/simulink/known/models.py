"""What a known chart is: its text, what it may be given, and a simulation of it by hand."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from rovercheck.spec_model.lang.domain import Domain
from tests.simulink.known.packages import ChartText

Row = Mapping[str, float]
Simulation = Callable[[Iterable[Row]], Iterator[tuple[float, ...]]]


@dataclass(frozen=True)
class Known:
    """A chart, the values of its inputs, and what its outputs are by the published semantics."""

    chart: ChartText
    given: Mapping[str, Sequence[float]]
    simulate: Simulation
    rows: int = 150
    domains: Mapping[str, Domain] = field(default_factory=dict)


__all__ = ["Known", "Row", "Simulation"]
