"""Names of states, data and events in a machine of SCXML, whose formulas are ECMAScript."""

from collections import Counter

from rovercheck.checker.export.names import Identifiers, identifiers
from rovercheck.spec_model.lang.chart import Path
from rovercheck.spec_model.lang.domain import Enum
from rovercheck.spec_model.lang.system import System

TICK = "tick"
"""The event of a step."""
_WORDS = """
abstract arguments await boolean break byte case catch char class const continue debugger default delete do
double else enum eval export extends false final finally float for function goto if implements import in
instanceof int interface let long native new null package private protected public return short static super
switch synchronized this throw throws transient true try typeof undefined var void volatile while with yield
In Infinity Math NaN
"""
RESERVED = frozenset(_WORDS.split())
"""What no datum is called: words of ECMAScript, and what is used of it."""


class ScxmlNames:
    """Names of one machine.

    ``states`` has the ids by chart and path, those of charts for the empty path: names as they are drawn, and
    with what they lie in where several have one name.  ``whole`` is that of all components, ``order`` that of
    the region that executes them one after the other.
    """

    def __init__(self, system: System) -> None:
        places = [(chart.name, path) for chart in system.charts for path in chart.states]
        drawn = Counter((name, *path)[-1] for name, path in places)
        wanted = {
            (name, path): (name, *path)[-1] if drawn[(name, *path)[-1]] == 1 else ".".join((name, *path))
            for name, path in places
        }
        [self.machine] = identifiers([system.name]).values()
        self._ids = Identifiers()
        self.states: dict[tuple[str, Path], str] = {place: self._ids(name) for place, name in wanted.items()}
        self.whole, self.order = self._ids("components", self), self._ids("order of execution", self)
        self.data = Identifiers(RESERVED)
        self.events = Identifiers({TICK})
        self.constants: dict[str, int] = {}

    def beside(self, chart: str, path: Path, what: str) -> str:
        """The id of a further state that is not drawn, but belongs to one that is."""
        return self._ids(f"{self.states[chart, path]} {what}", object())

    def constant(self, enum: Enum, raw: int) -> str:
        """The name of a member of an enumeration, which becomes a datum that never changes."""
        member = enum.member(raw)
        name = self.data(member, enum, f"{enum.name}.{member}")
        self.constants[name] = raw
        return name


__all__ = ["RESERVED", "TICK", "ScxmlNames"]
