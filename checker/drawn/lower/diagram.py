"""A whole model as a system: its charts and blocks in their order of execution, its inputs free."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction

from rovercheck.checker.drawn.faults import ChartFault
from rovercheck.checker.drawn.grammar.errors import GrammarError
from rovercheck.checker.drawn.grammar.expressions import parse_expression
from rovercheck.checker.drawn.grammar.syntax import ActionLanguage, Name
from rovercheck.checker.drawn.lower.blocks import BLOCKS, BlockTypes, either
from rovercheck.checker.drawn.lower.conversions import IntegerRules, as_number, each_converted
from rovercheck.checker.drawn.lower.data import DataTable
from rovercheck.checker.drawn.lower.kinds import KindTable, is_member, sizes
from rovercheck.checker.drawn.lower.machine import ChartWriter
from rovercheck.checker.drawn.lower.names import Scope
from rovercheck.checker.drawn.lower.program import MOST_STATEMENTS, ProgramWriter, TooManyStatements
from rovercheck.checker.drawn.lower.symbols import (
    INTEGERS,
    LOGICAL,
    UNTYPED,
    NotLowered,
    Symbolic,
    SymbolicScalar,
    filled,
    flat,
    folded,
    leaves,
    matrix,
    number,
    single_of,
    size_of,
    truth,
)
from rovercheck.checker.drawn.lower.view import ChartView, plain_name
from rovercheck.checker.drawn.parsed import ParsedChart, StateNode, parsed_chart
from rovercheck.checker.drawn.records import (
    DrawnBlock,
    DrawnChart,
    DrawnContent,
    DrawnData,
    DrawnModel,
    DrawnSystem,
)
from rovercheck.checker.drawn.wiring import CONTROL, DELAYS, Port, Wiring, number_of, wired
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.chart import Block, Component, Enabled, parts
from rovercheck.spec_model.lang.domain import Domain, boolean
from rovercheck.spec_model.lang.evaluate import run
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Const, Expr, Var, all_of, any_of
from rovercheck.spec_model.lang.programmed import StepProgram
from rovercheck.spec_model.lang.system import Note, System, in_order
from rovercheck.spec_model.lang.walk import variables

ATTEMPTS = 24
"""Times that a model is lowered until nothing new is learned of its data."""
MANY_STATEMENTS = 5_000
"""A step with more is shortened first, if that is possible."""


@dataclass(frozen=True)
class LoweredModel:
    """A model as a system.

    ``inputs`` and ``outputs`` are formulas by their flat names, as ``probe.level``; ``data`` those of charts,
    as ``Oven.left``; ``views`` the charts as they are drawn, by the name of the chart in the system.
    """

    model: DrawnModel
    system: System
    inputs: Mapping[str, Expr]
    outputs: Mapping[str, Expr]
    data: Mapping[str, Expr]
    views: Mapping[str, ChartView]
    notes: Sequence[str] = ()
    taken: frozenset[str] = frozenset()
    """The names of all data that a domain may be given to, beside inputs."""
    real: bool = False
    """Whether it computes with real numbers, which are exact fractions here."""


def lowered_model(
    model: DrawnModel, file: str, domains: Mapping[str, Domain] | None = None, step: str = ""
) -> LoweredModel:
    """The system of a model.

    ``domains`` are those of inputs and data, by name.  Raises ``NotLowered`` for what has no formula, with
    its place, and for a datum whose range is not given.
    """
    try:
        return _lowered(model, file, domains or {}, step)
    except RecursionError:
        raise NotLowered("states, blocks or expressions are nested too deeply") from None


def _lowered(model: DrawnModel, file: str, domains: Mapping[str, Domain], step: str) -> LoweredModel:
    charts = {one.path: parsed_chart(one) for one in model.charts}
    for parsed in charts.values():
        if parsed.notes:
            raise NotLowered(str(parsed.notes[0]))
    table = DataTable(KindTable.of(model), domains)
    most = MANY_STATEMENTS
    for _ in range(ATTEMPTS):
        table.begin()
        try:
            found = _Attempt(model, file, table, charts, step or model.step, most).lowered()
        except TooManyStatements as error:
            if not table.shortened():
                if most == MOST_STATEMENTS:
                    raise NotLowered(str(error)) from error
                most = MOST_STATEMENTS
            continue
        _refuse_too_fine(table)
        if not table.changed:
            return found
    if table.endless:
        raise RangeNotKnown("the range of {} does not follow from what is assigned", table.endless)
    raise NotLowered(f"{', '.join(sorted(table.changed)[:5])} is of another type in each attempt")


def _refuse_too_fine(table: DataTable) -> None:
    fine = table.too_fine()
    if fine:
        raise RangeNotKnown("{} is computed with more and more digits, or without end", fine)


class RangeNotKnown(NotLowered):
    """The values of some data do not follow from the file: a person must give their domains."""

    def __init__(self, said: str, names: Sequence[str]) -> None:
        shown = ", ".join(names[:5]) + (f" and {len(names) - 5} more" if len(names) > 5 else "")
        super().__init__(
            f"{said.format(shown)}. `rovercheck import MODEL.slx --propose-domains` writes a file to fill in"
        )
        self.names = tuple(names)


@dataclass
class _BlockNode:
    """A block with what feeds it, and what it gives."""

    block: DrawnBlock
    inputs: list[Port | None]
    control: str = ""
    fed: Port | None = None
    outputs: list[Symbolic] = field(default_factory=list)
    memory: Symbolic | None = None


class _Attempt:
    """One attempt to lower a model with what is known of its data."""

    def __init__(
        self, model: DrawnModel, file: str, table: DataTable, charts: Mapping[str, ParsedChart], step: str,
        most: int,
    ) -> None:  # fmt: skip
        self.most = most
        self.model, self.table, self._charts, self.step, self._file = model, table, charts, step, file
        self.types = BlockTypes(table.kinds, self.value_of)
        self.named = {one.name: one.value for one in model.parameters}
        self.inputs: dict[str, Expr] = {}
        self.data: dict[str, Expr] = {}
        self.views: dict[str, ChartView] = {}
        self.starts: list[tuple[ChartWriter, ProgramWriter]] = []
        self.temporaries: set[str] = set()
        self.memories: dict[str, Var] = {}
        """What delays remember, by name: that changes when all else is done."""
        self._names = _chart_names(model.charts)
        self._taken = _shared_names(model)
        self._block_names: dict[str, str] = {}
        self._data_names = {one.name for chart in model.charts for one in chart.content.data}
        self._data_names |= {one.name for one in model.system.blocks if one.kind in ("Inport", "Outport")}
        self._missing: list[str] = []

    def lowered(self) -> LoweredModel:
        top = _SystemLowering(self.model.system, self, "")
        root = {number_of(one): one for one in self.model.system.blocks if one.kind == "Inport"}
        given = [self._input(root[n], top) for n in sorted(root)]
        if self._missing:
            raise RangeNotKnown("no domain is given for {}", self._missing)
        components, ends = top.lowered(given)
        outputs = self._outputs(top, ends)
        last = [Assign(var, value) for var, value in self._written(outputs)]
        if last:
            components = (*components, Block("Outports", last, text="The outputs of the model."))
        components = (*components, *top.delays())
        self._initialize()
        shown = {
            name: next((v for v, _ in self._ports if v.name == name), expr) for name, expr in outputs.items()
        }
        notes = tuple(self.table.notes.values())
        step_ms, said = _milliseconds(self.step)

        def system_of(*parts: Component) -> System:
            return in_order(
                plain_name(self.model.name), *parts,
                text=f"The model {self.model.name}, read from {self._file}.",
                notes=[Note(one, brief="rounded data") for one in notes] + said, tick_ms=step_ms,
            )  # fmt: skip

        system = system_of(*components)
        if unwritten := self._unwritten(system, shown):
            system = system_of(*components, unwritten)
        taken = frozenset(self.table.declared_names)
        return LoweredModel(
            self.model, system, self.inputs, shown, self.data, self.views, notes, taken, self._computes
        )

    @property
    def _computes(self) -> bool:
        return bool(self.table.ranges) or bool(self.table.given.keys() - self.inputs.keys())

    # --- ports ---------------------------------------------------------------------------------------------

    def _input(self, port: DrawnBlock, top: "_SystemLowering") -> Symbolic:
        kind = self.table.kinds.kind(port.parameters.get("OutDataTypeStr", "Inherit"))
        rows, columns = sizes(port.parameters.get("PortDimensions", "-1"))
        if not kind:
            seen = top.kind_wanted(port)
            kind, rows, columns = seen if seen else ("double", rows, columns)
        first = self.table.kinds.first_value(kind, rows, columns)
        made = []
        for name, one in leaves(first, port.name):
            domain = self.table.given.get(name) or self.table.kinds.domain(one.kind)
            if domain is None:
                self._missing.append(name)
                domain = boolean
            raw = 0 if 0 in domain else domain.low
            var = Var(name, domain, raw, f"input of {self.model.name}, {one.kind}")
            self.inputs[name] = var
            made.append(SymbolicScalar(one.kind, var))
        return filled(first, iter(made))

    def _outputs(self, top: "_SystemLowering", ends: Sequence[Symbolic]) -> dict[str, Expr]:
        return {
            name: one.expr
            for port, value in zip(top.ends, ends, strict=True)
            for name, one in leaves(value, port.block.name)
        }

    def _written(self, outputs: Mapping[str, Expr]) -> Iterator[tuple[Var, Expr]]:
        """The outputs that are no variables of their names already."""
        self._ports: list[tuple[Var, Expr]] = []
        for name, expr in outputs.items():
            if isinstance(expr, Var) and expr.name == name and name not in self.memories:
                continue
            from rovercheck.checker.drawn.lower.program import domain_of, in_steps

            domain = domain_of(expr)
            taken = name in self.inputs or name in self.data or name in self.memories
            var = Var(f"{name} out" if taken else name, domain, domain.low, f"output of {self.model.name}")
            self._ports.append((var, in_steps(expr, var)))
        yield from self._ports

    # --- data that nothing writes ------------------------------------------------------------------------

    def _unwritten(self, system: System, shown: Mapping[str, Expr]) -> Block | None:
        """The data that nothing writes: they keep their first values, and are no inputs."""
        given = {one.name for one in self.inputs.values() if isinstance(one, Var)}
        places = {var.name for chart in system.charts for var in (chart.entered, *chart.locations)}
        known = [one for one in (*self.data.values(), *shown.values()) if isinstance(one, Var)]
        every = {one.name: one for one in (*system.inputs.values(), *known)}
        others = given | system.written.keys() | places | self.temporaries
        keep = [Assign(var, var) for name, var in every.items() if name not in others]
        return Block("Unwritten", keep, text="Data that nothing writes.") if keep else None

    # --- what happens before the first step ----------------------------------------------------------------

    def _initialize(self) -> None:
        """Charts that are entered at initialization: their data begin as that leaves them."""
        every: dict[str, int] = {}
        for _, writer in self.starts:
            statements = writer.written()
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

    # --- what blocks need ----------------------------------------------------------------------------------

    def value_of(self, text: str) -> Symbolic:
        """The value of a parameter.  Raises ``NotLowered``."""
        try:
            tree = parse_expression(text, ActionLanguage.MATLAB)
            if isinstance(tree, Name) and tree.name in self.named:
                tree = parse_expression(self.named[tree.name], ActionLanguage.MATLAB)
        except GrammarError as error:
            raise NotLowered(f"the parameter {text!r}: {error}") from error
        bare = ParsedChart(
            DrawnChart("", "chart", "MATLAB", _NOTHING, ""),
            ActionLanguage.MATLAB,
            StateNode(0, "", "", None),
            {},
            {},
            (),
        )
        writer = ProgramWriter("parameter")
        view = ChartView(bare, "parameter", self._file)
        found = ChartWriter(bare, view, self.table, writer, self.step, self.named, lambda one, node: one.name)
        return found.value(tree, Scope(bare.root, IntegerRules()))

    def chart(self, path: str) -> ParsedChart:
        """The chart of a block."""
        if path not in self._charts:
            raise NotLowered(f"the block {path} has no chart in the file")
        return self._charts[path]

    def name(self, chart: DrawnChart) -> str:
        """The name of a chart in the system."""
        return self._names[chart.path]

    def name_of_block(self, block: DrawnBlock, short: str) -> str:
        """The name of what a block remembers: the short one where nothing else in the model has it."""
        if block.id not in self._block_names:
            others = {*self._block_names.values(), *self._data_names, *self._names.values()}
            named = (short, plain_name(block.path), plain_name(f"{block.path} {block.id}"))
            self._block_names[block.id] = next(one for one in named if one not in others)
        return self._block_names[block.id]

    def name_of(self, chart: DrawnChart, one: DrawnData, node: StateNode) -> str:
        """The name of a datum of a chart: its own, where nothing else in the model has it."""
        if node.parent is None and one.name not in self._taken:
            return one.name
        inside = node.path.removeprefix(chart.path).strip("/").replace("/", ".")
        return ".".join(filter(None, (self.name(chart), inside, one.name)))


class _SystemLowering:
    """The blocks of one system."""

    def __init__(self, system: DrawnSystem, attempt: _Attempt, path: str) -> None:
        self.attempt, self._path = attempt, path
        try:
            self._wiring: Wiring = wired(system)
        except ChartFault as fault:
            raise NotLowered(str(fault)) from fault
        self.nodes = [self._node(block) for block in self._wiring.order]
        self._by_id = {node.block.id: node for node in self.nodes}
        self.remembered: list[tuple[str, Symbolic, Symbolic]] = []
        """The memories of delays here and in subsystems that run in every step, and what they get."""
        found = [node for node in self.nodes if node.block.kind == "Outport"]
        self.ends = sorted(found, key=lambda node: number_of(node.block))

    def _node(self, block: DrawnBlock) -> _BlockNode:
        feeds = self._wiring.feeds
        ports = [int(port) for target, port in feeds if target == block.id and port.isdigit()]
        inputs = [feeds.get((block.id, str(n))) for n in range(1, max(ports, default=0) + 1)]
        node = _BlockNode(block, inputs)
        control = [port for target, port in feeds if target == block.id and not port.isdigit()]
        if control:
            node.control, node.fed = control[0], feeds[block.id, control[0]]
        rate = block.parameters.get("SampleTime", "-1").strip()
        if block.chart:
            chart = self.attempt.chart(block.chart).drawn
            rate = chart.sample_time.strip() or "-1" if chart.update == "discrete" else rate
        if rate not in ("-1", "0", "inf") and not _same(rate, self.attempt.step):
            raise NotLowered(
                f"the block {block.path} runs every {rate} s, and the model every {self.attempt.step} s: give "
                "them one rate"
            )
        return node

    def kind_wanted(self, port: DrawnBlock) -> tuple[str, int, int] | None:
        """The type and size of the chart's datum that an Inport feeds."""
        for (target, to), (source, _) in self._wiring.feeds.items():
            node = self._by_id.get(target)
            if source != port.id or node is None or not to.isdigit() or not node.block.chart:
                continue
            data = self.attempt.chart(node.block.chart).root.data.values()
            wanted = [one for one in data if one.scope == "input"][int(to) - 1 :][:1]
            for one in wanted:
                if kind := self.attempt.table.kinds.kind(one.type):
                    return kind, *sizes(one.size)
        return None

    # --- in order ------------------------------------------------------------------------------------------

    def lowered(self, given: Sequence[Symbolic]) -> tuple[tuple[Component, ...], list[Symbolic]]:
        """The components in order, and the outputs."""
        components: list[Component] = []
        for node in self.nodes:
            if node.block.kind in DELAYS:
                first = self.attempt.value_of(node.block.parameters.get("InitialCondition", "0"))
                node.memory = self._remembered(node, first)
                leaf_vars = (one.expr for _, one in leaves(node.memory, ""))
                self.attempt.memories |= {var.name: var for var in leaf_vars if isinstance(var, Var)}
        for node in self.nodes:
            try:
                components += self._component(node, given)
            except NotLowered as error:
                where = " ".join(node.block.path.split())
                raise NotLowered(
                    str(error) if str(error).startswith(where) else f"{where}: {error}"
                ) from error
        self._remember()
        return tuple(components), [(self._values(node) or [number("double", 0)])[0] for node in self.ends]

    def _remembered(self, node: _BlockNode, first: Symbolic) -> Symbolic:
        """The memory of a delay, in the type that was seen to come in."""
        name = self._named(node.block)
        seen = self.attempt.table.kind_of(name)
        kind, rows, columns = seen or (first.kind, *size_of(first))
        made = each_converted(first, kind, IntegerRules(), self.attempt.table.kinds)
        if size_of(made) == (1, 1) != (rows, columns):
            made = matrix([single_of(made)] * (rows * columns), rows, columns)
        return self.attempt.table.declared(name, made, doc=f"what {node.block.path} gives")

    def _named(self, block: DrawnBlock) -> str:
        return self.attempt.name_of_block(block, plain_name(f"{self._path}_{block.name}"))

    def _remember(self) -> None:
        for node in self.nodes:
            if node.memory is not None:
                [value] = self._values(node) or [number("double", 0)]
                name = self._named(node.block)
                self.attempt.table.saw(
                    name, "double" if value.kind == UNTYPED else value.kind, *size_of(value)
                )
                self.remembered.append((name, node.memory, value))

    def delays(self) -> list[Component]:
        """All delays get their new values together, once nothing reads the old ones any more."""
        table, pairs = self.attempt.table, list[tuple[SymbolicScalar, SymbolicScalar]]()
        writer = ProgramWriter(plain_name(f"{self._path}_Delays".strip("_")))
        for name, memory, value in self.remembered:
            for (_, cell), (_, new) in zip(leaves(memory, name), leaves(value, name), strict=True):
                made = single_of(each_converted(new, cell.kind, IntegerRules(), table.kinds))
                reads_other = any(one in self.attempt.memories for one in variables(made.expr))
                pairs.append((cell, writer.kept("next", made) if reads_other else made))
        for cell, new in pairs:
            table.write(writer, cell, new.expr)
        if not pairs:
            return []
        statements = writer.written()
        temporaries = tuple(writer.temporaries.values())
        return [Block(writer.name, statements, text="What delays remember.", temporaries=temporaries)]

    def _values(self, node: _BlockNode) -> list[Symbolic]:
        return [number("double", 0) if port is None else self._value(port) for port in node.inputs]

    def _value(self, port: Port) -> Symbolic:
        node = self._by_id.get(port[0])
        if node is None:
            raise NotLowered(f"the block {port[0]}, which feeds it, is not there")
        if node.memory is not None:
            return node.memory
        if not 0 < port[1] <= len(node.outputs):
            raise NotLowered(f"output {port[1]} of {node.block.path} is not there")
        return node.outputs[port[1] - 1]

    def _component(self, node: _BlockNode, given: Sequence[Symbolic]) -> list[Component]:
        block = node.block
        if block.kind == "Inport":
            node.outputs = [given[number_of(block) - 1]]
        elif node.memory is not None or block.kind == "Outport" or block.kind in CONTROL:
            return []
        elif block.chart:
            return self._chart(node)
        elif block.kind == "SubSystem" and block.system is not None:
            return self._subsystem(node, block.system)
        elif block.kind in BLOCKS:
            try:
                node.outputs = BLOCKS[block.kind](block, self._values(node), self.attempt.types)
            except (IndexError, KeyError, ValueError) as error:  # as a Gain without an input
                raise NotLowered("its inputs and parameters do not fit each other") from error
        else:
            raise NotLowered(f"{block.kind} blocks are not known here")
        return []

    # --- charts --------------------------------------------------------------------------------------------

    def _chart(self, node: _BlockNode) -> list[Component]:
        attempt, chart = self.attempt, self.attempt.chart(node.block.chart)
        name = attempt.name(chart.drawn)
        if chart.drawn.activity_output:
            raise NotLowered("the output of the active child: give it a datum that entry actions set")
        view = ChartView(chart, name, attempt._file, attempt.table.starting)
        writer = ProgramWriter(name, attempt.most)
        made = self._writer(chart, view, writer)
        self._feed(made, chart, self._values(node))
        if chart.drawn.kind == "MATLAB function":
            made.run_block()
            statements = writer.written()
            component: Component = Block(
                name, statements, text=f"The MATLAB function {chart.drawn.path}.",
                temporaries=tuple(writer.temporaries.values()),
            )  # fmt: skip
        else:
            events = self._events(node, chart, writer)
            made.step(events)
            statements = writer.written()
            program = StepProgram(
                statements, tuple(writer.temporaries.values()), attempt.table.starting, dict(view.fired)
            )
            component = view.made(program)
            attempt.views[name] = view
            if chart.drawn.at_initialization:
                start = ProgramWriter(name, attempt.most)
                first = self._writer(chart, view, start)
                at_rest = [attempt.table.kinds.first_value(v.kind, *size_of(v)) for v in self._values(node)]
                self._feed(first, chart, at_rest)
                first.initialize()
                attempt.starts.append((first, start))
        attempt.temporaries |= writer.temporaries.keys()
        for one in chart.root.data.values():
            cells = made.cells[one.ssid]
            for leaf, cell in leaves(cells, f"{name}.{one.name}"):
                at = cell.expr.name if isinstance(cell.expr, Var) else ""
                if (
                    at not in writer.temporaries and at not in attempt.memories
                ):  # else it is another one later
                    attempt.data[leaf] = cell.expr
        node.outputs = [made.cells[one.ssid] for one in chart.root.data.values() if one.scope == "output"]
        if events_ := (self._input_events(chart) if chart.drawn.kind != "MATLAB function" else []):
            del events_
            by = self._any_event(node, chart)
            edges = self._edges(node)
            return [Enabled(by, component), *edges]
        return [component]

    def _writer(self, chart: ParsedChart, view: ChartView, writer: ProgramWriter) -> ChartWriter:
        attempt = self.attempt
        return ChartWriter(
            chart, view, attempt.table, writer, attempt.step, attempt.named,
            lambda one, node: attempt.name_of(chart.drawn, one, node),
        )  # fmt: skip

    def _feed(self, made: ChartWriter, chart: ParsedChart, values: Sequence[Symbolic]) -> None:
        """The inputs of a chart, in the types of its data."""
        kinds, data = self.attempt.table.kinds, chart.root.data.values()
        for one, value in zip((d for d in data if d.scope == "input"), values, strict=False):
            kind = kinds.kind(one.type)
            plain = kind and not kind.startswith("Bus: ")
            fitted = each_converted(value, kind, made.rules, kinds) if plain else value
            scalars = [
                made.writer.kept(one.name, s) if not isinstance(s.expr, Var) else s
                for _, s in leaves(fitted, "")
            ]
            made.cells[one.ssid] = filled(fitted, iter(scalars))
        for one in data:
            if one.scope == "input" and one.ssid not in made.cells:
                made.cells[one.ssid] = kinds.first_value(kinds.kind(one.type) or "double", *sizes(one.size))

    # --- input events, and subsystems that are controlled --------------------------------------------------

    @staticmethod
    def _input_events(chart: ParsedChart) -> list[tuple[str, str]]:
        return [(one.name, one.trigger) for one in chart.root.events.values() if one.scope == "input"]

    def _events(
        self, node: _BlockNode, chart: ParsedChart, writer: ProgramWriter
    ) -> list[tuple[str, Expr]] | None:
        every = self._input_events(chart)
        if not every:
            return None
        return list(
            zip((name for name, _ in every), self._edge_conditions(node, [t for _, t in every]), strict=False)
        )

    def _any_event(self, node: _BlockNode, chart: ParsedChart) -> Expr:
        every = self._input_events(chart)
        return folded(any_of(*self._edge_conditions(node, [trigger for _, trigger in every])))

    def _control(self, node: _BlockNode) -> list[Expr]:
        return [] if node.fed is None else [as_number(one) for one in flat(self._value(node.fed))]

    def _before(self, node: _BlockNode) -> list[tuple[Var, Var, Var]]:
        """Of each signal of a trigger: whether it was above 0, whether below, and whether it was seen at all."""
        name = self._named(node.block)
        made = []
        for n, _ in enumerate(self._control(node)):
            made.append(
                tuple(
                    Var(
                        f"{name}.trigger{n + 1}.{what}", boolean, 0, f"the trigger of {node.block.path}", True
                    )
                    for what in ("above", "below", "seen")
                )
            )
        return made  # type: ignore[return-value]

    def _edge_conditions(self, node: _BlockNode, kinds: Sequence[str]) -> list[Expr]:
        """Whether each signal of a trigger rises or falls through 0; in its first step it does neither."""
        found = []
        for kind, now, (above, below, seen) in zip(
            kinds, self._control(node), self._before(node), strict=False
        ):
            if kind in ("function call", "function-call"):
                raise NotLowered("an event that is a function call: give the chart a rising edge")
            rises = folded(all_of(seen, ~above, folded(now > 0)))
            falls = folded(all_of(seen, above, folded(now <= 0)))
            found.append({"rising": rises, "falling": falls}.get(kind, folded(rises | falls)))
            del below
        return found

    def _edges(self, node: _BlockNode) -> list[Component]:
        """What remembers the signals of a trigger."""
        do = []
        for now, (above, _, seen) in zip(self._control(node), self._before(node), strict=True):
            do += [Assign(above, folded(now > 0)), Assign(seen, TRUE)]
        name = f"{self._named(node.block)}_trigger"
        return [Block(name, do, text=f"The trigger of {node.block.path}.")]

    def _subsystem(self, node: _BlockNode, system: DrawnSystem) -> list[Component]:
        block, attempt = node.block, self.attempt
        inner = _SystemLowering(system, attempt, f"{self._path}_{block.name}".strip("_"))
        components, ends = inner.lowered(self._values(node))
        if not node.control:
            node.outputs = list(ends)
            self.remembered += inner.remembered
            return list(components)
        for one in system.blocks:
            for name, kind in (("StatesWhenEnabling", "EnablePort"), ("OutputWhenDisabled", "Outport")):
                if one.kind == kind and one.parameters.get(name, "held") == "reset":
                    raise NotLowered(f"{name} = reset: held is known here")
        if node.control == "enable":
            by, after = folded(any_of(*(folded(one > 0) for one in self._control(node)))), list[Component]()
        elif node.control == "trigger":
            ports = [one for one in system.blocks if one.kind == "TriggerPort"]
            kind = ports[0].parameters.get("TriggerType", "rising") if ports else "rising"
            count = len(self._control(node))
            by, after = folded(any_of(*self._edge_conditions(node, [kind] * count))), self._edges(node)
        else:
            raise NotLowered(f"a subsystem that is controlled by {node.control}")
        held, outputs = self._held(inner, ends, components)
        node.outputs = outputs
        inside = (*components, *held, *inner.delays())
        return [*([Enabled(by, *inside, name=plain_name(block.name))] if inside else []), *after]

    def _held(
        self, inner: "_SystemLowering", ends: Sequence[Symbolic], components: Sequence[Component]
    ) -> tuple[list[Component], list[Symbolic]]:
        """The outputs of a subsystem that does not run in every step: data that stay as they are."""
        table, outputs, held = self.attempt.table, list[Symbolic](), list[Component]()
        written = {name for part in parts(components) for name in part.written}
        cells_ = (one.expr for _, memory, _ in inner.remembered for _, one in leaves(memory, ""))
        memories = {var.name: var for var in cells_ if isinstance(var, Var)}
        for end, value in zip(inner.ends, ends, strict=True):
            text = end.block.parameters.get("InitialOutput", "[]").strip()
            own = (isinstance(one.expr, Var) and one.expr.name in written for _, one in leaves(value, ""))
            if text == "[]" and all(own):
                outputs.append(value)
                continue
            name = inner._named(end.block)
            first = table.kinds.first_value(value.kind, *size_of(value))
            remembered = [memories.get(str(one.expr)) for _, one in leaves(value, "")]
            if text != "[]":
                first = each_converted(self.attempt.value_of(text), value.kind, IntegerRules(), table.kinds)
            elif all(one is not None for one in remembered):
                begun = (Const(var.init, var.sort) for var in remembered if var is not None)
                kinds = (one.kind for _, one in leaves(value, ""))
                first = filled(value, map(SymbolicScalar, kinds, begun))
            cells = table.declared(name, first, doc=f"the output {end.block.path}")
            writer = ProgramWriter(name)
            for (_, cell), (_, new) in zip(leaves(cells, name), leaves(value, name), strict=True):
                table.write(writer, cell, new.expr)
            held.append(Block(name, writer.written(), text=f"The output {end.block.path}."))
            outputs.append(cells)
        return held, outputs


