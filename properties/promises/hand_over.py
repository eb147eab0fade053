"""Who drives: from frames and heartbeats that stay away to the board whose commands reach the motors."""

from collections.abc import Sequence

from rovercheck.properties.forms import Property, always, costly, holds_after
from rovercheck.properties.promises.driving import unheard
from rovercheck.spec_model.composition.motors import connected, followed, runs_1
from rovercheck.spec_model.composition.weather import OTHER, SPELLS, for_a_step
from rovercheck.spec_model.lang.expr import Expr, implies
from rovercheck.spec_model.lang.time import Span, ms, ticks

SWITCHED = costly(always(
    "P-RELAY-SWITCHED",
    "In every step of Board 1 with a last frame or heartbeat of Board 2 over 120 ms old, the motors are "
    "connected to Board 2, whatever happens.",
    that=implies(unheard & runs_1, connected == "Board2"),
    covers=["B1-REL-02", "B1-RX-03", "B1-SUP-03"], on="rover_ms", from_tick=2, interpretations=["S43", "S37"],
))  # fmt: skip
SWITCHED_BACK = costly(holds_after(
    "P-RELAY-SWITCHED-BACK",
    "After 3.02 s of Board 1 in which frames and heartbeats came within 120 ms, the motors are connected to "
    "Board 1, whatever happens.",
    premise=~unheard & runs_1, for_=151 * ticks, then=connected == "Board1",
    covers=["B1-REL-04"], on="rover_ms", from_tick=2, interpretations=["S44", "S45"],
))  # fmt: skip


def _drives(
    id: str, what: str, when: Expr, after: Span, who: str, on: str, covers: Sequence[str]
) -> Property:
    drives = "nobody drives" if who == "nobody" else f"Board {who[-1]} drives"
    return holds_after(
        f"P-RELAY-{id}", f"With {what} for {after}, {drives}.",
        premise=when, for_=after, then=followed == who, covers=covers, on=on, from_tick=2,
    )  # fmt: skip


def _there(fault: str) -> Expr:
    return SPELLS[fault] == "present"


LINK21 = _drives(
    "LINK21", "no frame for Board 1", _there("link21"), 240 * ms, "Board2", "weather_link21",
    ["B1-REL-02", "B1-RX-03", "B2-ACT-01"],
)  # fmt: skip
LINK12 = always(
    "P-RELAY-LINK12", "While no frame for Board 2 arrives, Board 1 drives.",
    that=implies(_there("link12"), followed == "Board1"),
    covers=["B1-REL-01", "B1-REL-03"], on="weather_link12", from_tick=2,
)  # fmt: skip
LINKS = costly(_drives(
    "LINKS", "no frame in either direction", _there("link12") & (OTHER == "present") & ~for_a_step,
    240 * ms, "Board2", "weather_link12_link21", ["B1-REL-02", "B2-ACT-01"],
))  # fmt: skip
SUPERVISOR2 = _drives(
    "SUPERVISOR2", "a supervisor of Board 2 that has stopped", _there("supervisor2"), 180 * ms, "nobody",
    "weather_supervisor2", ["B1-REL-02", "B1-SUP-03"],
)  # fmt: skip
POWER = _drives(
    "POWER", "a Board 1 without power", _there("power"), 240 * ms, "Board2", "weather_power",
    ["B1-REL-05", "B2-ACT-01"],
)  # fmt: skip
