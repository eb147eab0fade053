"""Data: one meaning for each name, what may be assigned, and data local to states."""

from collections.abc import Iterator, Sequence

from rovercheck.spec_model.lang.action import Action, Assign, each_action, expressions, reads, writes
from rovercheck.spec_model.lang.chart import Chart, Path, parts
from rovercheck.spec_model.lang.domain import Enum
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.system import System, enabled_in
from rovercheck.spec_model.lang.walk import nodes, variables
from rovercheck.spec_model.lang.wellformed.places import legs, name_of, places


def chart_data_faults(chart: Chart) -> Iterator[str]:
    """Assignments to locations, and local data used where they have no value."""
    own = {v.name for v in (*chart.locations, chart.entered)}
    for place in places(chart):
        for name in writes(place.actions):
            if name in own:
                yield (
                    f"{place.where} assigns {name}, which says where the chart is; draw a transition instead."
                )
    for data, owners in chart.local_to:
        yield from _local_faults(chart, data, owners)


def _local_faults(chart: Chart, data: Var, owners: Sequence[str]) -> Iterator[str]:
    try:
        paths = [chart.path(owner) for owner in owners]
    except ModelError as error:
        yield f"{data.name} is local to an unknown state: {error}"
        return
    for path in paths:
        entry = chart.states[path].entry
        inner = any(path[: len(p)] == p and path != p for p in paths)
        if not inner and not any(isinstance(a, Assign) and a.var.name == data.name for a in entry):
            yield (
                f"{data.name} is local to {name_of(path)}, whose entry action does not assign it; "
                "assign it there, so that it has a value from the start."
            )
    for where in _outside_reads(chart, data.name, paths):
        yield f"{where} reads {data.name}, which has a value only in {', '.join(owners)}."


def _outside_reads(chart: Chart, name: str, owners: list[Path]) -> Iterator[str]:
    def outside(path: Path) -> bool:
        return not any(path[: len(owner)] == owner for owner in owners)

    for place in places(chart):
        if name in reads(place.actions) and outside(place.owner):
            yield place.where
    for leg in legs(chart):
        guard = leg.segment.guard
        if guard is not None and name in variables(guard) and outside(leg.source):
            yield f"the guard of {leg.where}"


def system_data_faults(system: System) -> Iterator[str]:
    """Variables that share a name, frozen variables, locations of charts that are not there."""
    own = {v.name for c in system.charts for v in (*c.locations, c.entered)}
    local = {data.name: c.name for c in system.charts for data, _ in c.local_to}
    yield from _twin_faults(system)
    written = system.written
    for v in system.frozen:
        if v.name in written:
            writers = ", ".join(_writers(system, v.name))
            yield f"{v.name} is frozen and is assigned by {writers}; drop one of the two."
    for name in written:
        if name in own:
            yield f"{', '.join(_writers(system, name))} assigns {name}, which says where a chart is."
    for who, read in _readers(system):
        yield from _location_faults(system, who, read, own)
        for name in read:
            if name in local and local[name] != who:
                yield f"{who} reads {name}, which is local to states of {local[name]}; write it to an output."


def _location_faults(system: System, who: str, read: dict[str, Var], own: set[str]) -> Iterator[str]:
    simple = {c.entered.name: c.location().name for c in system.charts if not c.root.parallel}
    for name, v in read.items():
        if _says_where(v) and name not in own:
            known = did_you_mean(name.split(".")[0], [c.name for c in system.charts])
            yield f"{who} reads {name}, the active state of a chart that is not in this system. {known}"
        if name in simple:
            yield f"{who} reads {name}; write `{simple[name]} != '-'`, the chart being exclusive."


def _says_where(v: Var) -> bool:
    return isinstance(v.sort, Enum) and v.sort.name in (f"states of {v.name}", "Entered")


def _writers(system: System, name: str) -> list[str]:
    return [p.name for p in parts(system.components) if name in p.written]


def _readers(system: System) -> Iterator[tuple[str, dict[str, Var]]]:
    for part in parts(system.components):
        yield part.name, part.read
    yield "the assumption", variables(system.assumed)
    for enabled in enabled_in(system.components):
        yield f"the enable `{enabled.by}`", variables(enabled.by)


def _twin_faults(system: System) -> Iterator[str]:
    seen: dict[str, Var] = {}
    for v in _occurrences(system):
        first = seen.setdefault(v.name, v)
        yield from twin_faults(first, v)


def twin_faults(first: Var, other: Var) -> Iterator[str]:
    """What is wrong with two variables of one name: that one has other values, or begins with another."""
    if first is not other and (first.domain != other.domain or first.init != other.init):
        yield (
            f"two variables are named {first.name}: {_described(first)} and {_described(other)}; "
            "rename one or use the same variable."
        )


def _described(v: Var) -> str:
    return f"{v.domain} from {v.domain.show(v.init)}"


def _occurrences(system: System) -> Iterator[Var]:
    """Every variable object of the system, names repeated."""
    for chart in system.charts:
        yield from (*chart.locations, chart.entered)
        yield from (data for data, _ in chart.local_to)
        yield from _vars(chart.expressions, chart.all_actions)
    for block in system.blocks:
        yield from _vars([], block.do)
    yield from (*system.frozen, *_vars([system.assumed, *(e.by for e in enabled_in(system.components))], ()))


def _vars(exprs: Sequence[Expr], actions: Sequence[Action]) -> Iterator[Var]:
    yield from (n for n in nodes(*exprs, *expressions(actions)) if isinstance(n, Var))
    yield from (a.var for a in each_action(actions) if isinstance(a, Assign))
