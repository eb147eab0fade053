"""An engine that raises is an internal error: the others have their turns, and it is told."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import pytest

from rovercheck.checker.engines import ALL, AUTO, Engine, Limits, Progress
from rovercheck.checker.process.faults import Fault, InternalError, attempted, listening, report
from rovercheck.checker.process.isolate import ChildStopped, Send, messages
from rovercheck.checker.results.verdict import Answer, Inductive, Open, Reached, Run, Unreachable
from rovercheck.checker.verify.portfolio import Callbacks, PortfolioQuestion, answers, turns
from rovercheck.checker.verify.portfolio.order import ORDERS, Turn
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Var, flag
from rovercheck.spec_model.lang.system import TransitionSystem

TOGGLE, ON, OFF, STRAY = flag("toggle"), flag("on"), flag("off"), flag("stray", "on leaves its domain")
SYSTEM = TransitionSystem(
    "toggle",
    (TOGGLE,),
    (),
    (ON, OFF, STRAY),
    (),
    (Assign(ON, TOGGLE), Assign(OFF, ~TOGGLE)),
    checks=((STRAY, STRAY.doc),),
)
NEVER = Unreachable(Inductive(()))
RUN = Reached(Run({}, ({"toggle": 1},)))
LIMITS = Limits()


@dataclass
class Broken:
    """An engine that fails at once, while it searches, or with what it answers."""

    when: str
    error: Exception
    NAME: str = "broken"
    SUMMARY: str = "for tests"

    def check(
        self, system: TransitionSystem, goals: Sequence[Var], limits: Limits, progress: Progress
    ) -> Mapping[str, Answer]:
        match self.when:
            case "start":
                raise self.error
            case "middle":
                progress("broken: depth 3")
                list(messages(_failing, str(self.error)))
            case "end":
                return {goals[0].name: RUN} if len(goals) > 1 else {}
            case "run":
                return {g.name: Reached(Run({}, ({},))) for g in goals}
        raise self.error


def _failing(send: Send, why: str) -> None:
    send(why)
    raise ValueError(why)


@dataclass
class Sound:
    """An engine that knows all."""

    NAME: str = "sound"
    SUMMARY: str = "for tests"

    def check(self, *_: object) -> Mapping[str, Answer]:
        return {"on": RUN, "off": NEVER, STRAY.name: NEVER}


def asked(
    monkeypatch: pytest.MonkeyPatch, *engines: Engine, how: str = AUTO
) -> tuple[dict[str, Answer], list[Fault]]:
    """What is answered by these engines, the only ones there are, and the faults that are told."""
    known = {engine.NAME: engine for engine in engines}
    monkeypatch.setattr(turns, "engines", lambda: known)
    monkeypatch.setattr(turns, "engines", lambda: known)
    monkeypatch.setattr(turns, "ORDERS", dict.fromkeys(ORDERS, tuple(map(Turn, known))))
    faults: list[Fault] = []
    with listening(faults.append):
        found = answers(PortfolioQuestion(SYSTEM, (ON, OFF)), how, LIMITS, Callbacks())
    return {name: answer for name, (answer, _) in found.items()}, faults


@pytest.mark.parametrize("how", [AUTO, ALL])
@pytest.mark.parametrize(
    ("when", "error"),
    [("start", "ValueError: no such"), ("end", "KeyError: 'off'"), ("run", "KeyError: 'toggle'")],
)
def test_an_engine_that_raises_costs_the_others_no_turn(
    when: str, error: str, how: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The error ended the turns of all others, and was told as something that is not known."""
    found, faults = asked(monkeypatch, Broken(when, ValueError("no such")), Sound(), how=how)
    assert found == {"on": RUN, "off": NEVER, STRAY.name: NEVER}
    assert {(f.who, f.system) for f in faults} == {("broken", "toggle")}
    assert all(f.error.startswith(error) and ", line " in f.error for f in faults)


def test_goals_that_nobody_else_decides_name_engine_and_error(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    found, faults = asked(monkeypatch, Broken("start", ValueError("no\nsuch")))
    reason = "broken failed with ValueError: no such"
    assert found["on"] == found["off"] == Open(reason, 0) and len(faults) == 1


def test_an_error_in_a_process_of_an_engine_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """Engines answer that it is not known; that was all that was said of it."""

    class Patient(Broken):
        def check(
            self, system: TransitionSystem, goals: Sequence[Var], limits: Limits, progress: Progress
        ) -> Mapping[str, Answer]:
            try:
                return super().check(system, goals, limits, progress)
            except ChildStopped as stopped:
                return {g.name: Open(str(stopped), 2) for g in goals}

    found, faults = asked(monkeypatch, Patient("middle", ValueError("deep inside")))
    assert found["on"] == Open("ValueError: deep inside", 2)
    assert [(f.who, f.system) for f in faults] == [("broken", "toggle")]
    assert faults[0].error.startswith("ValueError: deep inside (tests.verify.test_faults, line ")


@pytest.mark.parametrize("error", [MemoryError(), RuntimeError("std::bad_alloc"), OSError(11, "try again")])
def test_what_the_machine_refuses_is_no_fault(error: Exception, monkeypatch: pytest.MonkeyPatch) -> None:
    found, faults = asked(monkeypatch, Broken("start", error), Sound())
    assert found["off"] == NEVER and faults == []
    assert isinstance(asked(monkeypatch, Broken("start", error))[0]["on"], Open)


def test_a_mistake_of_the_model_ends_all_turns(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(ModelError, match="of the model"):
        asked(monkeypatch, Broken("start", ModelError("of the model")), Sound())


def test_a_fault_to_which_nobody_listens_is_raised() -> None:
    with pytest.raises(ValueError, match="no such"):
        answers(PortfolioQuestion(SYSTEM, (ON,)), Broken("start", ValueError("no such")), LIMITS, Callbacks())
    with pytest.raises(InternalError, match="one failed on two with three"):
        report(Fault("one", "two", "three"))


def test_only_the_innermost_listener_hears() -> None:
    outer: list[Fault] = []
    inner: list[Fault] = []
    with listening(outer.append):
        with listening(inner.append):
            report(Fault("one", "two", "three"))
        assert outer == [] and len(inner) == 1
        attempted("all", "toggle", lambda: report(Fault("", "", "three")))
    assert outer == [Fault("all", "toggle", "three")]
