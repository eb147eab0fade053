"""A system as a model of Simulink: its package, the dictionary of its enumerations, and its domains."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path as FilePath

from rovercheck.checker.drawn.lower.domains import domains_path, lines_of
from rovercheck.checker.export.slx.blocks import ChartBlock, given
from rovercheck.checker.export.slx.charts import state_names
from rovercheck.checker.export.slx.diagram import Diagram
from rovercheck.checker.export.slx.formulas import FormulaWriter
from rovercheck.checker.export.slx.names import identifier
from rovercheck.checker.simulink.writer.dictionaries import dictionary
from rovercheck.checker.simulink.writer.packages import WrittenModel
from rovercheck.spec_model.lang.domain import Bool, Domain, Num, show
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import TRUE, Var
from rovercheck.spec_model.lang.programmed import ProgrammedChart
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.wellformed import check_system


@dataclass(frozen=True)
class SlxModel:
    """What is written of a system.

    ``names`` are those of its variables in Simulink, ``states`` those of its states by chart and path,
    ``charts`` those of the charts of Simulink in which its charts are drawn, ``inputs`` the names of inputs
    and, of frozen variables, of the inputs that give them in the first step.
    ``notes`` say what the file does not hold.
    """

    name: str
    model: WrittenModel
    enumerations: Mapping[str, Mapping[str, int]]
    domains: Mapping[str, Domain]
    names: Mapping[str, str]
    states: Mapping[tuple[str, tuple[str, ...]], str]
    charts: Mapping[str, str]
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
    """The model of a system: a chart with a region for each component in the order of execution.

    With enabled subsystems it has several charts, in the subsystems and before and after them.  All names of
    data begin with ``prefix``.
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
        self.name = identifier(system.name)
        self.model = WrittenModel(self.name, step=show(Fraction(system.tick_ms, 1000)))
        self.formulas = FormulaWriter(system.charts, state_names(system.charts), prefix)
        self.domains: dict[str, Domain] = {}
        self.inputs: dict[str, str] = {}
        self.notes: list[str] = []

    def written(self) -> SlxModel:
        """All of it."""
        system, names = self.system, self.formulas.names
        for one in [*system.inputs.values(), *system.frozen]:  # first, so that they keep their names
            names(one.name)
        diagram = Diagram(system, self.model.root, self.formulas, self.name)
        for one in system.inputs.values():
            diagram.top.ports[one.name] = self._input(one, names(one.name))
        for one in system.frozen:
            diagram.top.ports[given(one.name)] = self._input(one, names(given(one.name)))
        shown = [name for name, one in system.written.items() if not one.hidden or name in diagram.carried]
        diagram.connect(shown)
        for block in diagram.charts:
            self._data(block, diagram.given(block), diagram.carried)
        for number, name in enumerate(shown, 1):
            port = self.model.root.outport(names(name), number)
            self.model.root.line(diagram.top.ports[name], port)
        if system.assumed is not TRUE:
            self.notes.append(f"what is assumed of its inputs is no part of the file: `{system.assumed}`")
        return SlxModel(
            self.name, self.model, self.formulas.enumerations, self.domains,
            {name: names(name) for name in self._every()}, self.formulas.states,
            {chart.name: block.name for block in diagram.charts for chart in block.charts}, self.inputs,
            tuple(self.notes),
        )  # fmt: skip

    def _every(self) -> list[str]:
        return [*self.system.inputs, *self.system.written, *(v.name for v in self.system.frozen)]

    def _input(self, one: Var, name: str) -> str:
        """The block of an input of the model."""
        kind = self.formulas.type_of(one.domain)
        self.inputs[one.name] = name
        if isinstance(one.sort, Num):
            self.domains[name] = _numbers(one)
        elif len(one.domain) < (2 if isinstance(one.sort, Bool) else len(one.sort.members)):
            self.notes.append(f"{name} has only these values: {one.domain}")
        return self.model.root.inport(name, len(self.inputs), OutDataTypeStr=kind)

    def _data(self, block: ChartBlock, outputs: Sequence[Var], carried: Collection[str]) -> None:
        """The data of a chart: its outputs in the order of its ports, then those of its own."""
        given_ = {one.name for one in outputs}
        own = [one for one in (*block.written.values(), *block.local) if one.name not in given_]
        for scope, some in (("output", outputs), ("local", own)):
            for one in some:
                name = self.formulas.names(one.name)
                first = self.formulas.constant(one.init, one.sort)
                block.chart.data(name, scope, self.formulas.type_of(one.domain), first)
                if isinstance(one.sort, Num):
                    shared = one.name in carried
                    self.domains[f"{block.name}.{name}" if shared else name] = _numbers(one)


def _numbers(one: Var) -> Domain:
    """The domain of a number, without its unit."""
    assert isinstance(one.sort, Num)
    return Domain(Num(one.sort.resolution), one.domain.values)


__all__ = ["SlxModel", "simulink_of"]