_NOTHING = DrawnContent()


def _chart_names(charts: Sequence[DrawnChart]) -> dict[str, str]:
    """A name for each chart: the last one of its path where that is enough."""
    last = [plain_name(one.name) for one in charts]
    return {
        one.path: name if last.count(name) == 1 else plain_name(one.path.replace("/", "_"))
        for one, name in zip(charts, last, strict=True)
    }


def _shared_names(model: DrawnModel) -> set[str]:
    """Names that are no name of one datum alone: of several data, of root inputs, or of other outputs."""
    seen: list[str] = [d.name for chart in model.charts for d in chart.content.data if d.scope != "input"]
    ports = [one.name for one in model.system.blocks if one.kind == "Inport"]
    return {name for name in seen if seen.count(name) > 1} | set(ports)


def _variables(statements: Sequence[object]) -> Iterator[Var]:
    from rovercheck.spec_model.lang.action import each_action, expressions

    for one in each_action(statements):  # type: ignore[arg-type]
        if isinstance(one, Assign):
            yield one.var
    for formula in expressions(statements):  # type: ignore[arg-type]
        yield from variables(formula).values()


def _milliseconds(step: str) -> tuple[int, list[Note]]:
    """The length of a step in whole milliseconds, and a note where it is none."""
    try:
        exact = Fraction(step.strip()) * 1000
    except (ValueError, ZeroDivisionError):
        return 1, [
            Note("The length of a step is not in the file; times are told in steps of 1 ms.", brief="")
        ]
    if exact.denominator == 1 and exact >= 1:
        return int(exact), []
    said = f"A step lasts {float(exact):g} ms; times are told as if it were whole milliseconds."
    return max(1, round(exact)), [Note(said, brief="")]


def _same(one: str, other: str) -> bool:
    try:
        return Fraction(one) == Fraction(other)
    except (ValueError, ZeroDivisionError):
        return False


__all__ = [
    "FALSE",
    "INTEGERS",
    "LOGICAL",
    "Const",
    "LoweredModel",
    "RangeNotKnown",
    "either",
    "is_member",
    "lowered_model",
    "replace",
    "truth",
]
