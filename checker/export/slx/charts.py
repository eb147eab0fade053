"""A chart as a region of the chart that is written: its states, junctions, transitions and actions."""

from collections import Counter
from collections.abc import Iterator, Sequence

from rovercheck.checker.export.slx.actions import ActionWriter, event_name
from rovercheck.checker.export.slx.formulas import FormulaWriter
from rovercheck.checker.export.slx.names import SlxNames
from rovercheck.checker.export.slx.words import ChartWords
from rovercheck.checker.simulink.writer.charts import (
    WrittenChart,
    WrittenJunction,
    WrittenState,
    WrittenTransition,
)
from rovercheck.spec_model.lang.chart import Chart, Path, State, Transition
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Temporal
from rovercheck.spec_model.lang.walk import nodes


class ChartWriter:
    """Writes one chart below ``region``, which stands for it."""

    def __init__(self, chart: Chart, into: WrittenChart, formulas: FormulaWriter, words: ChartWords) -> None:
        self.chart, self.into, self.formulas, self.words = chart, into, formulas, words
        self.actions = ActionWriter(formulas, chart, words.of(None))
        self.nodes: dict[Path, WrittenState] = {}
        self._orders = Counter[object]()
        self._junctions: dict[tuple[Path, Path, Path | None], WrittenJunction] = {}
        self._timed = {path: self._leads_to_counters(path, set()) for path in chart.junctions}

    def write(self) -> None:
        """All of it; the order of its region, ``nodes[()]``, is given afterwards."""
        self._refuse_reentry()
        for path, state in self.chart.states.items():
            self._state(path, state)
        for path, state in self.chart.states.items():
            for one in state.default:
                self._segment(None, None, path, path, one)
            for one in state.transitions:
                self._segment(self.nodes[path], path, path[:-1], path[:-1], one)
        for path, state in self.chart.states.items():
            self._restarted(path)
            self._label(path, state)

    def _state(self, path: Path, state: State) -> None:
        holder, order = self.nodes[path[:-1]] if path else None, 1
        if path:
            siblings = self.chart.states[path[:-1]]
            order = 1 + siblings.states.index(state) if siblings.parallel else 0
        self.nodes[path] = self.into.state(path[-1] if path else "", holder, order, parallel=state.parallel)

    def _label(self, path: Path, state: State) -> None:
        entry = [*self.words.entered.get(path, ()), *self.actions.lines(state.entry)]
        exits = [*self.actions.lines(state.exit), *self._forgotten(path)]
        lines = [self.formulas.states[self.chart.name, path].rpartition(".")[2]]
        for section, done in (("en", entry), ("du", [*self.actions.lines(state.during)]), ("ex", exits)):
            lines += [f"{section}:", *done] if done else []
        self.nodes[path].label = "\n".join(lines)

    def _forgotten(self, path: Path) -> Iterator[str]:
        """Data local to states begin anew once none of these is active."""
        for var, owners in self.chart.local_to:
            paths = [self.chart.path(one) for one in owners]
            if path in paths:
                reset = f"{self.formulas.names(var.name)} = {self.formulas.constant(var.init, var.sort)};"
                others = [f"in({self.formulas.states[self.chart.name, one]})" for one in paths if one != path]
                yield from [f"if ~({' || '.join(others)})", f"    {reset}", "end"] if others else [reset]

    # --- transitions ---------------------------------------------------------------------------------------

    def _segment(
        self, node: WrittenState | WrittenJunction | None, source: Path | None, level: Path, drawn: Path,
        one: Transition,
    ) -> None:  # fmt: skip
        """A segment drawn at one level, on ways from a state at ``level`` or by default into ``level``."""
        target = self.chart.resolve(drawn, one.target)
        assert target is not None
        end: WrittenState | WrittenJunction
        if target in self.chart.junctions:
            end, scope = self._junction(target, level, source), level
        else:
            end, scope = self.nodes[target], _scope(level, target)
        holder = self.nodes[scope]
        begins = ("default", id(holder)) if node is None else id(node)
        self._orders[begins] += 1
        self.into.transition(node, end, self._text(one, source), self._orders[begins], holder)

    def _text(self, one: Transition, source: Path | None) -> str:
        text = ""
        if one.event is not None:
            text = self.formulas.names(event_name(self.chart, one.event))
        if one.guard is not None:
            text += f"[{self.formulas(one.guard, self.words.of(source))}]"
        if one.do:
            text += "{" + "\n".join(self.actions.lines(one.do)) + "}"
        if one.then:
            text += "/{" + "\n".join(self.actions.lines(one.then)) + "}"
        return text

    def _junction(self, path: Path, level: Path, source: Path | None) -> WrittenJunction:
        """The junction for ways from states of one level: it lies there, so that they leave no more.

        Where a way asks for how long a condition of its state has held, each state has its own.
        """
        key = path, level, source if self._timed[path] else None
        if key not in self._junctions:
            made = self._junctions[key] = self.into.junction(self.nodes[level])
            for one in self.chart.junctions[path].transitions:
                self._segment(made, source, level, path[:-1], one)
        return self._junctions[key]

    def _leads_to_counters(self, path: Path, seen: set[Path]) -> bool:
        seen.add(path)
        for one in self.chart.junctions[path].transitions:
            if one.guard is not None and any(
                isinstance(n, Temporal) and self.words.counts(n) for n in nodes(one.guard)
            ):
                return True
            target = self.chart.resolve(path[:-1], one.target)
            onward = target in self.chart.junctions and target not in seen
            if onward and target is not None and self._leads_to_counters(target, seen):
                return True
        return False

    def _restarted(self, path: Path) -> None:
        """Counters of durations restart before the transitions of their state are tested.

        A first transition does it, which leads nowhere.
        """
        lines = self.words.executed.get(path, ())
        if not lines:
            return
        holder, node = self.nodes[path[:-1]], self.nodes[path]
        for one in (child for each in self.nodes.values() for child in each.children):
            if isinstance(one, WrittenTransition) and one.source is node:
                one.order += 1
        junction = self.into.junction(holder)
        self.into.transition(node, junction, "{" + "\n".join(lines) + "}", 1, holder)
        self.into.transition(junction, node, "[false]", 1, holder)

    # --- what Stateflow has not ----------------------------------------------------------------------------

    def _refuse_reentry(self) -> None:
        """A region whose transition leaves its composite and enters it again."""
        for source, state in self.chart.states.items():
            ends = {end for one in state.transitions for end in self._ends(source[:-1], one, set())}
            for depth in range(len(source)):
                outer = source[:depth]
                composite = self.chart.states[outer]
                if not composite.parallel or composite.states[-1].name == source[depth]:
                    continue
                for end in ends:
                    common = min(len(outer), len(end))
                    left = len(_scope(source[:-1], end)) < len(outer)
                    if left and outer[:common] == end[:common]:
                        raise ModelError(
                            f"{self.chart.name}: a transition of {'.'.join(source)} leaves "
                            f"{'.'.join(outer)} and enters it again, by way of {'.'.join(end)}; whether "
                            "its later regions are then executed in the same step, Stateflow does not say. "
                            "Let the last region do it, or draw the transition from the composite itself."
                        )

    def _ends(self, level: Path, one: Transition, seen: set[Path]) -> Iterator[Path]:
        target = self.chart.resolve(level, one.target)
        assert target is not None
        if target not in self.chart.junctions:
            yield target
        elif target not in seen:
            seen.add(target)
            for onward in self.chart.junctions[target].transitions:
                yield from self._ends(target[:-1], onward, seen)


def _scope(level: Path, target: Path) -> Path:
    """The innermost composite that holds a state of a level and the target inside it."""
    depth = min(len(level), len(target) - 1)
    while level[:depth] != target[:depth]:
        depth -= 1
    return level[:depth]


def state_names(charts: Sequence[Chart]) -> dict[tuple[str, Path], str]:
    """The names of all states in the chart that is written, by their chart and path."""
    top, found, levels = SlxNames(), dict[tuple[str, Path], str](), dict[str, SlxNames]()
    for chart in charts:
        for path in chart.states:
            if not path:
                found[chart.name, ()] = top(chart.name)
                continue
            above = found[chart.name, path[:-1]]
            found[chart.name, path] = f"{above}.{levels.setdefault(above, SlxNames())(path[-1])}"
    return found


__all__ = ["ChartWriter", "state_names"]
