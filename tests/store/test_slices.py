"""What is kept of a slice is true wherever the slice is the same: of edited systems, against a naive loop."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rovercheck.checker.engines import Limits, quiet
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Open, Reached, StoredRun, Unknown
from rovercheck.checker.store import slices
from rovercheck.checker.store.verdicts import VerdictStore
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.searches import SearchSettings, events
from rovercheck.properties.forms import Property, always
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import FALSE, flag, ite, var
from rovercheck.spec_model.lang.system import System, in_order
from tests import naive
from tests.profiles import examples
from tests.store.naive_engine import NaiveEngine
from tests.store.small_systems import NAME, asked, edits, small_systems

pytestmark = pytest.mark.usefixtures("no_child")

CONCRETE = "Concrete"


class TooLarge(Exception):
    """More states than a test should look at."""


Told = tuple[str, int | None]
"""The word of a verdict, and the length of its run."""


def looped(prop: Property, systems: Mapping[str, System]) -> Told:
    """What a naive loop says of a property, without any part of the store."""
    system = systems[prop.on]
    whole = lowered(system)
    question = reduce(whole, [prop])
    goal = question.goals[0]
    starts = [{**question.system.init, **frozen} for frozen in naive.vectors(question.system.frozen)]
    if not any(True for at in starts for _ in naive.successors(question.system, at)):
        return "no run", None
    checks = [check for check, _ in question.system.checks]
    answers = NaiveEngine().check(question.system, [goal.var, *checks], Limits(), quiet)
    if any(isinstance(answers[check.name], Reached) for check in checks):
        return "leaves a domain", None
    if any(isinstance(answer, Open) for answer in answers.values()):
        raise TooLarge
    answer = answers[goal.var.name]
    length = len(answer.run) if isinstance(answer, Reached) else None
    if length is not None and system.over:
        if not system.concrete:
            return "unknown", None
        return (
            looped(replace(prop, on=system.concrete), systems) if _there(prop, systems) else ("unknown", None)
        )
    if length is None:
        return "violated" if goal.reach else "proved", None
    return "proved" if goal.reach else "violated", length


def _there(prop: Property, systems: Mapping[str, System]) -> bool:
    return looped(replace(prop, on=systems[prop.on].concrete), systems)[1] is not None


@dataclass
class Decided:
    """What was told of properties, or the error; ``searched`` are those that an engine was asked about, and
    ``shortest`` those of which it was told that no run is shorter."""

    told: dict[str, Told]
    error: str
    searched: int
    shortest: set[str] = field(default_factory=set)


def decided(
    props: Sequence[Property], systems: Mapping[str, System], store: VerdictStore | None, traces: bool = True
) -> Decided:
    engine = NaiveEngine()
    heard, error, shortest = dict[str, Told](), "", set[str]()
    try:
        for one in events(props, systems, SearchSettings(engine, Limits(), 1, store=store, traces=traces)):
            if isinstance(one, Result):
                heard[one.property.id] = _told(one)
                shortest |= {one.property.id} if _shortest(one) else set()
    except ModelError as wrong:
        error = str(wrong)
    return Decided(heard, error, len(engine.asked), shortest)


def _shortest(one: Result) -> bool:
    because = None if isinstance(one.verdict, Unknown) else one.verdict.because
    return isinstance(because, Trace | StoredRun) and because.shortest


def _told(one: Result) -> Told:
    because = None if isinstance(one.verdict, Unknown) else one.verdict.because
    return one.verdict.word, len(because) if isinstance(because, Trace | StoredRun) else None


def definite(found: Decided) -> dict[str, Told]:
    """Without what had too many states: a run of an edited system may decide it."""
    return {id: told for id, told in found.told.items() if told[0] != "unknown"}


def fresh() -> VerdictStore:
    return VerdictStore("naive")


seen: Counter[str] = Counter()


@pytest.fixture(autouse=True, scope="module", params=[False, True], ids=["whole", "without dead branches"])
def narrow(request: pytest.FixtureRequest) -> Iterator[None]:
    """Slices as they are, and of any system as they are of one in which little is chosen."""
    with pytest.MonkeyPatch.context() as patch:
        if request.param:
            patch.setattr(slices, "WIDE", -1)
            patch.setattr(slices, "driven", lambda system: True)
        yield


@settings(
    examples(120),
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
    deadline=None,
)
@given(st.data())
def test_where_slices_are_equal_so_are_the_verdicts_of_a_naive_loop(
    folder: Path, data: st.DataObject
) -> None:
    original = data.draw(small_systems())
    edited = data.draw(edits(original))
    try:
        props = asked(original)
        for system in (original, edited):
            lowered(system)
    except ModelError:
        return
    store = fresh()
    for prop in data.draw(st.lists(st.sampled_from(props), min_size=2, max_size=4, unique_by=lambda p: p.id)):
        one, two = ({NAME: system} for system in (original, edited))
        try:
            told = looped(prop, one), looped(prop, two)
        except (KeyError, ModelError, TooLarge):
            continue
        same = store.slice(prop, one) == store.slice(prop, two)
        seen["equal" if same else "unlike"] += 1
        if same and "no run" not in (told[0][0], told[1][0]):
            assert told[0] == told[1], f"{prop.id}: {told}"
        if store.question(prop, one) == store.question(prop, two):
            assert told[0] == told[1]


def test_both_equal_and_unlike_slices_were_seen() -> None:
    """The test before this one would show nothing if one of the two did not occur."""
    assert not seen or min(seen["equal"], seen["unlike"]) > 10, seen


@settings(
    examples(60),
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
    deadline=None,
)
@given(st.data())
def test_with_what_is_kept_of_the_original_an_edit_is_decided_as_without(
    folder: Path, data: st.DataObject
) -> None:
    original = data.draw(small_systems())
    edited = data.draw(edits(original))
    over = data.draw(st.booleans())
    try:
        props = data.draw(st.permutations(asked(original)))[: data.draw(st.integers(2, 4))]
        one, two = ({NAME: system} for system in (original, edited))
        if over:
            one = {NAME: loose(original), CONCRETE: replace(original, name=CONCRETE)}
            two = {NAME: loose(edited), CONCRETE: replace(edited, name=CONCRETE)}
        for system in (*one.values(), *two.values()):
            lowered(system)
            props = [p for p in props if {*asked_ids(system)} >= {p.id}]
    except ModelError:
        return
    if not props:
        return
    for entry in folder.glob("*.o"):
        entry.unlink()
    store = fresh()
    before = decided(props, one, store)
    plain, kept = decided(props, two, None), decided(props, two, store)
    assert (kept.error == "") == (plain.error == ""), (kept, plain)
    if not plain.error:
        assert_alike(kept, plain, props, two)
        again = decided(props, two, store, traces=data.draw(st.booleans()))
        if not again.error:  # a search for what is still unknown may find out that a domain is left
            assert definite(kept).items() <= again.told.items()
        if len(definite(kept)) == len(props):
            assert again.told == kept.told
            assert not again.searched, "what was decided is decided again"
        assert_alike(decided(props, two, replace(store, recheck=True)), plain, props, two)
    if not before.error:
        after = decided(props, one, store)
        assert after.error or definite(before).items() <= after.told.items(), "and the original is as it was"
    seen["decided"] += 1
    seen["reused"] += not plain.error and kept.searched < plain.searched


def assert_alike(
    kept: Decided, plain: Decided, props: Sequence[Property], systems: Mapping[str, System]
) -> None:
    """The verdicts are the same; an earlier run may be longer, and is then not called a shortest one.

    What is kept may also tell what a search gives up, if it is not too large for the loop.
    """
    assert kept.told.keys() == plain.told.keys()
    for prop in props:
        word, length = kept.told[prop.id]
        searched = plain.told[prop.id]
        if searched[0] == "unknown" != word:
            with suppress(TooLarge):
                searched = looped(prop, systems)
                assert word == searched[0]
            continue
        assert word == searched[0]
        if length != searched[1]:
            assert length is not None and length > (searched[1] or 0) and prop.id not in kept.shortest


def loose(system: System) -> System:
    """The same with more runs; a violation counts if it is one of the system as it was."""
    return replace(system, over=True, concrete=CONCRETE, assumptions=())


def asked_ids(system: System) -> Iterator[str]:
    return (p.id for p in asked(system))


def test_something_was_reused() -> None:
    assert not seen["decided"] or seen["reused"] > 0, seen


def test_a_slice_that_cannot_be_read_has_no_name() -> None:
    """A concrete system without what the property names would not be part of the name."""
    go, seen = flag("go"), flag("seen")
    loose = in_order("loose", Block("Watch", [assign(seen, go)]), over=True, concrete="real")
    prop = always("P", "It is seen.", that=seen, covers=["R"], on="loose")
    for real, named in ((in_order("real", Block("Other", [assign(flag("other"), go)])), False),
                        (in_order("real", Block("Watch", [assign(seen, go)])), True)):  # fmt: skip
        name = VerdictStore("any").slice(prop, {"loose": loose, "real": real})
        assert (name is not None) is named


def test_a_change_in_a_branch_that_no_run_takes_changes_no_slice(request: pytest.FixtureRequest) -> None:
    def scene(limit: int, fails: bool) -> System:
        fault, late, on = flag("fault"), flag("late"), flag("on")
        age = var("age", integer(0, 9))
        weather = Block("Weather", [assign(fault, on if fails else FALSE)])
        chart = Block(
            "Chart", [assign(age, ite(fault, ite(age >= 9, 9, age + 1), 0)), assign(late, age > limit)]
        )
        return in_order("scene", weather, chart)

    prop = always("P", "It is in time.", that=~flag("late"), covers=["R"], on="scene")
    store = fresh()
    same = {
        fails: store.slice(prop, {"scene": scene(3, fails)}) == store.slice(prop, {"scene": scene(5, fails)})
        for fails in (False, True)
    }
    assert same == {False: "without" in request.node.name, True: False}
