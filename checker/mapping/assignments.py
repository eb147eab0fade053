"""The assignments in a function, with both sides as paths that do not depend on where they are written."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from rovercheck.checker.mapping.declarations import CAssignment, CDeclarations, CDeclared

if TYPE_CHECKING:
    from tree_sitter import Node

CONDITIONS = (
    "if_statement",
    "switch_statement",
    "while_statement",
    "for_statement",
    "conditional_expression",
)


class Paths:
    """The paths in one function: of variables by their names, of what pointers reach by its type."""

    def __init__(self, found: CDeclarations, parameters: Mapping[str, CDeclared]) -> None:
        self._found, self._parameters = found, parameters

    def of(self, node: "Node | None") -> str:
        """The path that an expression is, "" if it is none."""
        node = _bare(node)
        if node is None:
            return ""
        match node.type:
            case "identifier":
                return self._root(_text(node))
            case "field_expression":
                inner = self.of(node.child_by_field_name("argument"))
                member = _text(node.child_by_field_name("field"))
                return f"{inner}{'' if inner.endswith('::') else '.'}{member}" if inner else ""
            case "subscript_expression":
                inner = self.of(node.child_by_field_name("argument"))
                return f"{inner}[]" if inner else ""
            case "pointer_expression":
                return self.of(node.child_by_field_name("argument"))
        return ""

    def _root(self, name: str) -> str:
        if name not in self._parameters:
            return name
        one = self._parameters[name]
        return f"{self._found.resolved(one.type)[0]}::" if one.pointer else ""


def assignments(paths: Paths, function: "Node", file: Path) -> Iterator[CAssignment]:
    """The assignments of a function, also by ``++``, and by copying memory."""
    name = _name(function)
    for node in _all(function):
        target, source = _sides(node)
        if target is None:
            continue
        path = paths.of(target)
        if path:
            line = node.start_point[0] + 1
            yield CAssignment(
                path.removesuffix("::"), paths.of(source), name, file, line, _conditional(node, function)
            )


def _sides(node: "Node") -> "tuple[Node | None, Node | None]":
    match node.type:
        case "assignment_expression":
            plain = _text(node.child_by_field_name("operator")) == "="
            return node.child_by_field_name("left"), node.child_by_field_name("right") if plain else None
        case "update_expression":
            return node.child_by_field_name("argument"), None
        case "call_expression" if _text(node.child_by_field_name("function")) == "memcpy":
            given = node.child_by_field_name("arguments")
            both = given.named_children if given is not None else []
            return (both[0], both[1]) if len(both) > 1 else (None, None)
    return None, None


def _conditional(node: "Node", function: "Node") -> bool:
    above = node.parent
    while above is not None and above.id != function.id:
        if above.type in CONDITIONS:
            return True
        above = above.parent
    return False


def _bare(node: "Node | None") -> "Node | None":
    """An expression without parentheses and casts."""
    while node is not None and node.type in ("parenthesized_expression", "cast_expression"):
        inner = node.child_by_field_name("value")
        node = inner or (node.named_children[-1] if node.named_children else None)
    return node


def _all(node: "Node") -> "Iterator[Node]":
    for child in node.named_children:
        yield child
        yield from _all(child)


def _name(function: "Node") -> str:
    node = function.child_by_field_name("declarator")
    while node is not None and node.type != "identifier":
        node = node.child_by_field_name("declarator")
    return _text(node)


def _text(node: "Node | None") -> str:
    return (node.text or b"").decode(errors="replace") if node is not None else ""
