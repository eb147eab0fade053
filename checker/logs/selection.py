"""Which properties a log can tell about: those that speak of logged signals, in the steps they speak of."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from rovercheck.checker.conformance.cones import parts_of
from rovercheck.checker.conformance.signals import Vocabulary
from rovercheck.checker.logs.form_monitors import finite
from rovercheck.properties.forms import Property, formulas
from rovercheck.spec_model.lang.action import Action, Assign
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled
from rovercheck.spec_model.lang.expr import Const, Expr
from rovercheck.spec_model.lang.system import TICK_MS, System
from rovercheck.spec_model.lang.walk import structure, variables


@dataclass(frozen=True)
class MonitoredProperty:
    """A monitored property; ``gate``: its charts execute only in the steps in which this is true."""

    property: Property
    gate: Expr | None

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The variables that it reads."""
        gate = [self.gate] if self.gate is not None else []
        return tuple(variables(*formulas(self.property.form), *gate))


@dataclass(frozen=True)
class UnmonitoredProperty:
    """A property that the log cannot tell about: the signals that are missing, or why not."""

    property: Property
    missing: tuple[str, ...] = ()
    because: str = ""


@dataclass(frozen=True)
class PropertySelection:
    """Properties of the board: monitored, in want of columns, and those that no log tells about."""

    monitored: tuple[MonitoredProperty, ...]
    missing: tuple[UnmonitoredProperty, ...]
    untold: tuple[UnmonitoredProperty, ...]


class Wires:
    """Values that blocks without memory compute from logged ones, in every step."""

    def __init__(self, vocabulary: Vocabulary) -> None:
        self._blocks = [
            p.component
            for p in parts_of(vocabulary.board)
            if isinstance(p.component, Block) and not p.enabled and _only_assigns(p.component.do)
            and not p.component.read.keys() & p.component.written.keys()
        ]  # fmt: skip

    def of(self, known: Iterable[str]) -> list[Assign]:
        """The assignments that can be computed in order, of variables that are not known."""
        have, found = set(known), list[Assign]()
        for block in self._blocks:
            for action in block.do:
                assert isinstance(action, Assign)
                if action.var.name not in have and set(variables(action.value)) <= have:
                    found.append(action)
                    have.add(action.var.name)
        return found


def _only_assigns(actions: Sequence[Action]) -> bool:
    return all(isinstance(a, Assign) for a in actions) and len(
        {a.var.name for a in actions if isinstance(a, Assign)}
    ) == len(actions)


def choose(
    vocabulary: Vocabulary,
    known: frozenset[str],
    properties: Iterable[Property],
    system_of: Callable[[str], System],
) -> PropertySelection:
    """Sort the properties by what the log can tell of them; ``known`` are the variables that it holds."""
    sources = _sources(vocabulary)
    every = set(sources)
    every |= {a.var.name for a in Wires(vocabulary).of(every)}
    have = known | {a.var.name for a in Wires(vocabulary).of(known)}
    monitored, missing, untold = (
        list[MonitoredProperty](),
        list[UnmonitoredProperty](),
        list[UnmonitoredProperty](),
    )
    for prop in properties:
        names = set(variables(*formulas(prop.form)))
        if not names & every:
            continue
        chosen, why = _context(vocabulary, prop, system_of(prop.on))
        if why or not names <= every:
            untold.append(
                UnmonitoredProperty(
                    prop, because=why or f"it speaks of {', '.join(sorted(names - every)[:3])}"
                )
            )
        elif set(chosen.names) <= have:
            monitored.append(chosen)
        else:
            lacking = sorted({sources.get(n, n) for n in set(chosen.names) - have})
            missing.append(UnmonitoredProperty(prop, tuple(lacking)))
    return PropertySelection(tuple(monitored), tuple(missing), tuple(untold))


def _sources(vocabulary: Vocabulary) -> dict[str, str]:
    """The signal that tells each variable."""
    found = {name: sight.signal.name for name, sight in vocabulary.sights.items()}
    return found | {o.var.name: o.name for o in vocabulary.board.outputs}


def _context(vocabulary: Vocabulary, prop: Property, system: System) -> tuple[MonitoredProperty, str]:
    """The steps in which the property is required of the board, or why it is not required of a log."""
    everywhere = MonitoredProperty(prop, None)
    if not finite(prop):
        return everywhere, "no finite run breaks it"
    if system.tick_ms != TICK_MS:
        return everywhere, f"it counts ticks of {system.tick_ms} ms"
    if system.elapsed is not None:
        return everywhere, "it measures steps that last unlike times"
    if system.under or not isinstance(system.assumed, Const):
        return (
            everywhere,
            f"it is stated of {system.name}, which takes more for granted than any log must meet",
        )
    on_board = {p.component.name: p.enabled for p in parts_of(vocabulary.board)}
    own = list(_own(system.components, False))
    gates = {n: on_board[n] for n, _, enabled in own if not enabled and on_board.get(n)}
    if not gates:
        return everywhere, ""
    alike = {tuple(structure(e) for e in gate) for gate in gates.values()}
    others = [n for n, is_chart, _ in own if is_chart and n in on_board and n not in gates]
    if len(alike) > 1 or others:
        return everywhere, "its charts do not execute in the same steps of the board"
    return MonitoredProperty(prop, next(iter(gates.values()))[0]), ""


def _own(components: Sequence[Component], enabled: bool) -> Iterator[tuple[str, bool, bool]]:
    """Charts and blocks of a system: name, whether a chart, whether in an enabled subsystem."""
    for component in components:
        if isinstance(component, Enabled):
            yield from _own(component.components, True)
        else:
            yield component.name, isinstance(component, Chart), enabled


__all__ = ["MonitoredProperty", "PropertySelection", "UnmonitoredProperty", "Wires", "choose"]
