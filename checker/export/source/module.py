"""A system as a module of Python: its domains, data and charts, in the order of execution."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from rovercheck import language
from rovercheck.checker.drawn.charts.chart import ChartLabels
from rovercheck.checker.export.source.charts import ChartSource
from rovercheck.checker.export.source.formulas import FormulaSource, number_text
from rovercheck.checker.export.source.layout import Keyword, Source, call, laid_out, listed, quoted
from rovercheck.checker.export.source.names import SourceNames
from rovercheck.spec_model.lang.action import expressions
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled, Path, parts
from rovercheck.spec_model.lang.domain import Bool, Domain, Enum, Num, boolean
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Expr, Named, Var
from rovercheck.spec_model.lang.system import Note, System, enabled_in
from rovercheck.spec_model.lang.walk import children, nodes, structure

_PLAIN = re.compile(r"[a-z ]+ of .*, |output of |the output ")
"""What is said of data that the place of their declaration says already."""
TYPES: Mapping[str, tuple[int, int]] = {
    f"{sign}INT{bits}": (0, 2**bits - 1) if sign else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
    for bits in (8, 16, 32)
    for sign in ("U", "")
}
"""Names for the types of integers, by their ends."""


@dataclass(frozen=True)
class SourceModule:
    """A module: its text, and the names that it gives to the system, to charts, variables and formulas.

    Formulas are known by their own names and their structure.
    """

    text: str
    system: str
    charts: Mapping[str, str]
    variables: Mapping[str, str]
    formulas: Mapping[object, str]


def module_of(system: System, labels: Mapping[str, ChartLabels], title: str) -> SourceModule:
    """The module of a system of charts and blocks; ``labels`` are what was drawn, by chart.

    Raises ``ModelError`` for what has no words.
    """
    return _Module(system, labels, title).written()


class _Module:
    def __init__(self, system: System, labels: Mapping[str, ChartLabels], title: str) -> None:
        self._system, self._labels, self._title = system, labels, title
        self._names = SourceNames(language.__all__)
        self._variables: dict[str, Var] = {}
        for one in (*system.inputs.values(), *system.frozen, *self._written()):
            self._variables.setdefault(one.name, one)
        names = {name: self._names.variable(name) for name in self._variables}
        self._formulas_named = {
            key: (self._names.variable(one.name), one)
            for key, one in _named_formulas(self._expressions()).items()
        }
        self._charts = {one.name: self._names.thing(one.name) for one in parts(system.components)}
        self._own = self._names.thing(system.name, "system")
        self._defined = set[object]()
        self._domains: dict[Domain, str] = {}
        self._members: dict[Enum, str] = {}
        formulas = {key: name for key, (name, _) in self._formulas_named.items()}
        self._source = FormulaSource(names, formulas, self._members, dict(self._places()))

    def _places(self) -> Iterator[tuple[str, tuple[str, Chart, Path]]]:
        """The variables that say which states of charts are active."""
        for chart in self._system.charts:
            word = self._charts[chart.name]
            yield chart.entered.name, (word, chart, ())
            for path, state in chart.states.items():
                if state.states and not state.parallel:
                    yield chart.location(path).name, (word, chart, path)

    def _written(self) -> Iterator[Var]:
        for part in parts(self._system.components):
            yield from part.written.values()
            if isinstance(part, Block):
                yield from part.temporaries

    def _expressions(self) -> Iterator[Expr]:
        for part in parts(self._system.components):
            yield from part.expressions if isinstance(part, Chart) else expressions(part.do)
        for one in enabled_in(self._system.components):
            yield one.by

    def written(self) -> SourceModule:
        """The module.  Raises ``ModelError``."""
        data = list(self._data())
        charts = [line for part in parts(self._system.components) for line in self._part(part)]
        enables = [one.by for one in enabled_in(self._system.components)]
        last = [*self._constants(enables), *self._assigned(self._own, self._call_of_system())]
        body = [*self._types(), *data, *charts, *last]
        head = [f'"""{_docstring(self._title)}"""', "", *self._imports(), ""]
        return SourceModule(
            "\n".join([*head, *body]).rstrip() + "\n", self._own, self._charts, self._source.names,
            self._source.formulas,
        )  # fmt: skip

    def _imports(self) -> Iterator[str]:
        words = sorted(self._source.used, key=lambda one: (not one.isupper(), one.islower(), one))
        short = f"from rovercheck import {', '.join(words)}"
        yield from (
            [short] if len(short) <= 88 else ["from rovercheck import (", *(f"    {w}," for w in words), ")"]
        )

    @staticmethod
    def _assigned(name: str, source: Source) -> list[str]:
        return laid_out(source, before=f"{name} = ")

    # --- data ----------------------------------------------------------------------------------------------

    def _types(self) -> Iterator[str]:
        for domain, name in self._domains.items():
            yield from self._assigned(name, self._domain(domain))
        if self._domains:
            yield ""

    def _data(self) -> Iterator[str]:
        inputs = [one for name, one in self._variables.items() if name in self._system.inputs]
        groups = [("Inputs.", inputs)]
        told = {one.name for one in inputs}
        for part in parts(self._system.components):
            own = dict(part.written)
            if isinstance(part, Block):
                own |= {one.name: one for one in part.temporaries}
            left = [one for name, one in own.items() if name not in told]
            told |= own.keys()
            groups.append((f"What {part.name} writes.", left))
        for head, some in groups:
            if some:
                yield f"# {_docstring(head)}"
            for one in some:
                yield from self._assigned(self._source.names[one.name], self._variable(one))
            if some:
                yield ""

    def _variable(self, one: Var) -> Source:
        more = [] if not one.doc or _PLAIN.match(one.doc) else [Keyword("doc", quoted(one.doc))]
        more += [Keyword("hidden", "True")] if one.hidden else []
        if one.domain == boolean and not one.init:
            return call(self._source.word("flag"), quoted(one.name), *more)
        domain = self._source.word("boolean") if one.domain == boolean else self._name_of(one.domain)
        plain = 0 if 0 in one.domain else one.domain.low
        first = [] if one.init == plain else [self._first(one)]
        return call(self._source.word("var"), quoted(one.name), domain, *first, *more)

    @staticmethod
    def _first(one: Var) -> str:
        match one.sort:
            case Bool():
                return "True"
            case Enum() as enum:
                return quoted(enum.member(one.init))
            case Num(resolution, _):
                return number_text(one.init * resolution)

    def _name_of(self, domain: Domain) -> Source:
        """The name of a domain that has one, or the domain itself."""
        if isinstance(domain.sort, Enum):
            if len(domain) != len(domain.sort.members):
                raise ModelError(
                    f"{domain} has fewer values than {domain.sort}; give it all of them in its domain"
                )
            if domain not in self._domains:
                self._members[domain.sort] = self._domains[domain] = self._names.constant(domain.sort.name)
            return self._domains[domain]
        for name, ends in TYPES.items():
            if domain.sort == Num() and domain.dense and (domain.low, domain.high) == ends:
                if domain not in self._domains:
                    self._domains[domain] = self._names.constant(name)
                return self._domains[domain]
        return self._domain(domain)

    def _domain(self, domain: Domain) -> Source:
        match domain.sort:
            case Enum(name, members):
                plain = [number for _, number in members] == list(range(len(members)))
                if plain:
                    shown: Source = listed([quoted(member) for member, _ in members])
                else:
                    shown = f"{{{', '.join(f'{quoted(member)}: {number}' for member, number in members)}}}"
                return call(self._source.word("enumeration"), quoted(name), shown)
            case Num(resolution, _):
                ends = [number_text(raw * resolution) for raw in (domain.low, domain.high)]
                if not domain.dense:
                    every = [number_text(raw * resolution) for raw in domain.values]
                    return call(self._source.word("chosen"), listed(every))
                if resolution == 1:
                    return call(self._source.word("integer"), *ends)
                return call(self._source.word("fixed"), *ends, number_text(resolution))
        raise AssertionError(domain)

    def _constants(self, formulas: Sequence[Expr]) -> Iterator[str]:
        """Formulas with names that are used here first: constants, inputs of charts, calls of functions."""
        for key, one in _named_formulas(formulas).items():
            if key not in self._defined:
                self._defined.add(key)
                name, _ = self._formulas_named[key]
                made = call(self._source.word("named"), quoted(one.name), self._source.formula(one.body))
                yield from self._assigned(name, made)

    # --- charts and blocks ---------------------------------------------------------------------------------

    def _part(self, part: Chart | Block) -> list[str]:
        name = self._charts[part.name]
        formulas = list(
            self._constants(part.expressions if isinstance(part, Chart) else [*expressions(part.do)])
        )
        made = self._chart(part) if isinstance(part, Chart) else self._block(part)
        return [*formulas, *([""] if formulas else []), *self._assigned(name, made), ""]

    def _block(self, block: Block) -> Source:
        made: list[Source] = [quoted(block.name), self._source.actions(block.do)]
        if block.text:
            made.append(Keyword("text", quoted(block.text)))
        if block.temporaries:
            some = [self._source.names[one.name] for one in block.temporaries]
            made.append(Keyword("temporaries", listed(some)))
        return call(self._source.word("Block"), *made)

    def _chart(self, chart: Chart) -> Source:
        used = list(self._used(chart))
        return ChartSource(chart, self._labels.get(chart.name, ChartLabels()), self._source, used).written()

    def _used(self, chart: Chart) -> Iterator[tuple[str, object]]:
        """What the labels of a chart may name."""
        formulas = chart.expressions
        named = [one for one in nodes(*formulas) if isinstance(one, Named)]
        own = {v.name for c in self._system.charts for v in (*c.locations, c.entered)}
        plain = set(chart.written) | _outside_names(formulas)
        for name in self._variables:
            if name in plain and name not in own:
                yield self._source.names[name], self._variables[name]
        seen = set[object]()
        for one in named:
            key = (one.name, structure(one.body))
            if key not in seen and key in self._formulas_named:
                seen.add(key)
                yield self._formulas_named[key]

    # --- the system ----------------------------------------------------------------------------------------

    def _call_of_system(self) -> Source:
        system = self._system
        made = [self._component(one) for one in system.components]
        more: list[Source] = [Keyword("text", quoted(system.text))] if system.text else []
        if system.notes:
            more.append(Keyword("notes", listed([self._note(one) for one in system.notes])))
        more.append(Keyword("tick_ms", str(system.tick_ms)))
        return call(self._source.word("in_order"), quoted(system.name), *made, *more)

    def _component(self, one: Component) -> Source:
        if isinstance(one, Enabled):
            inside = [self._component(part) for part in one.components]
            named = [Keyword("name", quoted(one.name))] if one.name else []
            return call(self._source.word("Enabled"), self._source.formula(one.by), *inside, *named)
        return self._charts[one.name]

    def _note(self, note: str) -> Source:
        if isinstance(note, Note):
            return call(self._source.word("Note"), quoted(str(note)), Keyword("brief", quoted(note.brief)))
        return quoted(note)


def _named_formulas(formulas: Iterable[Expr]) -> dict[object, Named]:
    """Named formulas by name and structure, those inside others first."""
    found: dict[object, Named] = {}
    waiting: list[tuple[Expr, bool]] = [(one, False) for one in formulas]
    seen = set[int]()
    while waiting:
        one, below_done = waiting.pop()
        if below_done and isinstance(one, Named):
            found.setdefault((one.name, structure(one.body)), one)
        elif not below_done and id(one) not in seen:
            seen.add(id(one))
            waiting += [(one, True), *((part, False) for part in children(one))]
    return found


def _outside_names(formulas: Sequence[Expr]) -> set[str]:
    """The variables of formulas, without those that stand under a name only."""
    found, waiting = set[str](), list(formulas)
    while waiting:
        one = waiting.pop()
        if isinstance(one, Var):
            found.add(one.name)
        elif not isinstance(one, Named):
            waiting += children(one)
    return found


def _docstring(text: str) -> str:
    """A text that may stand in a docstring or a comment."""
    plain = " ".join(text.split()).replace("\\", "/").replace('"', "'")
    return "".join(one for one in plain if one.isprintable())


__all__ = ["SourceModule", "module_of"]
