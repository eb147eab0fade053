"""A whole model as a system, with what is known of its data so far."""

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction

from rovercheck.checker.drawn.free import free_outputs
from rovercheck.checker.drawn.lower.context import LoweringContext
from rovercheck.checker.drawn.lower.data import DataTable
from rovercheck.checker.drawn.lower.free_inputs import FreeInputs, free_note
from rovercheck.checker.drawn.lower.kinds import sizes
from rovercheck.checker.drawn.lower.lowered import LoweredModel, RangeNotKnown
from rovercheck.checker.drawn.lower.program import domain_of, in_steps
from rovercheck.checker.drawn.lower.symbols import NotLowered, Symbolic, filled, leaves
from rovercheck.checker.drawn.lower.system import SystemWriter
from rovercheck.checker.drawn.lower.view import plain_name
from rovercheck.checker.drawn.parsed import ParsedChart
from rovercheck.checker.drawn.records import DrawnBlock, DrawnModel
from rovercheck.checker.drawn.wiring import number_of
from rovercheck.spec_model.lang.action import Assign, each_action, expressions
from rovercheck.spec_model.lang.chart import Block, Component
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.evaluate import run
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.system import Note, Program, System, in_order
from rovercheck.spec_model.lang.walk import variables


class LoweringAttempt:
    """One attempt to lower a model; ``systems`` makes the components of its charts and blocks."""

    def __init__(
        self, model: DrawnModel, file: str, table: DataTable, charts: Mapping[str, ParsedChart], step: str,
        most: int, systems: type[SystemWriter] = SystemWriter,
    ) -> None:  # fmt: skip
        self.model, self.table, self.step, self._file = model, table, step, file
        self._systems = systems
        self.context = LoweringContext(model, file, table, charts, step, most)
        self.inputs = self.context.inputs

    def lowered(self) -> LoweredModel:
        """The system.  Raises ``NotLowered``, and ``RangeNotKnown`` for inputs without a domain."""
        top = self._systems(self.model.system, self.context, "")
        root = {number_of(one): one for one in self.model.system.blocks if one.kind == "Inport"}
        given = [self._input(root[n], top) for n in sorted(root)]
        self._declare_free()
        if self.context.missing:
            raise RangeNotKnown("no domain is given for {}", self.context.missing)
        components, ends = top.lowered(given)
        outputs = self._outputs(top, ends)
        written = self._written(outputs)
        if written:
            last = [Assign(var, value) for var, value in written]
            components = (*components, Block("Outports", last, text="The outputs of the model."))
        components = (*components, *top.delays())
        free = FreeInputs(self.table.free)
        components = free.components(components)
        self.inputs |= {name: var for name, (var, _) in free.made.items()}
        self._refuse_idle()
        self._initialize()
        shown = {
            name: next((v for v, _ in written if v.name == name), expr) for name, expr in outputs.items()
        }
        notes, remarks = tuple(self.table.notes.values()), tuple(self.table.remarks.values())
        named = [*self.model.free.values(), *(name for name, _ in free_outputs(self.model))]
        freely = [free_note(name) for name in named]
        step_ms, said = _milliseconds(self.step)

        def system_of(*parts: Component) -> System:
            return in_order(
                plain_name(self.model.name), *parts,
                text=f"The model {self.model.name}, read from {self._file}.",
                notes=[*(Note(one, brief="rounded data") for one in notes), *freely, *remarks, *said],
                tick_ms=step_ms,
            )  # fmt: skip

        system = system_of(*components)
        if unwritten := self._unwritten(system, shown):
            system = system_of(*components, unwritten)
        taken = frozenset(self.table.declared_names)
        data, views = self.context.data, self.context.views
        return LoweredModel(
            self.model, system, self.inputs, shown, data, views, (*notes, *freely, *remarks), taken,
            self._computes, {name: of for name, (_, of) in free.made.items()},
        )  # fmt: skip

    @property
    def _computes(self) -> bool:
        given = (one.sort for name, one in self.table.given.items() if name not in self.inputs)
        return bool(self.table.ranges) or any(isinstance(one, Num) and one.resolution != 1 for one in given)

    def _input(self, port: DrawnBlock, top: SystemWriter) -> Symbolic:
        kind = self.table.kinds.kind(port.parameters.get("OutDataTypeStr", "Inherit"))
        rows, columns = sizes(port.parameters.get("PortDimensions", "-1"))
        if not kind:
            seen = top.kind_wanted(port)
            kind, rows, columns = seen if seen else ("double", rows, columns)
        first = self.table.kinds.first_value(kind, rows, columns)
        made = [
            self.context.input(name, one.kind, f"input of {self.model.name}, {one.kind}")
            for name, one in leaves(first, port.shown)
        ]
        return filled(first, iter(made))

    def _declare_free(self) -> None:
        """Inputs for what is free, before anything asks for their domains."""
        for name, written in free_outputs(self.model):
            self.context.input(name, self.table.kinds.kind(written), f"free input of {self.model.name}")
        self.table.free, self.table.free_texts = {}, self.model.free
        for name in self.model.free.values():
            self.context.input(name, "double", f"free input of {self.model.name}")
            self.table.free[name] = self.context.inputs[name]

    def _refuse_idle(self) -> None:
        idle = [name for name in self.model.free.values() if name not in self.table.free_met]
        if idle:
            raise NotLowered(
                f"free: nothing that is executed computes {idle[0]}; write the path of a block, the name of "
                "a function, or an expression as a chart has it"
            )

    def _outputs(self, top: SystemWriter, ends: Sequence[Symbolic]) -> dict[str, Expr]:
        return {
            name: one.expr
            for port, value in zip(top.ends, ends, strict=True)
            for name, one in leaves(value, port.block.shown)
        }

    def _written(self, outputs: Mapping[str, Expr]) -> list[tuple[Var, Expr]]:
        """The outputs that are no variables of their names already, with the variables that they get."""
        found = []
        for name, expr in outputs.items():
            if isinstance(expr, Var) and expr.name == name and name not in self.context.memories:
                continue
            domain = domain_of(expr)
            taken = name in self.inputs or name in self.context.data or name in self.context.memories
            first = 0 if 0 in domain else domain.low
            var = Var(f"{name} out" if taken else name, domain, first, f"output of {self.model.name}")
            found.append((var, in_steps(expr, var)))
        return found

    def _unwritten(self, system: System, shown: Mapping[str, Expr]) -> Block | None:
        """The data that nothing writes: they keep their first values, and are no inputs."""
        given = {one.name for one in self.inputs.values() if isinstance(one, Var)}
        places = {var.name for chart in system.charts for var in (chart.entered, *chart.locations)}
        known = [one for one in (*self.context.data.values(), *shown.values()) if isinstance(one, Var)]
        every = {one.name: one for one in (*system.inputs.values(), *known)}
        others = given | system.written.keys() | places | self.context.temporaries
        keep = [Assign(var, var) for name, var in every.items() if name not in others]
        return Block("Unwritten", keep, text="Data that nothing writes.") if keep else None

    def _initialize(self) -> None:
        """Charts that are entered at initialization: their data begin as that leaves them."""
        every: dict[str, int] = {}
        for writer in self.context.starts:
            statements = writer.written()
            early = [one.name for one in _variables(statements) if one.name in self.table.free]
            if early:
                raise NotLowered(f"{early[0]} is computed before the first step, where nothing is free")
            at = {one.name: self._at_rest(one) for one in _variables(statements)} | every
            before = dict(at)
            run(statements, at)
            every |= {n: raw for n, raw in at.items() if n not in writer.temporaries and raw != before[n]}
        if every != self.table.starting:
            self.table.starting = every
            self.table.changed.add("initialization")

    def _at_rest(self, var: Var) -> int:
        """The value of a variable before initialization."""
        return self.table.at_rest.get(var.name, 0 if var.name in self.table.starting else var.init)


def _variables(statements: Program) -> Iterator[Var]:
    """Those that some statements write or read."""
    for one in each_action(statements):
        if isinstance(one, Assign):
            yield one.var
    for formula in expressions(statements):
        yield from variables(formula).values()


def _milliseconds(step: str) -> tuple[int, list[str]]:
    """The length of a step in whole milliseconds, and a note where it is none."""
    try:
        exact = Fraction(step.strip()) * 1000
    except (ValueError, ZeroDivisionError):
        return 1, ["The length of a step is not in the file; times are told in steps of 1 ms."]
    if exact.denominator == 1 and exact >= 1:
        return int(exact), []
    said = f"A step lasts {float(exact):g} ms; times are told as if it were whole milliseconds."
    return max(1, round(exact)), [said]


__all__ = ["LoweringAttempt"]
