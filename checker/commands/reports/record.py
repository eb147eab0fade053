"""The verdicts that the reports show, on record: each with a digest of the question that it answers.

Whether the reports are what charts and properties of today give can then be seen without searching anew for
answers to questions that are still the same.  A run on record is replayed on the charts as they are.
"""

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from hashlib import sha256
from pathlib import Path
from typing import Any

from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.engines import Limits
from rovercheck.checker.model.kept_invariants import invariants_of_rover
from rovercheck.checker.model.kept_runs import MOST_TICKS, VERDICTS, KeptRun, contents, kept, lines, row
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Exhausted, Inductive, Proved, Unknown, Violated
from rovercheck.checker.system.formula_json import Unreadable, formula, written
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.system.text import SystemText
from rovercheck.checker.verify.liveness.loops import loop_query, repeated
from rovercheck.checker.verify.result import Result, limited
from rovercheck.checker.verify.runs.known_runs import run_in
from rovercheck.checker.verify.runs.replay import ReplayError, replay
from rovercheck.checker.verify.searches import SearchSettings, on_record
from rovercheck.checker.verify.tasks import Task, tasks
from rovercheck.properties.forms import Property
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System

FILE = f"{VERDICTS}.json"
Row = Mapping[str, Any]
Systems = Mapping[str, System]

CHOSEN = {"run", "conjuncts"}
"""What of a verdict a solver may choose among several: it differs from machine to machine."""


def _nothing(_: Task) -> bool:
    return False


@dataclass
class VerdictRecord:
    """Verdicts ``known`` from a file, by id, and those found ``now``, which make up the next one.

    ``anew`` says of which tasks the answers are searched for in any case.
    """

    known: Mapping[str, Row] = field(default_factory=dict)
    anew: Callable[[Task], bool] = _nothing
    now: dict[str, Row] = field(default_factory=dict)

    def decided(
        self, properties: Sequence[Property], systems: Systems, limits: Limits, under: str = ""
    ) -> Iterator[Result]:
        """The verdicts on the properties, ``under`` a repair of that name: known ones of the same question,
        all others searched for."""
        invariants, left = invariants_of_rover(), list[Property]()
        questions: dict[str, str] = {}
        for task in tasks(properties, systems):
            question = asked(replace(task, recorded=on_record(task, invariants)), systems, limits)
            questions |= {p.id: question for p in task.properties}
            rows = {p.id: self.known.get(f"{under}{p.id}") for p in task.properties}
            found = None if self.anew(task) else _answers(task, rows, question, systems)
            if found is None:
                left += task.properties
            for one in found or ():
                self._keep(one, under, question)
                yield limited(one, systems)
        search = SearchSettings(limits=limits, invariants=invariants)
        for one in results(left, systems, search) if left else ():
            self._keep(one, under, questions[one.property.id])
            yield one

    def _keep(self, one: Result, under: str, question: str) -> None:
        made = _row(one)
        if made is not None:
            self.now[f"{under}{one.property.id}"] = sealed({**made, "question": question})

    def text(self) -> str:
        """The verdicts found now as JSON, one a line."""
        return lines(VERDICTS, VERDICTS, self.now)


def read(folder: Path) -> dict[str, Row]:
    """The verdicts on record in a folder of reports.  Raises ``ModelError`` if the file holds none."""
    return contents(folder / FILE, VERDICTS, VERDICTS, dict)


def without_choices(text: str) -> dict[str, Row]:
    """The rows of a file without what a solver chose among several."""
    rows = json.loads(text)[VERDICTS]
    return {id: {name: one[name] for name in one.keys() - CHOSEN - {"seal"}} for id, one in rows.items()}


def asked(task: Task, systems: Systems, limits: Limits) -> str:
    """The digest of what the answers to a task follow from, and of the invariants that are tried first.

    That is the system as lowered, with the monitors of the properties, and the one to reproduce a run on.
    """
    text = SystemText()
    text.add(limits.timers.value, json.dumps(task.recorded))
    question = reduce(lowered(task.system), task.properties)
    asked_on = [question.system, *(lowered(systems[name]) for name in [task.system.concrete] if name)]
    for system in asked_on:
        text.add(system.name, system.tick_ms)
        text.system(system)
        text.add("checks", *(text.expr(broken) for broken, _ in system.checks))
    text.add(task.system.over, task.system.under)
    for goal in question.goals:
        text.add(goal.property.id, goal.reach, goal.property.form, text.expr(goal.var))
    return text.digest


def sealed(one: Row) -> Row:
    """The row with a digest of itself: one that was changed by hand, or by a merge, is not believed."""
    unsealed = {name: one[name] for name in one if name != "seal"}
    return {**unsealed, "seal": sha256(json.dumps(unsealed, sort_keys=True).encode()).hexdigest()}


def _row(one: Result) -> Row | None:
    """What is kept of a result; None of what is searched for each time: open questions, runs into a trap."""
    verdict = one.verdict
    if isinstance(verdict, Unknown):
        return None
    made: dict[str, Any] = {"verdict": verdict.word, "engine": verdict.engine, "system": one.system}
    match verdict.because:
        case Exhausted() as all_:
            seen = {"states": all_.states, "transitions": all_.transitions, "depth": all_.depth}
            made |= {**seen, "variables": [*all_.variables], "skipped": all_.skipped}
        case Inductive() as shown:
            formulas = [*map(written, shown.conjuncts)]
            made |= {"conjuncts": formulas, "ticks": shown.ticks, "simple": shown.simple}
        case Trace() as trace:
            if trace.trapped is not None:
                return None
            made |= {"run": row(KeptRun(one.system, run_in(trace))), "shortest": trace.shortest}
            made |= {} if trace.loop is None else {"loop": trace.loop}
    return made | ({"claim": verdict.claim} if isinstance(verdict, Proved) and verdict.claim else {})


def _answers(
    task: Task, rows: Mapping[str, Row | None], question: str, systems: Systems
) -> list[Result] | None:
    """The results on record of a task; None unless all are there and answer its question."""
    found = list[Result]()
    for prop in task.properties:
        one = rows[prop.id]
        if one is None or one["question"] != question or one != sealed(one):
            return None
        try:
            found.append(_result(one, prop, systems))
        except (KeyError, TypeError, ValueError, Unreadable, ReplayError, ModelError):
            return None
    return found


def _result(one: Row, prop: Property, systems: Systems) -> Result:
    """A row as a result; a run is replayed."""
    name, engine = one["system"], one["engine"]
    because: Exhausted | Inductive | Trace
    if "run" in one:
        there = reduce(lowered(systems[name]), [replace(prop, on=name)])
        [goal], run = there.goals, kept(one["run"], MOST_TICKS).run
        again = "loop" in one
        trace = (
            repeated(loop_query(there, goal), run, one["loop"]) if again else replay(there.system, goal, run)
        )
        because, prop = replace(trace, shortest=one["shortest"]), goal.property
    elif "conjuncts" in one:
        on = systems.get(name, systems[prop.on])  # a system with free timers is made by who searches it
        of = reduce(lowered(on), [prop]).system
        known = {v.name: v for v in (*of.frozen, *of.variables)}
        formulas = tuple(formula(tree, known) for tree in one["conjuncts"])
        because = Inductive(formulas, one["ticks"], one["simple"])
    else:
        seen = one["states"], one["transitions"], one["depth"], tuple(one["variables"]), one["skipped"]
        because = Exhausted(*seen)
    made = Proved(because, engine, one.get("claim", ""))
    return Result(prop, made if one["verdict"] == made.word else Violated(because, engine), name)
