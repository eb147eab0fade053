"""Entries that are forged, by who has the secret too: --recheck finds every wrong one; a trace shows none."""

from dataclasses import replace
from pathlib import Path

import pytest

from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import (
    Exhausted,
    Proved,
    Run,
    StoredInvariant,
    StoredRun,
    Unknown,
    Verdict,
    Violated,
)
from rovercheck.checker.store.verdict_json import Definite
from rovercheck.checker.store.verdicts import VerdictStore
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.stored import StoreContradiction
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.system import System
from tests.store.lamps import ON, PROPERTIES, PUSH, decided, lamp, length, of, store, told
from tests.store.naive_engine import NaiveEngine

pytestmark = pytest.mark.usefixtures("folder", "no_child")

TRUTH = {
    "lit-violated": ("violated", 2),
    "lit-proved": ("proved", 2),
    "lit-go-violated": ("violated", 1),
    "beam-violated": ("violated", 2),
    "count-proved": ("proved", None),
    "beam-never-violated": ("violated", None),
    "slow-violated": ("violated", 2),
}
PROOF = Exhausted(7, 20, 3, ("count",))


def run(ticks: int, **values: int) -> StoredRun:
    """A run in which the inputs are the same in every tick."""
    return StoredRun(Run({}, ({"go": 0, "push": 0} | values,) * ticks), ticks * 20, shortest=True)


def forge(
    prop: Property, verdict: Verdict, system: System, at: str = "question", about: str = ON
) -> VerdictStore:
    """Keep a verdict that was not found, under the name of a question or of a slice."""
    kept, systems = store(), {ON: system}
    name = kept.question(prop, systems) if at == "question" else kept.slice(prop, systems)
    assert name is not None
    kept.write(name, verdict, about, (prop.id,))
    return kept


def test_the_lamp_is_decided_as_this_file_says() -> None:
    assert told(decided(lamp())) == TRUTH


FORGED: dict[str, tuple[str, Definite]] = {
    "a proof of what is violated": ("lit-violated", Proved(PROOF, "naive")),
    "an invariant of what is violated": ("beam-violated", Proved(StoredInvariant(3), "pdr")),
    "a violation of what is proved": ("count-proved", Violated(run(1), "naive")),
    "never reached what is reached": ("lit-proved", Violated(PROOF, "naive")),
    "reached what is never reached": ("beam-never-violated", Proved(run(2, push=1), "naive")),
    "a run that does not show it": ("lit-violated", Violated(run(4), "naive")),
    "no run at all": ("lit-violated", Violated(StoredRun(Run({}, ()), 0), "naive")),
    "a run whose end is before its last tick": ("slow-violated", Violated(run(4), "naive")),
    "a run of another system": (
        "lit-violated",
        Violated(StoredRun(Run({"strange": 1}, ({"other": 1},) * 3), 60), "naive"),
    ),
    "a run with values that there are not": ("lit-violated", Violated(run(2, go=7), "naive")),
    "a run with huge values": ("lit-violated", Violated(run(2, go=10**300), "naive")),
    "a run without end of a bounded property": (
        "lit-violated",
        Violated(replace(run(2, go=1), loop=1), "naive"),
    ),
    "a proof that rests on a run": ("count-proved", Proved(run(2), "naive")),
    "a violation that rests on a proof": ("lit-violated", Violated(PROOF, "naive")),
}


@pytest.mark.parametrize("at", ["question", "slice"])
@pytest.mark.parametrize("what", FORGED)
def test_recheck_finds_whatever_is_wrong(what: str, at: str) -> None:
    id, verdict = FORGED[what]
    forge(of(id), verdict, lamp(), at)
    try:
        found = decided(lamp(), store(recheck=True))
    except StoreContradiction as wrong:
        assert id in str(wrong) and "--no-store" in str(wrong)
        assert verdict.word != TRUTH[id][0]
        return
    assert told(found) == TRUTH
    assert told(decided(lamp(), store())) == TRUTH, "and it is kept right from then on"


@pytest.mark.parametrize("at", ["question", "slice"])
@pytest.mark.parametrize("what", FORGED)
def test_a_trace_never_shows_a_run_that_does_not_replay(what: str, at: str) -> None:
    """A plain proof that is forged is believed: who has the secret may as well change the code."""
    id, verdict = FORGED[what]
    forge(of(id), verdict, lamp(), at)
    [found] = decided(lamp(), store(), [of(id)], traces=True)
    if isinstance(found.verdict, Unknown) or not isinstance(found.verdict.because, Trace):
        assert not isinstance(found.verdict, Unknown) and not isinstance(found.verdict.because, StoredRun)
        return
    assert (found.verdict.word, length(found)) == TRUTH[id]
    assert all(set(tick.inputs) == {"go", "push"} for tick in found.verdict.because.ticks)


