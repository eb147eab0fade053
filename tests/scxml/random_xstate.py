"""Random machines of XState in which the features overlap, and runs of both readings beside each other."""

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from random import Random
from typing import Any

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.scxml.records import StateMachine
from rovercheck.checker.scxml.system import LoweredMachine, lowered_machine
from rovercheck.checker.scxml.xstate.bindings import Bindings
from rovercheck.checker.scxml.xstate.interpret import XstateRunner
from rovercheck.checker.scxml.xstate.reader import xstate_machine_of
from rovercheck.checker.scxml.xstate.runner import runner_of
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.interpret import Interpreter

EVENTS = ("a", "a.b", "c", "d")
GUARDS = {"x is 1": "x == 1", "x below 2": "x < 2", "not b": "!b", "b or x": "b || x >= 2"}
FREE = ("free 1", "free 2")
ASSIGNS = {
    "zero": {"x": "0"}, "one": {"x": "1"}, "more": {"x": "x == 3 ? 0 : x + 1"}, "other": {"b": "!b"},
    "both": {"b": "x == 1", "x": "3 - x"}, "true": {"b": "true"},
}  # fmt: skip
RAISES = {"raise i": {"raise": "i"}, "raise i.j": {"raise": "i.j"}, "raise k": {"raise": "k"}}
NAMED = ("hello", "bye")
BINDINGS = Bindings(Path("random.bindings.toml"), None, GUARDS, {**ASSIGNS, **RAISES})
Step = tuple[str, dict[str, bool]]


class _Writer:
    def __init__(self, random: Random, version: int) -> None:
        self.random, self.version = random, version
        self.paths: list[tuple[str, ...]] = []
        self.kinds: dict[tuple[str, ...], str] = {}
        self.used: set[str] = set()

    def shape(self, path: tuple[str, ...], depth: int) -> dict[str, Any]:
        """The states of a machine, without what is in them."""
        r = self.random.random()
        if path and (depth == 3 or r < 0.55):
            self.kinds[path] = "atomic"
            return {}
        parallel = bool(path) and r > (0.8 if self.version == 5 else 0.92)
        self.kinds[path] = "parallel" if parallel else "compound"
        names = [f"s{len(self.paths) + number}" for number in range(self.random.choice((2, 2, 3)))]
        self.paths += [(*path, one) for one in names]
        made: dict[str, Any] = {"type": "parallel"} if parallel else {"initial": self.random.choice(names)}
        made["states"] = {one: self.shape((*path, one), depth + 1) for one in names}
        if path and self.random.random() < 0.35 and self.version == 5:
            name = f"h{len(self.paths)}"
            self.paths.append((*path, name))
            self.kinds[*path, name] = "history"
            made["states"][name] = {"type": "history", "history": self.random.choice(("shallow", "deep"))}
            if self.random.random() < 0.5:
                made["states"][name]["target"] = self.random.choice(names)
        if not parallel and self.random.random() < 0.3:
            name = f"f{len(self.paths)}"
            self.paths.append((*path, name))
            self.kinds[*path, name] = "final"
            made["states"][name] = {"type": "final"}
        return made

    def fill(self, path: tuple[str, ...], made: dict[str, Any]) -> None:
        """Transitions and actions."""
        random = self.random
        if self.kinds[path] != "history":
            for key in ("entry", "exit"):
                if random.random() < 0.4:
                    made[key] = self.actions()
        if self.kinds[path] not in ("history", "final"):
            on: dict[str, list[Any]] = {}
            for _ in range(random.choice((1, 2, 3))):
                stars = ("*", "a.*") if self.version == 5 else ("*",)
                event = random.choice((*EVENTS, *EVENTS, "i", "i.j", "k", *stars))
                on.setdefault(event, []).append(self.transition(path, made))
            made["on"] = on
            if random.random() < 0.15:
                made["always"] = [self.transition(path, made, guarded=True)]
            if random.random() < 0.25:
                made["after"] = {random.choice(("10", "30")): self.transition(path, made)}
            if self.kinds[path] != "atomic" and path and random.random() < 0.4:
                made["onDone"] = self.transition(path, made)
        for name, inner in made.get("states", {}).items():
            self.fill((*path, name), inner)

    def actions(self) -> list[str]:
        names = (*ASSIGNS, *RAISES, *NAMED, *NAMED)
        found = [self.random.choice(names) for _ in range(self.random.choice((0, 1, 2)))]
        self.used |= set(found)
        return found

    def transition(self, path: tuple[str, ...], made: dict[str, Any], *, guarded: bool = False) -> Any:
        random = self.random
        one: dict[str, Any] = {}
        if guarded or random.random() < 0.4:
            name = random.choice((*GUARDS, *FREE))
            self.used.add(name)
            one["guard" if self.version == 5 else "cond"] = name
        if random.random() < 0.85:
            inside = [name for name in made.get("states", {})]
            if inside and random.random() < 0.3:
                one["target"] = f".{random.choice(inside)}"
            else:
                one["target"] = f"#m.{'.'.join(random.choice(self.paths))}"
        if random.random() < 0.5:
            one["actions"] = self.actions()
        if "target" in one and random.random() < 0.25:
            one["reenter" if self.version == 5 else "internal"] = random.random() < 0.6
        return one


