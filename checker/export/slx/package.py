"""A system as a model of Simulink: its package, the dictionary of its enumerations, and its domains."""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path as FilePath

from rovercheck.checker.drawn.lower.domains import domains_path, lines_of
from rovercheck.checker.export.slx.actions import ActionWriter, event_name
from rovercheck.checker.export.slx.charts import ChartWriter, state_names
from rovercheck.checker.export.slx.formulas import CHOICE, CHOICE_SCRIPT, FormulaWriter
from rovercheck.checker.export.slx.names import identifier
from rovercheck.checker.export.slx.words import ChartWords
from rovercheck.checker.simulink.writer.dictionaries import dictionary
from rovercheck.checker.simulink.writer.packages import WrittenModel
from rovercheck.spec_model.lang.action import Send, each_action
from rovercheck.spec_model.lang.chart import Block, Chart, parts
from rovercheck.spec_model.lang.domain import Bool, Domain, Num, show
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import TRUE, Var
from rovercheck.spec_model.lang.programmed import ProgrammedChart
from rovercheck.spec_model.lang.system import System, enabled_in
from rovercheck.spec_model.lang.wellformed import check_system


@dataclass(frozen=True)
class SlxModel:
    """What is written of a system.

    ``names`` are those of its variables in Simulink, ``states`` those of its states by chart and path,
    ``inputs`` the names of inputs and, of frozen variables, of the inputs that give them in the first step.
    ``notes`` say what the file does not hold.
    """

    name: str
    model: WrittenModel
    enumerations: Mapping[str, Mapping[str, int]]
    domains: Mapping[str, Domain]
    names: Mapping[str, str]
    states: Mapping[tuple[str, tuple[str, ...]], str]
    inputs: Mapping[str, str]
    notes: tuple[str, ...]

    def save(self, path: FilePath) -> tuple[FilePath, ...]:
        """Write ``NAME.slx`` and, beside it, ``NAME.domains.toml`` and ``NAME.sldd`` if needed."""
        made = [path]
        if self.enumerations:
            beside = path.with_suffix(".sldd")
            self.model.dictionary = beside.name
            made.append(dictionary(beside, self.enumerations))
        self.model.save(path)
        if self.domains:
            text = "".join(f"{line}\n" for line in ("[domains]", *lines_of(self.domains)))
            domains_path(path).write_text(text, encoding="utf-8")
            made.append(domains_path(path))
        return tuple(made)


def simulink_of(system: System, prefix: str = "") -> SlxModel:
    """The model of a system: one chart, with a region for each component in the order of execution.

    All names of data begin with ``prefix``.
    Raises ``ModelError`` for what Stateflow has not, with its place and a way around it.
    """
    check_system(system)
    return _SystemWriter(system, prefix).written()


