"""What is never kept: what is unknown, or was taken back; and what others asked for is not theirs."""

from collections.abc import Callable, Generator, Mapping, Sequence
from contextlib import closing, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pytest

from rovercheck.checker.certify.outcome import Accepted, Outcome, Rejected, Undecided
from rovercheck.checker.engines import Limits, Progress, Timers
from rovercheck.checker.process.faults import Fault, listening
from rovercheck.checker.process.pool import Pool, PoolEvent
from rovercheck.checker.results.verdict import Answer, Exhausted, Open, Proved, Unknown, Unreachable
from rovercheck.checker.store.verdicts import VerdictStore
from rovercheck.checker.store.verdicts import store as chosen
from rovercheck.checker.verify.portfolio import Disagreement, turns
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.search_worker import PropertyDecided, StaysInDomains
from rovercheck.checker.verify.searches import SearchSettings, events, searches
from rovercheck.checker.verify.tasks import Task
from rovercheck.properties.forms import always, never
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Var, flag, ite, var
from rovercheck.spec_model.lang.system import System, TransitionSystem, in_order
from tests.store.lamps import ON, PROPERTIES, decided, lamp, of, store, told
from tests.store.naive_engine import NaiveEngine
from tests.store.test_forged import TRUTH
from tests.verify.test_searches import Erratic

here = pytest.mark.usefixtures("no_child")
pytestmark = pytest.mark.usefixtures("folder")
PROOF = Exhausted(7, 20, 3, ("count",))


def kept(folder: Path) -> list[Path]:
    return sorted(folder.glob("*-verdict-json.o"))


@dataclass
class Lazy:
    """An engine that leaves some goals open."""

    opened: Callable[[str], bool] = lambda _: True
    NAME: str = "lazy"
    SUMMARY: str = "for tests"

    def check(
        self, system: TransitionSystem, goals: Sequence[Var], limits: Limits, progress: Progress
    ) -> Mapping[str, Answer]:
        found = NaiveEngine().check(system, goals, limits, progress)
        return {n: Open("for tests", 3) if self.opened(n) else a for n, a in found.items()}


@here
def test_what_is_unknown_is_looked_for_again(folder: Path) -> None:
    assert {word for word, _ in told(decided(lamp(), store(), engine=Lazy())).values()} == {"unknown"}
    assert kept(folder) == []
    assert told(decided(lamp(), store())) == TRUTH


@here
def test_of_a_search_only_what_it_decides_is_kept(folder: Path) -> None:
    found = told(decided(lamp(), store(), engine=Lazy(lambda name: "lit" in name)))
    open_ = {id for id, (word, _) in found.items() if word == "unknown"}
    assert open_ and open_ < {*TRUTH}
    kept_, systems = store(), {ON: lamp()}
    for prop in PROPERTIES:
        for name in (kept_.question(prop, systems), kept_.slice(prop, systems)):
            assert (kept_.read(name) is None) == (prop.id in open_)


@here
def test_a_store_writes_no_unknown_verdict(folder: Path) -> None:
    store().write(store().question(of("lit-violated"), {ON: lamp()}), Unknown("why", 3, "bmc"), ON)
    assert kept(folder) == []


@pytest.mark.parametrize("how", ["hang", "crash", "raise"])
def test_of_a_search_that_ends_otherwise_nothing_is_kept(how: str, folder: Path) -> None:
    """In a child."""
    faults: list[Fault] = []
    limits = Limits(seconds=0.5 if how == "hang" else None)
    with listening(faults.append):
        found = decided(lamp(), store(), engine=Erratic(ON, how), limits=limits)
    assert {one.verdict.word for one in found} == {"unknown"} and len(found) == len(PROPERTIES)
    assert kept(folder) == []


