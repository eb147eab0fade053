"""What ``rovercheck lint`` asks about guards, and which states no transition leaves."""

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass

from rovercheck.checker.commands.lint.document import LintRow
from rovercheck.checker.system.instrument.guards import GuardGoal, with_guards
from rovercheck.properties.forms import Property, reachable
from rovercheck.spec_model.lang.chart import Chart, Path
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.programmed import ProgrammedChart
from rovercheck.spec_model.lang.system import System


@dataclass(frozen=True)
class GuardQuestions:
    """Systems with flags for what is asked of guards, and the questions: whether some run raises a flag."""

    systems: Mapping[str, System]
    asked: tuple[tuple[Property, LintRow], ...]
    again: Mapping[str, Property]
    """Of a condition, whether it is tested and holds in some run: asked where it never fails."""


def guard_questions(
    chosen: Collection[str], systems: Mapping[str, System], names: Iterable[str]
) -> GuardQuestions:
    """What is asked of the guards of the systems ``chosen``; ``names`` are all that are looked at."""
    made: dict[str, System] = {}
    asked: list[tuple[Property, LintRow]] = []
    again: dict[str, Property] = {}
    for name in names:
        made[name], goals = with_guards(systems[name])
        for number, goal in enumerate(goals if name in chosen else ()):
            id_ = f"{name}, {goal.part}: {goal.kind} {number}"
            asked.append((_question(id_, goal.flag, name), _row(name, goal)))
            if goal.tested is not None:
                again[id_] = _question(f"{id_}, tested", goal.tested, name)
    return GuardQuestions(made, tuple(asked), again)


def _question(id_: str, flag: Var, system: str) -> Property:
    return reachable(id_, "This happens.", that=flag, covers=["lint"], on=system)


def _row(system: str, goal: GuardGoal) -> LintRow:
    return LintRow(
        system=system, chart=goal.part, kind=goal.kind, what=goal.text, found="unknown", evidence="", run=()
    )


def without_way_out(system: System) -> Iterator[LintRow]:
    """The states that stay active for good once they are: no transition leaves them or what is around them.

    A state that is alone where it stands, such as a region, needs none, nor one that is drawn as final.
    """
    for chart in system.charts:
        meant = chart.final if isinstance(chart, ProgrammedChart) else ()
        for path in filter(None, chart.states):
            around = [path[:depth] for depth in range(1, len(path) + 1)]
            leaf, chosen = not chart.states[path].states, any(_has_rivals(chart, one) for one in around)
            if (
                path not in meant
                and leaf
                and chosen
                and not any(_left(chart, one) or _left_beside(chart, one) for one in around)
            ):
                yield LintRow(
                    system=system.name, chart=chart.name, kind="way out", what=".".join(path),
                    found="never", evidence="no transition leaves it, or a state around it", run=(),
                )  # fmt: skip


def _left(chart: Chart, path: Path) -> bool:
    """Whether a transition leaves a state, its own or one inside the state around it."""
    inner = chart.inner.get(path[:-1], ()) if isinstance(chart, ProgrammedChart) else ()
    return bool(chart.states[path].transitions or inner)


def _left_beside(chart: Chart, path: Path) -> bool:
    """Whether a transition in another region may leave the parallel state that a region is in.

    One that ends in a junction may.
    """
    around = path[:-1]
    if not around or not chart.states[around].parallel:
        return False
    inner = chart.inner if isinstance(chart, ProgrammedChart) else {}
    for source, state in chart.states.items():
        if source[: len(around)] != around or source[: len(path)] in (around, path):
            continue
        for one in (*state.transitions, *inner.get(source, ())):
            target = chart.resolve(source[:-1], one.target)
            if target is None or target in chart.junctions or target[: len(around)] != around:
                return True
    return False


def _has_rivals(chart: Chart, path: Path) -> bool:
    around = chart.states[path[:-1]] if path[:-1] else chart.root
    return not around.parallel and len(around.states) > 1


__all__ = ["GuardQuestions", "guard_questions", "without_way_out"]