class _SystemWriter:
    """One system being written."""

    def __init__(self, system: System, prefix: str) -> None:
        self.system = system
        for chart in system.charts:
            if isinstance(chart, ProgrammedChart):
                raise ModelError(
                    f"{system.name}: {chart.name} was read from a file, and its step is a program that no "
                    "chart of Stateflow has; write aiger, aag, btor2, smv or promela with --format."
                )
        for one in enabled_in(system.components):
            inside = ", ".join(part.name for part in parts(one.components))
            raise ModelError(
                f"{system.name}: the subsystem of {inside} executes only while `{one.by}`, and in Stateflow "
                "the regions of one chart execute in every step; write a system of what is in it alone."
            )
        self.name = identifier(system.name)
        self.model = WrittenModel(self.name, step=show(Fraction(system.tick_ms, 1000)))
        self.block, self.chart = self.model.root.chart(self.name)
        self.chart.parallel = True
        self.formulas = FormulaWriter(system.charts, state_names(system.charts), prefix)
        self.domains: dict[str, Domain] = {}
        self.inputs: dict[str, str] = {}
        self.notes: list[str] = []
        self.order = 0

    def written(self) -> SlxModel:
        """All of it."""
        system = self.system
        for one in [*system.inputs.values(), *system.frozen]:  # first, so that they keep their names
            self.formulas.names(one.name)
        for one in system.inputs.values():
            self._input(one, self.formulas.names(one.name))
        self._frozen()
        components = list(parts(system.components))
        for number, part in enumerate(components):
            later = components[number:]
            changing = {name for other in later for name in other.written}
            changing |= {v.name for c in later if isinstance(c, Chart) for v in (*c.locations, c.entered)}
            if isinstance(part, Block):
                self._region(part.name, [*ActionWriter(self.formulas, None).lines(part.do)])
                self._data(part.temporaries, "local")
            else:
                self._chart(part, changing)
        self._data([v for v in system.written.values() if not v.hidden], "output")
        self._data([v for v in system.written.values() if v.hidden], "local")
        if self.formulas.chooses:
            self._choice()
        if system.assumed is not TRUE:
            self.notes.append(f"what is assumed of its inputs is no part of the file: `{system.assumed}`")
        return SlxModel(
            self.name, self.model, self.formulas.enumerations, self.domains,
            {name: self.formulas.names(name) for name in self._every()}, self.formulas.states, self.inputs,
            tuple(self.notes),
        )  # fmt: skip

    def _every(self) -> list[str]:
        return [*self.system.inputs, *self.system.written, *(v.name for v in self.system.frozen)]

    def _region(self, name: str, lines: list[str]) -> None:
        """A region that does the same in every step."""
        self.order += 1
        label = self.formulas.names(f"region {name}")
        self.chart.state("\n".join([label, "en, du:", *lines]) if lines else label, None, self.order)

    def _chart(self, chart: Chart, changing: set[str]) -> None:
        words = ChartWords(chart, self.formulas, self.system.step_ms, changing, self.system.elapsed)
        writer = ChartWriter(chart, self.chart, self.formulas, words)
        writer.write()
        if words.before:
            self._region(f"{chart.name} before", words.before)
        self.order += 1
        writer.nodes[()].order = self.order
        if words.after:
            self._region(f"{chart.name} after", words.after)
        for name, (domain, init) in words.data.items():
            self._data([Var(name, domain, init)], "local")
        events = {a.event for a in each_action(chart.all_actions) if isinstance(a, Send)}
        events |= {t.event for t in chart.transitions if t.event is not None}
        for event in sorted(events):
            self.chart.event(self.formulas.names(event_name(chart, event)))

    def _frozen(self) -> None:
        if not self.system.frozen:
            return
        lines = []
        for one in self.system.frozen:
            given = self.formulas.names(f"{one.name}.given")
            self._input(one, given)
            lines.append(f"{self.formulas.names(one.name)} = {given};")
        self._data(self.system.frozen, "local")
        self.order += 1
        label = self.formulas.names("region Frozen")
        self.chart.state("\n".join([label, "en:", *lines]), None, self.order)

    def _input(self, one: Var, name: str) -> None:
        kind = self.formulas.type_of(one.domain)
        number = len(self.inputs) + 1
        self.inputs[one.name] = name
        port = self.model.root.inport(name, number, OutDataTypeStr=kind)
        self.model.root.line(port, f"{self.block}/{number}")
        self.chart.data(name, "input", kind)
        if isinstance(one.sort, Num):
            self.domains[name] = _decimal(one)
        elif len(one.domain) < (2 if isinstance(one.sort, Bool) else len(one.sort.members)):
            self.notes.append(f"{name} has only these values: {one.domain}")

    def _data(self, some: "tuple[Var, ...] | list[Var]", scope: str) -> None:
        for one in some:
            name = self.formulas.names(one.name)
            kind = self.formulas.type_of(one.domain)
            self.chart.data(name, scope, kind, self.formulas.constant(one.init, one.sort))
            if isinstance(one.sort, Num):
                self.domains[name] = _decimal(one)
            if scope == "output":
                number = sum(b.kind == "Outport" for b in self.model.root.blocks) + 1
                port = self.model.root.outport(name, number)
                self.model.root.line(f"{self.block}/{number}", port)

    def _choice(self) -> None:
        made = self.chart.function(f"y = {CHOICE}(c, a, b)", script=CHOICE_SCRIPT)
        for name, kind in (("c", "boolean"), ("a", "double"), ("b", "double")):
            self.chart.data(name, "function input", kind, holder=made)
        self.chart.data("y", "function output", "double", holder=made)


def _decimal(one: Var) -> Domain:
    """The domain of a number, which has decimals."""
    assert isinstance(one.sort, Num)
    if "/" in show(one.sort.resolution):
        raise ModelError(
            f"{one.name} has steps of {one.sort.resolution}, which no decimal is; give it a resolution "
            "such as 0.25."
        )
    return Domain(Num(one.sort.resolution), one.domain.values)


__all__ = ["SlxModel", "simulink_of"]
