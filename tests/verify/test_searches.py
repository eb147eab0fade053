"""Searches in children: what an engine does to its process costs only its own goals their verdict."""

import os
import signal
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import pytest

from rovercheck.checker.engines import Limits, Progress, explicit
from rovercheck.checker.process.faults import Fault, listening
from rovercheck.checker.results.verdict import Answer, Proved, Unknown, Violated
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.searches import SearchEnd, SearchSettings, searches
from rovercheck.checker.verify.tasks import MOST, Task, tasks
from rovercheck.properties.catalogue import catalogue
from rovercheck.properties.forms import Always, Never, Property
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import System, TransitionSystem
from rovercheck.spec_model.rover import systems

RELAY = systems()["relay"]


@dataclass
class Erratic:
    """The explicit engine, but what the system of a certain name does to it is not foreseen."""

    on: str
    what: str
    NAME: str = "erratic"
    SUMMARY: str = "for tests"

    def check(
        self, system: TransitionSystem, goals: Sequence[Var], limits: Limits, progress: Progress
    ) -> Mapping[str, Answer]:
        if system.name == self.on:
            self._act()
        return explicit.check(system, goals, replace(limits, seconds=None), progress)

    def _act(self) -> None:
        match self.what:
            case "crash":
                os.kill(os.getpid(), signal.SIGSEGV)
            case "hang":
                time.sleep(60)
            case "raise":
                raise ValueError("no such thing")
            case "misread":
                raise ModelError("a mistake in the model")


def relay(name: str) -> System:
    """The system of the relay by another name."""
    return replace(RELAY, name=name, over=False, concrete="")


KNOWN = {name: relay(name) for name in ("one", "two", "three")}


def work() -> list[Task]:
    gives = RELAY.written["give_b2_actuation"]
    return [
        Task(
            s,
            (
                Property(f"{n}-a", "", Never(gives & ~gives), (), n),
                Property(f"{n}-b", "", Always(~gives), (), n),
            ),
        )
        for n, s in KNOWN.items()
    ]


def decided(what: str, seconds: float | None = None) -> dict[str, Result]:
    """The results of all tasks by property, when the second one goes wrong."""
    limits = Limits(seconds=seconds, memory=1 << 30)
    faults: list[Fault] = []
    with listening(faults.append):
        heard = list(searches(work(), KNOWN, SearchSettings(Erratic("two", what), limits, 2)))
    assert [(f.who, f.system) for f in faults] == ([("erratic", "two")] if what == "raise" else [])
    assert sum(isinstance(one, SearchEnd) for one in heard) == len(KNOWN)
    return {one.property.id: one for one in heard if isinstance(one, Result)}


@pytest.mark.parametrize(
    ("what", "reason"),
    [
        ("crash", "SIGSEGV"),
        ("hang", "time: 6 s ended while searching (erratic)"),
        ("raise", "ValueError: no such"),
    ],
)
def test_only_the_goals_of_the_search_that_went_wrong_are_unknown(what: str, reason: str) -> None:
    found = decided(what, 6.0 if what == "hang" else None)
    for name in ("one", "three"):
        assert isinstance(found[f"{name}-a"].verdict, Proved)
        assert isinstance(found[f"{name}-b"].verdict, Violated)
    for id in ("two-a", "two-b"):
        verdict = found[id].verdict
        assert isinstance(verdict, Unknown) and reason in verdict.reason


def test_a_mistake_in_the_model_ends_everything() -> None:
    with pytest.raises(ModelError, match="a mistake in the model"):
        decided("misread")


def test_a_result_is_about_the_property_that_was_asked() -> None:
    todo = work()
    asked = {id(p) for task in todo for p in task.properties}
    found = [
        one for one in searches(todo, KNOWN, SearchSettings("explicit", jobs=2)) if isinstance(one, Result)
    ]
    assert {id(one.property) for one in found} == asked
    assert all(one.system == one.property.on for one in found)


@pytest.mark.parametrize("name", ["relay", "board1", "references", "sonar_silence"])
def test_properties_are_grouped_as_the_lowered_system_says(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    about = [p for p in catalogue().values() if p.on == name]
    quick = [task.properties for task in tasks(about, systems())]
    monkeypatch.setattr("rovercheck.checker.verify.tasks.without_step", lower)
    assert quick == [task.properties for task in tasks(about, systems())]
    assert max(map(len, quick)) <= MOST
    assert sorted(p.id for group in quick for p in group) == sorted(p.id for p in about)