def random_xstate(seed: int, version: int = 5) -> tuple[str, Bindings]:
    """A machine of up to some twenty states, with its bindings."""
    while True:
        made = _Writer(Random(seed), version)
        config = {"id": "m", "context": {"x": 0, "b": False}, **made.shape((), 0)}
        if len(made.paths) <= 20:
            break
        seed += 1_000_003
    made.fill((), config)
    actions = {name: one for name, one in {**ASSIGNS, **RAISES}.items() if name in made.used}
    guards = {name: one for name, one in GUARDS.items() if name in made.used}
    return json.dumps(config), Bindings(Path("random.bindings.toml"), version, guards, actions)


def xstate_steps(machine: StateMachine, random: Random, steps: int) -> list[Step]:
    """Events, and steps without, with what free guards are."""
    return [
        (random.choice(("", *machine.offered)), {one: random.random() < 0.5 for one in machine.guards})
        for _ in range(steps)
    ]


def lowered_xstate(text: str, bindings: Bindings) -> LoweredMachine:
    """A random machine as a system.  Raises ``ModelError`` for what is refused."""
    machine = xstate_machine_of(text.encode(), "random.json", bindings)
    return lowered_machine(machine, "random.json", {"x": integer(0, 3)})


def xstate_runs(
    machine: StateMachine, steps: Sequence[Step], *, at_once: bool = True
) -> Iterator[tuple[set[str], dict[str, Any], set[str]]]:
    """What is active, the data and the actions that ran, up to a step that has no meaning.

    Without ``at_once`` also up to one in which several delays are over, which has another order in XState.
    """
    runner = runner_of(machine)
    assert isinstance(runner, XstateRunner)
    for event, guards in steps:
        try:
            runner.step(event, guards)
        except DrawnFault:
            return
        if runner.at_once > 1 and not at_once:
            return
        yield {one.id for one in runner.active}, dict(runner.data), set(runner.ran)


def xstate_differences(one: LoweredMachine, steps: Sequence[Step]) -> str:
    """Where the two readings differ first; empty where they agree."""
    [chart] = one.system.charts
    system = Interpreter(one.system)
    direct = xstate_runs(one.machine, steps)
    for number, (event, guards) in enumerate(steps, start=1):
        said = next(direct, None)
        given = {"event": one.event.domain.raw(event or "none")}
        given |= {one.guards[name].name: int(value) for name, value in guards.items()}
        try:
            system.step({name: raw for name, raw in given.items() if name in one.system.inputs})
        except ModelError as error:
            return "" if said is None else f"step {number}: {error}"
        if said is None:
            return f"step {number}: only the direct reading has no meaning"
        at = system.valuation()
        active = {
            s.id for s, path in one.view.paths.items()
            if s.parent is not None and s.kind != "history" and evaluate(chart.active_path(path), at)
        }  # fmt: skip
        values = {name: at[name] for name in one.data}
        ran = {name for name, var in one.ran.items() if at[var.name]}
        if (active, values, ran) != said:
            return f"step {number}: {sorted(active)} {values} {ran}, {sorted(said[0])} {said[1:]}"
    return ""