@pytest.mark.parametrize("what", [name for name in FORGED if "rests on" in name])
def test_what_cannot_rest_on_that_is_not_believed(what: str) -> None:
    id, verdict = FORGED[what]
    forge(of(id), verdict, lamp())
    assert told(decided(lamp(), store(), [of(id)]))[id] == TRUTH[id]


def test_what_is_kept_of_the_same_question_is_told_as_it_is_kept() -> None:
    """The trust that docs/ci.md speaks of: the seal is all that a plain check looks at."""
    forge(of("lit-violated"), Proved(PROOF, "naive"), lamp())
    assert told(decided(lamp(), store(), [of("lit-violated")])) == {"lit-violated": ("proved", None)}


def test_a_longer_run_than_necessary_replays_and_is_told_with_its_length() -> None:
    """That none is shorter is shown by the search alone, and not again."""
    long = StoredRun(Run({}, ({"go": 0, "push": 0},) * 3 + ({"go": 1, "push": 0},)), 80, shortest=False)
    forge(of("lit-violated"), Violated(long, "naive"), lamp())
    for recheck in (False, True):
        assert told(decided(lamp(), store(recheck), [of("lit-violated")])) == {
            "lit-violated": ("violated", 4)
        }


@pytest.mark.parametrize("recheck", [False, True])
def test_a_verdict_about_another_system_is_none(recheck: bool) -> None:
    for about in ("nowhere", "", "Lamp"):
        forge(of("lit-violated"), Violated(run(2, go=1), "naive"), lamp(), about=about)
        [found] = decided(lamp(), store(recheck), [of("lit-violated")])
        assert (found.system, found.verdict.word, length(found)) == (ON, "violated", 2)


def test_a_wrong_certificate_shows_nothing() -> None:
    """A proof with the certificate of another one is decided anew."""
    kept, system = store(), lamp()
    before = decided(system, kept)
    files = Path(_folder()).glob("*.o")
    assert told(before) == TRUTH and list(files)
    name = kept.about("proof", system, of("beam-violated"))
    for certificates in (b"", b"{}", b"\xff" * 100, b"[" * 100_000):
        forge(of("beam-violated"), Proved(PROOF, "naive"), system)
        kept.write_proof(name, certificates)
        with pytest.raises(StoreContradiction):
            decided(system, store(recheck=True), [of("beam-violated")])


def _folder() -> str:
    from rovercheck.checker.cache.places import chosen

    return str(chosen())


def test_a_run_still_shows_it_where_what_lies_beside_has_changed() -> None:
    """An input more, one less, one with fewer values: the slice is the same, and so is the verdict."""
    kept, engine = store(), NaiveEngine()
    one, asked = lamp(), [of("lit-violated"), of("lit-proved")]
    assert told(decided(one, kept, asked)) == {p.id: TRUTH[p.id] for p in asked}
    from rovercheck.spec_model.lang.action import assign
    from rovercheck.spec_model.lang.chart import Block
    from rovercheck.spec_model.lang.domain import integer
    from rovercheck.spec_model.lang.expr import flag, var

    dial = var("dial", integer(5, 6), 5)
    more = replace(one, components=(*one.components, Block("More", [assign(flag("high"), dial == 6)])))
    less = replace(one, components=one.components[:1])
    pushed = replace(one, frozen=(PUSH,))
    for edited in (more, less, pushed):
        found = decided(edited, kept, asked, engine=engine, traces=True)
        assert told(found) == {p.id: TRUTH[p.id] for p in asked}
        for result in found:
            assert isinstance(result.verdict, Proved | Violated) and isinstance(result.verdict.because, Trace)
            assert all({*tick.inputs} == {*edited.inputs} for tick in result.verdict.because.ticks)
    assert not engine.asked


def test_every_property_is_forged_in_turn() -> None:
    opposite: dict[str, Definite] = {}
    for prop in PROPERTIES:
        word, ticks = TRUTH[prop.id]
        because = PROOF if ticks is not None else run(2, push=1, go=1)
        opposite[prop.id] = Violated(because, "x") if word == "proved" else Proved(because, "x")
    for id, verdict in opposite.items():
        forge(of(id), verdict, lamp())
        try:
            found: list[Result] = decided(lamp(), store(recheck=True))
        except StoreContradiction as wrong:
            assert id in str(wrong)
            store().remove(store().question(of(id), {ON: lamp()}))
            continue
        assert told(found)[id] == TRUTH[id]
