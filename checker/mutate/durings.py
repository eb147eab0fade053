"""During actions of a superstate that are not executed in each of the states inside it."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

from rovercheck.spec_model.lang.action import Action, If, reads
from rovercheck.spec_model.lang.chart import Block, Chart, Path, State, parts
from rovercheck.spec_model.lang.edit import edit_at, in_system
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.system import System


@dataclass(frozen=True)
class OtherDuring:
    """During actions of the state at ``site``: which of them are executed only where."""

    site: str
    old: str
    new: str
    make: Callable[[], System]


def other_durings(system: System, chart: Chart) -> Iterator[OtherDuring]:
    """Each superstate whose during actions, all or one, are not executed in a state inside it; or only there.

    Where all are not, also with blocks that nothing else reads: functions that these actions call.
    """
    for path, state in chart.states.items():
        called = [block.name for block in _called(system, chart, state.during)]
        inside = [inner for inner in chart.states if inner[: len(path)] == path and len(inner) > len(path)]
        for inner in inside if state.during and not state.parallel else ():
            condition, name = chart.active_path(inner), ".".join(inner[len(path) :])
            for old, places in _chosen(state.during):
                for word, guard in (("not in", ~condition), ("only in", condition)):
                    made = partial(_guarded, system, chart, path, places, guard, ())
                    yield OtherDuring(f"state/{'.'.join(path)}/during", old, f"{word} {name}", made)
            if called:
                every = range(len(state.during))
                made = partial(_guarded, system, chart, path, every, ~condition, called)
                new = f"not in {name}, nor is {', '.join(called)}"
                yield OtherDuring(f"state/{'.'.join(path)}/during", ALL, new, made)


ALL = "all actions"


def _chosen(actions: Sequence[Action]) -> Iterator[tuple[str, range]]:
    yield ALL, range(len(actions))
    if len(actions) > 1:
        for number, action in enumerate(actions):
            yield f"`{action}`", range(number, number + 1)


def _called(system: System, chart: Chart, actions: Sequence[Action]) -> Iterator[Block]:
    """Blocks that only a chart reads, and there these actions."""
    every = list(parts(system.components))
    for one in every:
        if isinstance(one, Block) and one.written.keys() & reads(actions).keys():
            others = (part for part in every if part is not one and one.written.keys() & part.read.keys())
            if [part.name for part in others] == [chart.name]:
                yield one


def _guarded(
    system: System, chart: Chart, path: Path, places: range, guard: Expr, called: Sequence[str]
) -> System:
    def state(drawn: State) -> State:
        own = drawn.during[places.start : places.stop]
        rest = drawn.during[places.stop :]
        return replace(drawn, during=(*drawn.during[: places.start], If(guard, own), *rest))

    def block(drawn: Chart | Block) -> Chart | Block:
        assert isinstance(drawn, Block)
        return Block(drawn.name, [If(guard, drawn.do)], text=drawn.text, place=drawn.place)

    changed = in_system(system, chart.name, lambda _: edit_at(chart, path, state))
    for name in called:
        changed = in_system(changed, name, block)
    return changed


__all__ = ["OtherDuring", "other_durings"]