@here
def test_of_an_interrupted_check_what_was_told_is_kept_and_nothing_else(folder: Path) -> None:
    """Ctrl-C between two results."""
    settings = SearchSettings(NaiveEngine(), jobs=1, store=store())
    heard: list[Result] = []
    with closing(events(PROPERTIES, {ON: lamp()}, settings)) as coming, suppress(KeyboardInterrupt):
        for one in coming:
            if isinstance(one, Result):
                heard.append(one)
                if len(heard) == 2:
                    raise KeyboardInterrupt
    assert len(heard) == 2
    for path in kept(folder):
        found = store().read(path.stem)
        assert found is not None and found.verdict.word in {one.verdict.word for one in heard}
    assert told(decided(lamp(), store())) == TRUTH


# --- what is taken back ------------------------------------------------------------------------------

GO, X, Y = flag("go"), var("x", integer(0, 2)), var("y", integer(0, 5))


def leaving() -> System:
    """A system that leaves a domain, but not at once."""
    from rovercheck.spec_model.lang.words import minimum

    return in_order(
        "lamp",
        Block("Counting", [assign(Y, minimum(Y + 1, 5))]),
        Block("Over", [assign(X, ite(Y == 5, X + 1, X))]),
    )


LEAVING = (
    never("soon", "", that=Y == 1, covers=["R"], on=ON),
    always("proved", "", that=Y <= 5, covers=["R"], on=ON),
)


@here
@pytest.mark.parametrize("engine", ["naive", "auto", "bmc", "explicit"])
def test_of_a_system_that_leaves_a_domain_nothing_is_kept(engine: str, folder: Path) -> None:
    """Neither a proof nor a violation that was found before it was known."""
    for _ in range(2):
        with pytest.raises(ModelError, match=r"x := .* outside"):
            decided(leaving(), store(), LEAVING, engine=NaiveEngine() if engine == "naive" else engine)
        assert kept(folder) == []


def heard(monkeypatch: pytest.MonkeyPatch, tasks: Sequence[Task], *sent: tuple[int, object]) -> list[Result]:
    """The results of searches whose children send that."""

    def said(*_: object) -> Generator[PoolEvent, None, None]:
        for number, one in sent:
            yield one if isinstance(one, PoolEvent) else PoolEvent(number, one)

    monkeypatch.setattr(Pool, "run", said)
    systems = {task.system.name: task.system for task in tasks}
    found = searches(tasks, systems, SearchSettings("naive", store=store()))
    return [one for one in found if isinstance(one, Result)]


def violated(id: str) -> PropertyDecided:
    [found] = decided(lamp(), None, [of(id)])
    return PropertyDecided(id, found.verdict, ON, ("cd" * 32 + "-verdict-json",), (id,))


def proved(id: str) -> PropertyDecided:
    return PropertyDecided(id, Proved(PROOF, "naive"), ON, ("ef" * 32 + "-verdict-json",), (id,))


@pytest.fixture
def one_task() -> list[Task]:
    return [Task(lamp(), (of("lit-violated"), of("count-proved")))]


@here
def test_a_violation_waits_until_no_domain_can_be_left(
    monkeypatch: pytest.MonkeyPatch, one_task: list[Task], folder: Path
) -> None:
    said = violated("lit-violated")
    with pytest.raises(ModelError, match="later"):
        heard(monkeypatch, one_task, (0, said), (0, ModelError("found out later")))
    assert kept(folder) == []
    heard(monkeypatch, one_task, (0, said), (0, StaysInDomains()))
    assert len(kept(folder)) == 1


@here
def test_what_was_told_before_a_crash_is_not_kept(
    monkeypatch: pytest.MonkeyPatch, one_task: list[Task], folder: Path
) -> None:
    crash = PoolEvent(0, failure="killed by SIGSEGV")
    end = PoolEvent(0, done=True)
    told_ = violated("lit-violated")
    heard(monkeypatch, one_task, (0, StaysInDomains()), (0, told_), (0, end))
    assert len(kept(folder)) == 1
    heard(monkeypatch, one_task, (0, StaysInDomains()), (0, told_), (0, crash), (0, end))
    assert kept(folder) == []


@here
def test_of_a_contradiction_after_a_crash_nothing_is_kept(
    monkeypatch: pytest.MonkeyPatch, one_task: list[Task], folder: Path
) -> None:
    crash = PoolEvent(0, failure="killed by SIGSEGV")
    with pytest.raises(AssertionError, match="lit-violated was"):
        heard(
            monkeypatch,
            one_task,
            (0, StaysInDomains()),
            (0, proved("lit-violated")),
            (0, crash),
            (0, violated("lit-violated")),
        )
    assert kept(folder) == []


