"""A lamp with two lights, of which the properties and their verdicts are known; nothing else is looked at."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from rovercheck.checker.engines import Engine, Limits
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import StoredRun, Unknown
from rovercheck.checker.store.verdicts import VerdictStore
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.searches import NO_LIMITS, SearchSettings, events
from rovercheck.properties.forms import Property, always, never, reachable, responds
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block, Chart, State, to
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import Expr, flag, var
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import minimum
from tests.store.naive_engine import NaiveEngine

GO, PUSH, COUNT, BEAM = flag("go"), flag("push"), var("count", integer(0, 3)), flag("beam")
ON = "lamp"


def lamp(guard: Expr = GO, least: int = 2) -> System:
    """A lamp that is lit by ``guard``, and a beam after some ticks with a push beside it."""
    chart = Chart(
        "Lamp",
        [State("Off", transitions=[to("On", when=guard)]), State("On", transitions=[to("Off", when=~guard)])],
        default="Off",
    )
    counting = Block(
        "Counting", [assign(COUNT, minimum(COUNT + 1, 3)), assign(BEAM, PUSH & (COUNT >= least))]
    )
    return in_order(ON, chart, counting)


LIT = lamp().charts[0].active("On")
PROPERTIES = (
    never("lit-violated", "", that=LIT, covers=["R"], on=ON),
    reachable("lit-proved", "", that=LIT, covers=["R"], on=ON),
    always("lit-go-violated", "", that=LIT | ~GO, covers=["R"], on=ON),
    never("beam-violated", "", that=BEAM, covers=["R"], on=ON),
    always("count-proved", "", that=COUNT <= 3, covers=["R"], on=ON),
    reachable("beam-never-violated", "", that=BEAM & (COUNT == 0), covers=["R"], on=ON),
    responds("slow-violated", "", trigger=PUSH, response=BEAM, within=1 * ticks, covers=["R"], on=ON),
)
"""Each is named as it is decided of the lamp as it is."""

Told = dict[str, tuple[str, int | None]]


def store(recheck: bool = False) -> VerdictStore:
    return VerdictStore("naive", recheck)


def decided(
    system: System | Mapping[str, System],
    kept: VerdictStore | None = None,
    properties: Sequence[Property] = PROPERTIES,
    *,
    engine: Engine | str | None = None,
    traces: bool = False,
    limits: Limits = NO_LIMITS,
) -> list[Result]:
    """The results of a check of the lamp."""
    systems = {ON: system} if isinstance(system, System) else system
    settings = SearchSettings(engine or NaiveEngine(), limits, 1, store=kept, traces=traces)
    return [one for one in events(properties, systems, settings) if isinstance(one, Result)]


def told(results: Sequence[Result]) -> Told:
    """The verdict of each property, and the length of its run."""
    return {one.property.id: (one.verdict.word, length(one)) for one in results}


def length(one: Result) -> int | None:
    because = None if isinstance(one.verdict, Unknown) else one.verdict.because
    return len(because) if isinstance(because, Trace | StoredRun) else None


def of(id: str) -> Property:
    return next(p for p in PROPERTIES if p.id == id)


def other_name(system: System, name: str) -> System:
    return replace(system, name=name)
