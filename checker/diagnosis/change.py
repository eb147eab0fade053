"""A change of a chart as a hypothesis: what it is, where, from what to what, and how near to the charts."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from rovercheck.spec_model.abstraction.readings import StampReading
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System

ChangeKind = Literal[
    "interpretation", "repair", "limit", "constant", "comparison", "timer", "bit", "member", "value",
    "target", "order", "joined", "negated", "dropped", "missing", "always", "never", "operands", "signal",
    "exchanged", "initial", "late", "stale", "held", "frozen", "unread", "shared", "stamp", "enabled",
    "dead", "extra", "entry", "rounded", "single-precision",
]  # fmt: skip

KINDS: dict[str, str] = {
    "interpretation": "another interpretation",
    "repair": "a proposed repair",
    "limit": "another limit",
    "constant": "another constant",
    "rounded": "in fewer digits",
    "single-precision": "times in single precision",
    "comparison": "another comparison",
    "timer": "another time",
    "bit": "another bit",
    "member": "another member",
    "value": "another value",
    "target": "another target",
    "entry": "tested on entry",
    "order": "another order",
    "joined": "joined otherwise",
    "negated": "negated",
    "dropped": "a part of a condition is missing",
    "missing": "an action is missing",
    "always": "a condition is always true",
    "never": "a transition is missing",
    "operands": "operands exchanged",
    "signal": "another signal in one place",
    "exchanged": "two signals exchanged",
    "initial": "another initial value",
    "late": "a step late",
    "stale": "an input of the step before",
    "held": "a value held",
    "frozen": "an input read once",
    "unread": "an input that is not read",
    "shared": "shared memory",
    "stamp": "a time stamp taken otherwise",
    "enabled": "executed also when not enabled",
    "dead": "never executed",
    "extra": "an extra transition",
}
"""The kinds of changes, in words; the nearest first."""

TIERS: dict[str, float] = {
    "single-precision": -0.5, "interpretation": 0, "initial": 0.9, "repair": 1, "comparison": 2, "limit": 2,
    "timer": 2, "constant": 3, "joined": 3.1, "never": 3.15, "dropped": 3.2, "order": 3.2, "rounded": 3.5,
    "target": 3.3, "entry": 3.3, "missing": 3.4, "always": 3.6, "negated": 3.7, "exchanged": 4, "late": 4,
    "stale": 4, "shared": 5, "signal": 5.2, "stamp": 5, "held": 6, "unread": 6, "enabled": 6, "frozen": 7,
    "dead": 7, "extra": 8,
}  # fmt: skip
"""How near a kind of change lies to the charts; 3 where nothing is said.

Single precision makes only rows otherwise in which a formula meets its limit, each to one side or the other.
Where it explains all of them, a limit that is open instead of closed does so because they are few.
"""

NUMBERS_BEGIN = 2.5
"""How near another initial value of a number lies, of which there are many: a limit comes before it."""

Nearness = tuple[float, ...]

_SITE = re.compile(r"(arrow|default)(?:/(.+?))?\.(\d+)|state/(.+)/(entry|during|exit)|block")


def place_text(at: str) -> str:
    """Where a change is, for people: ``arrow/A.2 guard`` is ``in the guard of transition 2 from A``.

    Of several places at one site ``block#2`` is the second.  Sites that are written otherwise stay as they
    are.
    """
    at, _, number = at.partition("#")
    if number:
        return f"{place_text(at)} (place {number})"
    if at.startswith(("signal/", "stamp/")):
        return f"of {at.partition('/')[2]}"
    site, _, role = at.partition(" ")
    found = _SITE.fullmatch(site)
    if site == "everywhere" and role:
        return f"wherever {role} is assigned"
    if at == "everywhere" or found is None:
        return at
    kind, of, number, state, moment = found.groups()
    what = "guard" if role == "guard" else f"value of {role}" if role not in ("", "if") else "actions"
    if kind == "default":
        return f"in the {what} of default transition {number}{f' of {of}' if of else ''}"
    if kind == "arrow":
        return f"in the {what} of transition {number} from {of}"
    return f"in the {what} on {moment} of {state}" if state else f"in the {what}"


@dataclass(frozen=True, eq=False)
class ChartChange:
    """One change of one chart or block, or of how a stamp is taken that it reads.

    ``at`` is where, as ids of mutants say it; ``old`` and ``new`` are what stands there as drawn and as
    changed.  ``make`` makes the changed system.  ``reading``: how a stamp is taken otherwise, with a system
    that is as it was; ``inputs``: those of its inputs that are made of the stamp.
    """

    kind: ChangeKind
    chart: str
    at: str
    old: str
    new: str
    text: str
    make: Callable[[], System]
    distance: float = 0.0
    """Among changes of one kind: how far from what is drawn."""
    note: str = ""
    """What else would do."""
    reading: StampReading | None = None
    inputs: tuple[str, ...] = ()
    tier: float | None = None
    """How near it lies, where that is not as of its kind."""
    span: tuple[Fraction, Fraction] | None = None
    """Of a limit: between which numbers, in its unit, any other one explains as much."""

    @property
    def key(self) -> tuple[str, ...]:
        return (self.kind, self.chart, self.at, self.old, self.new)

    @property
    def told(self) -> tuple[str, ...]:
        """The change, and what else would do."""
        return (*self.key, self.note)

    @property
    def nearness(self) -> Nearness:
        """The nearer of two changes that explain as much comes first."""
        return (TIERS.get(self.kind, 3) if self.tier is None else self.tier, self.distance)


def only_told() -> System:
    """In place of what makes a change that was found elsewhere.  Raises ``ModelError``."""
    raise ModelError("A change that was found is made anew from its key, as one of a variant.")


__all__ = [
    "KINDS",
    "NUMBERS_BEGIN",
    "TIERS",
    "ChangeKind",
    "ChartChange",
    "Nearness",
    "only_told",
    "place_text",
]