@here
@pytest.mark.parametrize(
    "outcome", [Rejected("the step", "x = 1"), Undecided("time"), Accepted("bitwuzla"), None]
)
def test_a_proof_whose_certificate_is_rejected_is_not_kept(
    outcome: Outcome | None, monkeypatch: pytest.MonkeyPatch, one_task: list[Task], folder: Path
) -> None:
    said = replace(proved("count-proved"), certificate=outcome)
    [found, *_] = heard(monkeypatch, one_task, (0, StaysInDomains()), (0, said), (0, PoolEvent(0, done=True)))
    assert found.certificate == outcome
    assert len(kept(folder)) == (0 if isinstance(outcome, Rejected) else 1)


@here
def test_where_engines_disagree_nothing_is_kept(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    class Liar(NaiveEngine):
        def check(self, *args: Any) -> Mapping[str, Answer]:
            return {g.name: Unreachable(PROOF) for g in args[1]}

    monkeypatch.setattr(turns, "engines", lambda: {"naive": NaiveEngine(), "liar": Liar(NAME="liar")})
    with pytest.raises(Disagreement):
        decided(lamp(), VerdictStore("all"), engine="all")
    assert kept(folder) == []


# --- who asked ---------------------------------------------------------------------------------------


def test_what_one_engine_found_is_not_what_another_is_asked() -> None:
    asked = [
        chosen(engine, limits)
        for engine in ("auto", "all", "bmc", "explicit")
        for limits in (
            Limits(), Limits(depth=5), Limits(depth=6), Limits(transitions=9), Limits(timers=Timers.SKIP),
            Limits(timers=Timers.FREE),
        )
    ]  # fmt: skip
    systems = {ON: lamp()}
    for kind in ("question", "slice"):
        names = {getattr(one, kind)(of("lit-violated"), systems) for one in asked}
        assert len(names) == len(asked) and None not in names
    same = (Limits(seconds=3), Limits(memory=1 << 30), Limits())
    assert len({chosen("auto", one).question(of("lit-violated"), systems) for one in same}) == 1  # type: ignore[union-attr]


def test_a_bound_found_by_bmc_is_no_answer_for_auto() -> None:
    bmc, auto = chosen("bmc", Limits(depth=3)), chosen("auto", Limits())
    assert bmc is not None and auto is not None
    prop, systems = of("lit-violated"), {ON: lamp()}
    [found] = decided(lamp(), None, [prop], traces=True)
    bmc.write(bmc.question(prop, systems), found.verdict, ON)
    assert bmc.read(bmc.question(prop, systems)) is not None
    assert auto.read(auto.question(prop, systems)) is None


def test_an_engine_of_a_users_own_keeps_nothing() -> None:
    assert chosen(NaiveEngine(), Limits()) is None


def test_switched_off_nothing_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROVERCHECK_STORE", "")
    assert chosen("auto", Limits()) is None
    monkeypatch.setenv("ROVERCHECK_STORE", "on")
    assert chosen("auto", Limits()) is not None


def test_another_property_of_the_same_id_is_another_question() -> None:
    systems, kept_ = {ON: lamp()}, store()
    one = of("lit-violated")
    others = [replace(one, form=of("count-proved").form), replace(one, from_tick=3), replace(one, id="B")]
    for kind in ("question", "slice"):
        names = [getattr(kept_, kind)(p, systems) for p in (one, *others)]
        assert len({*names}) == len(names)


def test_the_concrete_system_enters() -> None:
    prop, kept_ = of("lit-violated"), store()
    loose = replace(lamp(), over=True, concrete="real")
    one = {ON: loose, "real": replace(lamp(), name="real")}
    two = {ON: loose, "real": replace(lamp(~flag("go")), name="real")}
    for kind in ("question", "slice"):
        assert getattr(kept_, kind)(prop, one) != getattr(kept_, kind)(prop, two)
