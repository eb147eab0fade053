"""Faults between the parts of a system: dead parts, parts that execute always, dead wires, other initial
values, another order."""

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.system.slice import sliced
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled, parts
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.edit import in_actions, in_block, in_expressions, in_system, instead
from rovercheck.spec_model.lang.expr import FALSE, Const, Expr, Var
from rovercheck.spec_model.lang.place import Place
from rovercheck.spec_model.lang.system import Assumption, System, TransitionSystem


@dataclass(frozen=True)
class Wrong:
    """A fault between parts: where, by which operator, in words, the parts concerned, and what makes it."""

    site: str
    operator: str
    text: str
    place: Place | None
    concerned: tuple[str, ...]
    make: Callable[[], System]


Wanted = Callable[[Chart | Block], bool]


def wiring_faults(system: System, only: Collection[str] | None = None) -> Iterator[Wrong]:
    """Every fault of the wiring of a system, or of some of its parts."""

    def wanted(part: Chart | Block) -> bool:
        return only is None or part.name in only

    yield from _dead_parts(system, wanted)
    yield from _always_enabled(system, wanted)
    yield from _dead_wires(system, wanted)
    yield from _initial_values(system, wanted)
    yield from _orders(system, wanted)


def written_by(part: Chart | Block) -> dict[str, Var]:
    """What a part writes by name: data, and where it is if it is a chart."""
    if isinstance(part, Block):
        return part.written
    return part.written | {v.name: v for v in (*part.locations, part.entered)}


def _dead_parts(system: System, wanted: Wanted) -> Iterator[Wrong]:
    for part in filter(wanted, parts(system.components)):
        kind = "chart" if isinstance(part, Chart) else "block"
        dead = partial(
            replace, system, components=_with(system.components, part.name, lambda p: Enabled(FALSE, p))
        )
        text = f"the {kind} {part.name} never executes and writes nothing"
        yield Wrong(f"{part.name}/{kind}", "dead", text, part.place, (part.name,), dead)


def _with(
    components: Sequence[Component], name: str, change: Callable[[Chart | Block], Component]
) -> tuple[Component, ...]:
    """The components with the part of a name changed."""
    found: list[Component] = []
    for component in components:
        if isinstance(component, Enabled):
            found.append(_around(component, _with(component.components, name, change)))
        else:
            found.append(change(component) if component.name == name else component)
    return tuple(found)


def _around(enabled: Enabled, inside: Sequence[Component]) -> Enabled:
    """The same subsystem with other components."""
    return Enabled(enabled.by, *inside, name=enabled.name, place=enabled.place)


def _always_enabled(system: System, wanted: Wanted) -> Iterator[Wrong]:
    for part, changed in _outside(system.components):
        if wanted(part):
            kind = "chart" if isinstance(part, Chart) else "block"
            text = f"the {kind} {part.name} executes in every step, enabled or not"
            always = partial(replace, system, components=changed)
            yield Wrong(f"{part.name}/{kind}", "enabled", text, part.place, (part.name,), always)


def _outside(components: Sequence[Component]) -> Iterator[tuple[Chart | Block, tuple[Component, ...]]]:
    """Each part of an enabled subsystem taken out of it, but not out of its board, which has a name."""
    for number, component in enumerate(components):
        before, after = components[:number], components[number + 1 :]
        if isinstance(component, Enabled) and component.name:
            for part, inside in _outside(component.components):
                yield part, (*before, _around(component, inside), *after)
        elif isinstance(component, Enabled):
            for earlier, part, later in _divided(component):
                yield part, (*before, *earlier, part, *later, *after)


Components = tuple[Component, ...]


def _divided(enabled: Enabled) -> Iterator[tuple[Components, Chart | Block, Components]]:
    """Each part of a subsystem, with what is left of the subsystem before and after it."""
    inside = enabled.components
    for at, one in enumerate(inside):
        found = _divided(one) if isinstance(one, Enabled) else [((), one, ())]
        for earlier, part, later in found:
            around = (*inside[:at], *earlier), (*later, *inside[at + 1 :])
            left, right = ((_around(enabled, rest),) if rest else () for rest in around)
            yield left, part, right


def _dead_wires(system: System, wanted: Wanted) -> Iterator[Wrong]:
    everything = list(parts(system.components))
    for reader in filter(wanted, everything):
        for name, v in reader.read.items():
            writers = [p.name for p in everything if p is not reader and name in written_by(p)]
            if not writers or name in written_by(reader):
                continue

            def cut(part: Chart | Block, v: Var = v) -> Chart | Block:
                dead = instead(v.name, lambda _: Const(v.init, v.sort))
                return in_block(part, dead) if isinstance(part, Block) else in_expressions(part, dead)

            text = f"{reader.name} always reads {v.domain.show(v.init)} as {name}, which {writers[0]} writes"
            changed = partial(in_system, system, reader.name, cut)
            yield Wrong(
                f"{reader.name}/wire/{name}", "dead-wire", text, reader.place, (reader.name,), changed
            )


