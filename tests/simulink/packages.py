"""All packages of the tests that have a simulation by hand, by their names."""

from collections.abc import Callable, Mapping
from pathlib import Path

from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.checker.simulink.model import read_model
from tests.simulink.by_hand.beside import BESIDE
from tests.simulink.by_hand.calls import CALLS
from tests.simulink.by_hand.diagrams import DIAGRAMS
from tests.simulink.by_hand.labels import LABELS
from tests.simulink.by_hand.machines import MACHINES as MOORE_AND_MEALY
from tests.simulink.by_hand.models import ByHand
from tests.simulink.by_hand.numbers import NUMBERS
from tests.simulink.by_hand.resets import RESETS
from tests.simulink.by_hand.states import STATES
from tests.simulink.by_hand.stores import STORES
from tests.simulink.by_hand.times import TIMES
from tests.simulink.by_hand.transitions import TRANSITIONS
from tests.simulink.by_hand.values import VALUES
from tests.simulink.known.appliances import APPLIANCES
from tests.simulink.known.controls import CONTROLS
from tests.simulink.known.events import EVENTS
from tests.simulink.known.machines import MACHINES
from tests.simulink.known.models import Known
from tests.simulink.known.semantics import SEMANTICS
from tests.simulink.known.supervisors import SUPERVISORS
from tests.simulink.samples import SAMPLES, package_of

MODELS: tuple[ByHand, ...] = (
    *STATES, *TRANSITIONS, *TIMES, *NUMBERS, *VALUES, *LABELS, *CALLS, *DIAGRAMS, *BESIDE, *STORES,
    *MOORE_AND_MEALY, *RESETS,
)  # fmt: skip
"""Models of the writer of this project, and of XML by hand."""
CHARTS: tuple[Known, ...] = (*SEMANTICS, *EVENTS, *MACHINES, *SUPERVISORS, *APPLIANCES, *CONTROLS)
"""Charts that papers and manuals on Stateflow made known."""
PACKAGES: Mapping[str, Callable[[Path], DrawnModel]] = {
    **{name: lambda _, name=name: read_model(package_of(name)) for name in SAMPLES},  # type: ignore[misc]
    **{one.name: one.read for one in MODELS},
    **{one.chart.name: one.chart.read for one in CHARTS},
}
"""How each is read, from a folder in which it may be written."""

__all__ = ["CHARTS", "MODELS", "PACKAGES"]
