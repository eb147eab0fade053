"""Values that a person lets be free: those of blocks, functions and expressions that have no exact meaning.

They are named in the file of domains: a block by its path, a function by its name, anything else as it is
written in the chart.  What is free may have any value of its domain wherever it is computed, whatever it is
computed from, so that the system has all runs of the model, and others.
"""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from rovercheck.checker.drawn.calls import is_called
from rovercheck.checker.drawn.grammar.errors import GrammarError
from rovercheck.checker.drawn.grammar.expressions import parse_expression
from rovercheck.checker.drawn.grammar.syntax import (
    ActionLanguage,
    Applied,
    BinaryOperation,
    Expression,
    Name,
    UnaryOperation,
)
from rovercheck.checker.drawn.grammar.text import text_of
from rovercheck.checker.drawn.records import DrawnBlock, DrawnModel, DrawnSystem
from rovercheck.spec_model.lang.errors import ModelError

FREE_BLOCK = "FreeInput"
"""The kind of a block whose outputs are free; its parameters are the types of these, by their names."""
WITH_EFFECT = (
    "Inport",
    "Outport",
    "EnablePort",
    "TriggerPort",
    "ActionPort",
    "Goto",
    "From",
    "DataStoreWrite",
)
"""Blocks that do more than give values, or whose values come from elsewhere."""


def free_name(expression: Expression, free: Mapping[str, str]) -> str:
    """The name under which the value of an expression is free; empty if it is not."""
    match expression:
        case _ if not free:
            return ""
        case Applied(Name(name)) if name in free:
            return free[name]
        case Applied() | BinaryOperation() | UnaryOperation():
            return free.get(text_of(expression, ActionLanguage.MATLAB), "")
    return ""


def arguments_of(expression: Expression) -> Sequence[Expression]:
    """Of a call of a function what it is given; nothing of any other expression."""
    called = isinstance(expression, Applied) and isinstance(expression.function, Name)
    return expression.arguments if isinstance(expression, Applied) and called else ()


def freed(model: DrawnModel, names: Sequence[str]) -> DrawnModel:
    """The model in which what has these names is free.  Raises ``ModelError`` for what cannot be."""
    if not names:
        return model
    finder = _Blocks(model, names)
    system = finder.system(model.system, called=False)
    paths = tuple(f"{path}/" for path in finder.found)
    charts = [one for one in model.charts if not f"{one.path}/".startswith(paths)]
    data = {one.name for chart in charts for level in chart.content.every_level() for one in level.data}
    texts = {_normal(name, data): name for name in names if name not in finder.found}
    return replace(model, system=system, charts=tuple(charts), free=texts)


def free_outputs(model: DrawnModel) -> Iterator[tuple[str, str]]:
    """The outputs of free blocks by the names of their values, with their types as written."""
    for block in model.system.every_block():
        if block.kind == FREE_BLOCK:
            yield from block.parameters.items()


def _normal(name: str, data: Collection[str]) -> str:
    """The name of a function, or an expression, as the charts are asked for it."""
    where = "the path of a block, the name of a function, or an expression as a chart has it"
    try:
        tree = parse_expression(name, ActionLanguage.MATLAB)
    except GrammarError as error:
        raise ModelError(
            f"free: no block is called {name!r}, and it is no expression; write {where}."
        ) from error
    if isinstance(tree, Name) and name.strip() not in data:
        return name.strip()
    if isinstance(tree, Applied | BinaryOperation | UnaryOperation):
        return text_of(tree, ActionLanguage.MATLAB)
    raise ModelError(f"free: {name!r} is not computed, and so it cannot be free; write {where}.")


@dataclass
class _Blocks:
    model: DrawnModel
    names: Collection[str]
    found: dict[str, None] = field(default_factory=dict)

    def system(self, system: DrawnSystem, called: bool) -> DrawnSystem:
        """A system whose blocks with these names are free; ``called``: events execute it, perhaps often."""
        return replace(system, blocks=tuple(self._block(one, system, called) for one in system.blocks))

    def _block(self, block: DrawnBlock, system: DrawnSystem, called: bool) -> DrawnBlock:
        path = block.shown_path
        if path not in self.names:
            if block.system is None:
                return block
            inside = called or bool(block.chart) or is_called(block)
            return replace(block, system=self.system(block.system, inside))
        self.found[path] = None
        if called or is_called(block):
            raise ModelError(
                f"free: {path} is executed when a chart calls it, perhaps several times in a step; name the "
                'function of the chart that calls it, as in free = ["f"].'
            )
        outputs = {line.from_port for line in system.lines if line.source == block.id}
        if block.kind in WITH_EFFECT or not outputs:
            raise ModelError(f"free: {path} is a block {block.kind}, which gives no value of its own.")
        most = max(outputs)
        named = [path if most == 1 else f"{path}:{number}" for number in range(1, most + 1)]
        types = self._types(block, most)
        return replace(
            block, kind=FREE_BLOCK, parameters=dict(zip(named, types, strict=True)), system=None, chart=""
        )

    def _types(self, block: DrawnBlock, most: int) -> Sequence[str]:
        """The types of the outputs of a block, as written."""
        said = [block.parameters.get("OutDataTypeStr", "double")] * most
        for chart in self.model.charts:
            if chart.path == block.chart:
                own = [one.type for one in chart.content.data if one.scope == "output"]
                said = [*own, *said[len(own) :]][:most]
        return ["double" if one.startswith("Inherit") else one for one in said]


def numbered(name: str, number: int) -> str:
    """The name of the input for the second and further values of one name in a step.

    >>> numbered("sin", 1), numbered("sin", 2)
    ('sin', 'sin 2')
    """
    return name if number == 1 else f"{name} {number}"


__all__ = ["FREE_BLOCK", "arguments_of", "free_name", "free_outputs", "freed", "numbered"]