def _initial_values(system: System, wanted: Wanted) -> Iterator[Wrong]:
    """Another initial value of each datum that some tick may read before it is written."""
    local = {data.name for chart in system.charts for data, _ in chart.local_to}
    everything = list(parts(system.components))
    first = {n: p for p in reversed(everything) for n in p.written}
    data = {n: v for n, v in system.written.items() if n not in local and wanted(first[n])}
    whole = lowered(system)
    outlives = {v.name for v in sliced(whole, whole.variables).variables} if data else set()
    for name, v in data.items():
        begins = _beside(v)
        if name not in outlives or begins is None or _set_first(whole, everything, name):
            continue
        concerned = tuple(p.name for p in everything if name in p.written or name in p.read)
        text = f"{name} begins as {v.domain.show(begins)}, not as {v.domain.show(v.init)}"
        changed = partial(renewed, system, replace(v, init=begins))
        site = f"{first[name].name}/data/{name}"
        yield Wrong(site, "initial", text, first[name].place, concerned, changed)


def _set_first(whole: TransitionSystem, everything: Sequence[Chart | Block], name: str) -> bool:
    """Whether other parts read a variable, and none of them before it is written."""
    if not any(name in part.read and name not in written_by(part) for part in everything):
        return False
    others = [v for v in whole.variables if v.name != name]
    return name not in {v.name for v in sliced(whole, others).variables}


def _beside(v: Var) -> int | None:
    """The value beside the initial one."""
    values = v.domain.values
    if len(values) < 2:
        return None
    place = values.index(v.init)
    return values[place + 1] if place + 1 < len(values) else values[place - 1]


def renewed(system: System, new: Var) -> System:
    """The system with a variable replaced wherever it occurs."""
    swap = instead(new.name, lambda _: new)

    def act(action: Action) -> Action:
        match action:
            case Assign(var, value):
                return Assign(new if var.name == new.name else var, swap(value))
            case If(condition, then, otherwise):
                return If(swap(condition), tuple(map(act, then)), tuple(map(act, otherwise)))
        return action

    def walk(component: Component) -> Component:
        match component:
            case Enabled():
                inside = map(walk, component.components)
                return Enabled(swap(component.by), *inside, name=component.name, place=component.place)
            case Block():
                do = tuple(map(act, component.do))
                return Block(component.name, do, text=component.text, place=component.place)
            case Chart():
                local = [(new if v.name == new.name else v, states) for v, states in component.local_to]
                return in_actions(in_expressions(component.with_local_data(local), swap), act)

    return replace(
        system,
        components=tuple(map(walk, system.components)),
        assume=swap(system.assume),
        assumptions=tuple(Assumption(a.id, a.text, swap(a.formula)) for a in system.assumptions),
    )


def _orders(system: System, wanted: Wanted) -> Iterator[Wrong]:
    """Two parts that follow each other, one of which writes what the other has to do with."""
    for one, two, changed in _exchanged(system.components):
        ours, theirs = written_by(one).keys(), written_by(two).keys()
        if wanted(one) and (ours & (two.read.keys() | theirs) or theirs & one.read.keys()):
            text = f"{two.name} executes before {one.name}"
            both = (one.name, two.name)
            yield Wrong(
                f"{one.name}/order/{two.name}", "order", text, one.place, both,
                partial(replace, system, components=changed),
            )  # fmt: skip


def _exchanged(
    components: Sequence[Component],
) -> Iterator[tuple[Chart | Block, Chart | Block, tuple[Component, ...]]]:
    for number, component in enumerate(components):
        before, after = components[:number], components[number + 1 :]
        if isinstance(component, Enabled):
            for one, two, inside in _exchanged(component.components):
                yield one, two, (*before, _around(component, inside), *after)
        elif after and not isinstance(after[0], Enabled):
            yield component, after[0], (*before, after[0], component, *after[1:])


def kept(original: System, changed: System) -> System:
    """The changed system, with every variable and input of the original one still there.

    What is no longer written keeps its value, and what is no longer read is an input nevertheless, so that
    properties of the one have a meaning for the other.
    """
    unwritten = [Assign(v, v) for n, v in original.written.items() if n not in changed.written]
    known = changed.inputs.keys()
    unread = [If(_trivial(v), ()) for n, v in original.inputs.items() if n not in known]
    if not unwritten and not unread:
        return changed
    begins = {n: v for part in parts(changed.components) for n, v in part.read.items()}
    keeping = [Assign(v, v) for v in (begins.get(a.var.name, a.var) for a in unwritten)]
    idle = Block("(not used by the mutant)", [*keeping, *unread], place=original.place)
    return replace(changed, components=(*changed.components, idle))


def _trivial(v: Var) -> Expr:
    return v if isinstance(v.sort, Bool) else v == Const(v.init, v.sort)


__all__ = ["Wrong", "kept", "wiring_faults", "written_by"]
