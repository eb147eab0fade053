"""Names in the texts of a chart that mean nothing there: no datum, event, function or member has them."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, fields, is_dataclass

from rovercheck.checker.drawn.free import arguments_of, free_name
from rovercheck.checker.drawn.grammar.actions import Assignment, ForLoop, NameDeclaration
from rovercheck.checker.drawn.grammar.syntax import Applied, Expression, Member, Name, operands, parts
from rovercheck.checker.drawn.grammar.trees import expressions_of
from rovercheck.checker.drawn.interpret.clock import DURATIONS, LIMITS, UNITS
from rovercheck.checker.drawn.interpret.functions import BUILTINS, WITHOUT_EFFECT
from rovercheck.checker.drawn.interpret.matrix_functions import FURTHER, TYPED
from rovercheck.checker.drawn.parsed import ParsedChart, StateNode
from rovercheck.checker.drawn.records import DrawnEnumeration
from rovercheck.checker.drawn.refused import FREE, DrawingNote, label_of
from rovercheck.spec_model.lang.errors import did_you_mean

COUNTS = ("temporalCount", "elapsed")
CHANGES = ("hasChanged", "hasChangedTo", "hasChangedFrom", "rising", "falling", "crossing")
OF_STATES = ("in", "send")
"""What is followed by names of states and events."""
WAKES = ("tick", "wakeup")
"""The event of a step itself."""
IN_SCRIPTS = ("nargin", "error", "sort", "struct")
"""What scripts have beside functions of numbers."""
TIME = ("t", "getSimulationTime")
"""The time of a simulation."""
IMPLICIT = ("enter", "en", "exit", "ex", "change", "chg")
"""Events that no action sends."""
OUTSIDE = ("coder", "ml")


def unknown_names(
    chart: ParsedChart, enumerations: Iterable[DrawnEnumeration], free: Mapping[str, str] | None = None
) -> Iterator[DrawingNote]:
    """A note for each text with a name that means nothing in it, once for each name, but for what is free."""
    finder = _Finder(chart, {one.name: one for one in enumerations}, free or {})
    for node in chart.root.every():
        if node.parent is not None:
            texts = (node.sections, node.on_events)
            yield from finder.notes(node, f"the state {node.name}", node.ssid, node.line, *texts)
        for function in node.functions.values():
            what, drawn = f"the function {function.signature.name}", function.drawn
            for script in function.script:
                local = {*IN_SCRIPTS, *script.signature.inputs, *script.signature.outputs}
                local |= {*_assigned(script.body)}
                local |= {one.signature.name for one in function.script}
                local_names = {name for name in local if name is not None}
                yield from finder.notes(node, what, drawn.ssid, drawn.line, script.body, local=local_names)
            if function.flow is not None and drawn.table is not None:
                labels = (one.label for one in function.flow.defaults)
                yield from finder.notes(function.flow, what, drawn.ssid, drawn.line, *labels)
    if chart.drawn.is_function:
        return  # what is drawn there calls its function
    for one in chart.transitions:
        what, drawn_ = f"the transition `{label_of(one.drawn)}`", one.drawn
        node = one.source if isinstance(one.source, StateNode) else one.holder
        yield from finder.notes(node, what, drawn_.ssid, drawn_.line, one.label)


@dataclass
class _Finder:
    chart: ParsedChart
    enumerations: Mapping[str, DrawnEnumeration]
    free: Mapping[str, str]
    members: set[str] = field(init=False)
    events: set[str] = field(init=False)

    def __post_init__(self) -> None:
        self.members = {name for one in self.enumerations.values() for name in one.members}
        self.events = {name for node in self.chart.root.every() for name in node.events}

    def notes(
        self, node: StateNode, what: str, ssid: int, line: int, *texts: object, local: Iterable[str] = ()
    ) -> Iterator[DrawingNote]:
        """The notes of the texts of one element, in a state whose names they use."""
        known = {*local, *_assigned(texts, loops_only=True), *self.members, *self.events}
        known |= {*WAKES, *BUILTINS, *FURTHER, *TYPED, *WITHOUT_EFFECT, *self.enumerations}
        for around in node.lineage():
            known |= around.data.keys() | around.functions.keys()
        written = list(expressions_of(*texts))
        found = dict.fromkeys(name for text in written for name in self._unknown(text, known))
        called = {one.function for text in written for one in parts(text) if isinstance(one, Applied)}
        for name in found:
            near = did_you_mean(name, self._own(known))
            text = f"{name} is no datum, event, function or member that is known here. {near}".strip()
            if Name(name) in called:
                text += f" A function of MATLAB may be named under {FREE}."
            if name in TIME:
                text = f"{name} is the time since the beginning, which has no end. Use after or elapsed."
            if name in IMPLICIT:
                text = (
                    f"{name}(...) is an implicit event, which has no meaning here. Send an event of the "
                    "chart where the state is entered or left, or the datum is written."
                )
            yield DrawingNote("refused", node.path, what, text, self.chart.drawn.part, ssid, line)

    def _unknown(self, expression: Expression, known: set[str]) -> Iterator[str]:
        match expression:
            case _ if free_name(expression, self.free):
                for one in arguments_of(expression):
                    yield from self._unknown(one, known)
            case Name(name):
                if name not in known:
                    yield name
            case Member(Name(owner), name) if owner in self.enumerations:
                if name not in self.enumerations[owner].members:
                    yield f"{owner}.{name}"
            case Member(Name(owner)) if owner not in known and owner in self._states:
                pass  # an event of a state
            case Applied(Name(name)) if name in OF_STATES and name not in self._own(known):
                pass
            case Applied(Name(name)) if name in IMPLICIT and name not in self._own(known):
                yield name
            case Applied(Name(name), (limit, unit)) if name in LIMITS:
                yield from self._unknown(limit, known)
                if not isinstance(unit, Name) or unit.name not in (*UNITS, *WAKES):
                    yield from self._unknown(unit, known)
            case Applied(Name(name), arguments) if name in COUNTS:
                pass
            case Applied(Name(name), arguments) if name in (*DURATIONS, *CHANGES):
                for one in arguments[:1]:
                    yield from self._unknown(one, known)
            case Applied(Member(Name(owner))) if owner in OUTSIDE:
                pass
            case _:
                for one in operands(expression):
                    yield from self._unknown(one, known)

    @property
    def _states(self) -> set[str]:
        return {node.name for node in self.chart.root.every()}

    @staticmethod
    def _own(known: set[str]) -> set[str]:
        return known - BUILTINS.keys() - FURTHER.keys() - {*TYPED, *WITHOUT_EFFECT}


def _assigned(thing: object, loops_only: bool = False) -> Iterator[str]:
    """The names that statements give a value, or only those of loops."""
    match thing:
        case ForLoop(variable):
            yield variable
        case NameDeclaration(_, names) if not loops_only:
            yield from names
        case Assignment(targets) if not loops_only:
            for target in targets:
                while isinstance(target, Applied | Member):
                    target = target.function if isinstance(target, Applied) else target.owner
                if isinstance(target, Name):
                    yield target.name
    if isinstance(thing, tuple | list):
        for one in thing:
            yield from _assigned(one, loops_only)
    elif isinstance(thing, dict):
        yield from _assigned(tuple(thing.values()), loops_only)
    elif is_dataclass(thing) and not isinstance(thing, type):
        for one in fields(thing):
            yield from _assigned(getattr(thing, one.name), loops_only)


__all__ = ["unknown_names"]
