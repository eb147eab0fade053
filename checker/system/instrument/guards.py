"""Guards that decide nothing: those that always hold where they are tested, and those whose order decides."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from rovercheck.checker.system.instrument.entries import Segment
from rovercheck.checker.system.instrument.watch import WatchedChart, raising
from rovercheck.spec_model.lang.action import Action, Assign
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled
from rovercheck.spec_model.lang.domain import boolean
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Expr, Var
from rovercheck.spec_model.lang.programmed import ProgrammedBlock, ProgrammedChart
from rovercheck.spec_model.lang.system import System


@dataclass(frozen=True)
class GuardGoal:
    """Something about a guard that some run may show: its flag is true after such a step.

    ``condition``: it does not hold where it is tested; ``tested`` is true after a step in which it holds.
    ``order``: it holds, and so does that of a later transition which leads elsewhere.
    ``overflow``: an integer is more than its type holds.
    """

    part: str
    kind: Literal["condition", "order", "overflow"]
    text: str
    flag: Var
    tested: Var | None = None


def with_guards(system: System) -> tuple[System, tuple[GuardGoal, ...]]:
    """The system, which behaves as before and raises the flags of these goals.

    Of an imported chart it is not asked whether a condition that may do something holds, too.
    """
    goals: list[GuardGoal] = []
    components = tuple(_component(c, goals) for c in system.components)
    flags = [flag for goal in goals for flag in (goal.flag, goal.tested) if flag is not None]
    reset = Block("goals not reached", [Assign(flag, FALSE) for flag in flags])
    return replace(system, components=(reset, *components)), tuple(goals)


def _component(component: Component, goals: list[GuardGoal]) -> Component:
    match component:
        case Enabled(by=by, components=inside, name=name):
            return Enabled(by, *(_component(c, goals) for c in inside), name=name)
        case ProgrammedChart(program=program):
            found = [
                (marker, marker.rpartition(".")[0], text, valid)  # the chart may be one that this calls
                for marker, (text, valid) in program.tested.items()
            ]
            every = dict.fromkeys((name, text) for _, name, text, _ in found)
            made = {key: _condition(goals, *key) for key in every}
            raised = {
                marker: _raised(goal.tested if valid else goal.flag)
                for marker, name, text, valid in found
                for goal in (made[name, text],)
            }
            for marker, text in program.rivals.items():
                raised[marker] = _raised(_plain(goals, marker.rpartition(".")[0], "order", text).flag)
            raised |= _overflowing(program.overflows, goals)
            return component.with_program(replace(program, statements=raising(program.statements, raised)))
        case ProgrammedBlock(overflows=overflows):
            return component.with_marked(raising(component.marked, _overflowing(overflows, goals)))
        case Chart():
            return _GuardedChart(component, goals).watched()
        case _:
            return component


def _overflowing(overflows: Mapping[str, str], goals: list[GuardGoal]) -> dict[str, tuple[Action, ...]]:
    return {
        marker: _raised(_plain(goals, marker.rpartition(".")[0], "overflow", text).flag)
        for marker, text in overflows.items()
    }


def _condition(goals: list[GuardGoal], part: str, text: str) -> GuardGoal:
    name = f"{part}.condition.{_next(goals, part)}"
    goals.append(GuardGoal(part, "condition", text, _flag(name, text), _flag(f"{name}.tested", text)))
    return goals[-1]


def _plain(goals: list[GuardGoal], part: str, kind: Literal["order", "overflow"], text: str) -> GuardGoal:
    goals.append(GuardGoal(part, kind, text, _flag(f"{part}.{kind}.{_next(goals, part)}", text)))
    return goals[-1]


def _next(goals: list[GuardGoal], part: str) -> int:
    """The number of the next goal of a part, which it has in every system."""
    return 1 + sum(goal.part == part for goal in goals)


def _flag(name: str, text: str) -> Var:
    return Var(f"goal {name}", boolean, 0, text, hidden=True)


def _raised(flag: Var | None) -> tuple[Action, ...]:
    return () if flag is None else (Assign(flag, TRUE),)


class _GuardedChart(WatchedChart):
    """A chart being rewritten for such goals."""

    def __init__(self, chart: Chart, goals: list[GuardGoal]) -> None:
        super().__init__(chart)
        self._found = goals

    def _looked(self, segment: Segment) -> list[tuple[Expr, tuple[Action, ...]]]:
        guard, name = segment.drawn.guard, self._chart.name
        if guard is None:
            return []
        goal = _condition(self._found, name, segment.text)
        looked = [(~guard, _raised(goal.flag)), (guard, _raised(goal.tested))]
        for later in self._rivals(segment):
            assert later.drawn.guard is not None
            both = _plain(self._found, name, "order", f"{segment.text} and {later.text}")
            looked.append((guard & later.drawn.guard, _raised(both.flag)))
        return looked

    def _rivals(self, segment: Segment) -> Iterator[Segment]:
        """Later transitions from the same place with a guard, for the same event, that do something else."""
        beside: Sequence[Segment] = self._transitions.by_group[segment.group]
        for later in beside[segment.order :]:
            one, other = segment.drawn, later.drawn
            alike = (one.target, one.do, one.then) == (other.target, other.do, other.then)
            if other.guard is not None and one.event == other.event and not alike:
                yield later


__all__ = ["GuardGoal", "with_guards"]
