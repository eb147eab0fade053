"""The sorts of parts of a label, as far as they are known without what is around them."""

from abc import ABC, abstractmethod
from collections.abc import Sequence

from rovercheck.spec_model.lang.domain import Bool, Sort
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.stateflow.message import LabelError
from rovercheck.spec_model.lang.stateflow.quantities import arguments, subtree
from rovercheck.spec_model.lang.stateflow.syntax import Node


class Unclear(LabelError):
    """The name of members of several enumerations, where nothing says which is meant."""


class Sorts(ABC):
    """Says of each part of a tree once which sort it has."""

    def __init__(self) -> None:
        self._known: dict[int, Sort | None] = {}

    @abstractmethod
    def formula(self, node: Node, like: Sort | None = None) -> Expr:
        """The formula of a tree; ``like`` is the sort that is needed of it, where that is known."""

    def _look(self, node: Node) -> Sort | None:
        """The sort of a part, None where what is around it must say."""
        if id(node) not in self._known:
            self._known[id(node)] = self._sort(node)
        return self._known[id(node)]

    def _sort(self, node: Node) -> Sort | None:
        match node.data:
            case "either" | "both" | "negated" | "comparison":
                return Bool()
            case "number":
                return None
            case "signed" | "signed_twice":
                return self._look(subtree(node, -1))
            case "ite":
                return self._first([subtree(node, 1), subtree(node, 2)])
            case "formula":
                return self._look(subtree(node, 0))
            case "computed":
                parts = [subtree(node, 0), subtree(node, 2)]
                if str(node.children[1]) not in ("*", "/"):
                    return self._first(parts)
                looks = [self._look(part) for part in parts]
                return None if None in looks else self.formula(node).sort
            case "call" if str(node.children[0]) in ("min", "max"):
                return self._first(arguments(node))
        try:
            return self.formula(node).sort
        except Unclear:
            return None

    def _first(self, nodes: Sequence[Node]) -> Sort | None:
        return next((sort for sort in map(self._look, nodes) if sort is not None), None)
