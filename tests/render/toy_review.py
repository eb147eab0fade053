"""A small review with everything a page can show, and texts that try to break out of it."""

from dataclasses import replace
from typing import Any

from rovercheck.checker.explore.graphs.construction import made
from rovercheck.checker.render.review.graphs import graph_view
from rovercheck.checker.render.review.model import (
    Covered,
    Edit,
    InterpretationRow,
    Remedy,
    RequirementRow,
    Review,
    ReviewAssumption,
    ReviewedProperty,
    ReviewOrigin,
    SystemSummary,
)
from tests import toys
from tests.render.zoo import CHARTS, long_trace
from tests.traces import changed

EVIL = "</script><script>document.title='broken into'</script><img src=x onerror=alert(1)> & \"'"

RUN = changed(
    long_trace(),
    id="T-1",
    charts=frozenset({"Relay"}),
    relevant=frozenset(long_trace().system.variables),
    statecharts={"Relay": CHARTS["Relay"]},
)


def checked(id: str, verdict: str, **more: Any) -> ReviewedProperty:
    """A property with a verdict; ``more`` are further fields."""
    base = ReviewedProperty(
        id, f"The text of {id}.", "relay", verdict, "toy", "bmc", f"evidence of {id}", "Always"
    )
    return replace(base, **{"english": ("In every step x.",), "formula": (("that", "x <= 1"),), **more})


BROKEN = checked(
    "T-1", "violated", trace=RUN, because=f"Because of <b>this</b> {EVIL}", requirements=("R-1",),
    interpretations=("S1",), cause="T-1", record="violated",
)  # fmt: skip
SAME = checked("T-2", "violated", trace=RUN, because="As T-1.", cause="T-1", no_repair="There is none.")
CHANGED = checked("T-3", "proved", as_expected=False, record="violated after 3 ticks")
OPEN = checked("T-4", "unknown", area="link", system="other system")
FINE = checked(
    "T-5", "proved", requirements=("R-1", "R-2"), certificate="accepted: 4 obligations", certified=True,
    premise="occurs after 3 ticks",
)  # fmt: skip
PART = checked(f"T-6 {EVIL}", "proved", in_part=True, text=EVIL, formula=(("that", EVIL),), english=(EVIL,))
WITNESS = checked("T-7", "proved", trace=RUN, form="Reachable")

GRAPH = made(toys.relay(), ("on",), wanted=("on",), looked_for="T-1 is broken").with_ways()
SEEN = graph_view("toy", GRAPH, {"T-1": (0, 0, 1), EVIL: (0,)}, ("T-1",), "rovercheck graph toy", ("T-2",))

ALL = (BROKEN, SAME, CHANGED, FINE, PART, WITNESS, OPEN)


def review(properties: tuple[ReviewedProperty, ...] = ALL) -> Review:
    """The review."""
    return Review(
        title=f"Toys {EVIL}",
        subject=EVIL,
        properties=properties,
        origin=ReviewOrigin("rovercheck report", 1, "changed", (("Python", "3"),), (("toy", "ab12" * 16),)),
        systems={
            "toy": SystemSummary(
            "toy", EVIL, 20, ("Relay",), (EVIL,), ("A1",), over=True, concrete="other system"
        ),
            "other system": SystemSummary("other system", "Another.", 1),
        },
        charts={"Relay": CHARTS["Relay"], "Nested": CHARTS["Nested"]},
        demands=(
            RequirementRow("R-0", EVIL, "§1", "reason", f"by construction {EVIL}", covered=False),
            RequirementRow("R-1", "First.", "§2", "violated", "", ("T-1", "T-5")),
            RequirementRow("R-2", "Second.", "§3", "proved", "", ("T-5", "T-away")),
        ),

        interpretations=(
            InterpretationRow("S1", "Relays", EVIL, "OR", (("OR", "either"), ("AND", EVIL)), EVIL, EVIL),
        ),
        assumptions=(ReviewAssumption("A1", EVIL, ("toy",)),),
        repairs=(
            Remedy("mend", EVIL, (Edit("Relay", "transitions", ("[a < b]",), (EVIL,)),),
                   (("T-1", "proved", "bdd: all 4 reachable states"),), (("T-5", EVIL),),
                   "check --repair mend"),
        ),
        coverage=(Covered("board", "transitions", 10, 8, 1, 1),),
        graphs=(SEEN,),
        undrawn=(("other system", EVIL),),
        how_to_read="A step is one tick.",
        left_out=(("T-away", "only with --full"),),
    )  # fmt: skip
