"""What all systems of a model share while it is lowered: its types, charts and names, and what they give."""

from collections.abc import Mapping

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.grammar.errors import GrammarError
from rovercheck.checker.drawn.grammar.expressions import parse_expression
from rovercheck.checker.drawn.grammar.syntax import ActionLanguage
from rovercheck.checker.drawn.lower.blocks import BlockTypes
from rovercheck.checker.drawn.lower.conversions import IntegerRules
from rovercheck.checker.drawn.lower.data import DataTable
from rovercheck.checker.drawn.lower.machine import ChartWriter
from rovercheck.checker.drawn.lower.model_names import ModelNames
from rovercheck.checker.drawn.lower.names import TextScope
from rovercheck.checker.drawn.lower.program import ProgramWriter
from rovercheck.checker.drawn.lower.stores import StoreVariables
from rovercheck.checker.drawn.lower.symbols import NotLowered, Symbolic, SymbolicScalar
from rovercheck.checker.drawn.lower.view import ChartView
from rovercheck.checker.drawn.parameters import expanded, values_of
from rovercheck.checker.drawn.parsed import ParsedChart, StateNode
from rovercheck.checker.drawn.records import DrawnChart, DrawnContent, DrawnModel
from rovercheck.checker.drawn.stores import data_stores
from rovercheck.spec_model.lang.domain import boolean
from rovercheck.spec_model.lang.expr import Expr, Var


class LoweringContext:
    """One attempt to lower a model, with what is known of its data.

    ``step`` is the length of a step in seconds, as written; ``most`` are the statements of a chart's step.
    """

    def __init__(
        self, model: DrawnModel, file: str, table: DataTable, charts: Mapping[str, ParsedChart], step: str,
        most: int,
    ) -> None:  # fmt: skip
        self.file, self.table, self._charts = file, table, charts
        self.step, self.most = step, most
        self.names = ModelNames(model)
        self.types = BlockTypes(table.kinds, self.value_of)
        self.named = values_of(model)
        self.data: dict[str, Expr] = {}
        self.views: dict[str, ChartView] = {}
        self.starts: list[ProgramWriter] = []
        """What charts do that are entered when they are initialized."""
        self.temporaries: set[str] = set()
        try:
            self.stores = StoreVariables(self, data_stores(model.system, charts))
        except DrawnFault as fault:
            raise NotLowered(str(fault)) from fault
        self.memories: dict[str, Var] = {}
        """What delays remember, by name: that changes when all else is done."""
        self.inputs: dict[str, Var] = {}
        self.missing: list[str] = []
        """The inputs of which no domain is known."""

    def input(self, name: str, kind: str, doc: str) -> SymbolicScalar:
        """An input with the domain that is given, or that of its type."""
        domain = self.table.given.get(name) or self.table.kinds.domain(kind)
        if domain is None:
            self.missing.append(name)
            domain = boolean
        var = Var(name, domain, 0 if 0 in domain else domain.low, doc)
        self.inputs[name] = var
        return SymbolicScalar(kind, var)

    def value_of(self, text: str) -> Symbolic:
        """The value of a parameter.  Raises ``NotLowered``."""
        try:
            tree = parse_expression(expanded(text, self.named), ActionLanguage.MATLAB)
        except GrammarError as error:
            raise NotLowered(f"the parameter {text!r}: {error}") from error
        bare = ParsedChart(
            DrawnChart("", "chart", "MATLAB", DrawnContent(), ""), ActionLanguage.MATLAB,
            StateNode(0, "", "", None), {}, {}, (),
        )  # fmt: skip
        writer = ProgramWriter("parameter")
        view = ChartView(bare, "parameter", self.file)
        found = ChartWriter(bare, view, self.table, writer, self.step, self.named, lambda one, node: one.name)
        return found.value(tree, TextScope(bare.root, IntegerRules()))

    def chart(self, path: str) -> ParsedChart:
        """The chart of a block.  Raises ``NotLowered``."""
        if path not in self._charts:
            raise NotLowered(f"the block {path} has no chart in the file")
        return self._charts[path]


__all__ = ["LoweringContext"]
