"""Reads sources in C as they are written, with tree-sitter: no preprocessor, no header of a platform."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from rovercheck.checker.mapping.assignments import Paths, assignments
from rovercheck.checker.mapping.declarations import CDeclarations, CDeclared, CFunction, CVariable

if TYPE_CHECKING:
    from tree_sitter import Node

TRAILING = re.compile(r"/\*+<?(.*?)\*/|//+<?(.*)$")
DEEPEST = 4
"""Folders below the one named in which headers are looked for."""
AGGREGATES = ("struct_specifier", "union_specifier")


def declarations(folder: Path) -> CDeclarations:
    """What the C files of a folder declare, with the headers in it and below.

    Raises ``OSError`` for a file that cannot be read.
    """
    found = CDeclarations(folder)
    found.sources = sorted(folder.glob("*.c"))
    found.headers = sorted(
        file
        for file in folder.rglob("*.h")
        if len(file.relative_to(folder).parts) <= DEEPEST and not file.name.startswith(".")
    )
    texts = [(file, file.read_bytes()) for file in (*found.headers, *found.sources)]
    roots = [(file, _parsed(text)) for file, text in texts]
    for (file, text), (_, root) in zip(texts, roots, strict=True):
        _File(found, file, root, text).read()
    for file, root in roots:
        for function in _of_type(root, "function_definition"):
            paths = Paths(found, _parameters(found, file, function))
            found.assignments += assignments(paths, function, file)
    return found


def _parsed(text: bytes) -> "Node":
    import tree_sitter_c
    from tree_sitter import Language, Parser

    return Parser(Language(tree_sitter_c.language())).parse(text).root_node


def said(node: "Node | None") -> str:
    """The text of a node, on one line."""
    return " ".join((node.text or b"").decode(errors="replace").split()) if node is not None else ""


def _of_type(node: "Node", *types: str) -> "Iterator[Node]":
    """The nodes of a type that are in no other such node."""
    for child in node.named_children:
        if child.type in types:
            yield child
        else:
            yield from _of_type(child, *types)


class _File:
    """One file."""

    def __init__(self, into: CDeclarations, file: Path, root: "Node", text: bytes) -> None:
        self._into, self._file, self._root = into, file, root
        self._lines = text.split(b"\n")

    def read(self) -> None:
        """Note all that the file declares."""
        self._inside(self._root)

    def _inside(self, node: "Node") -> None:
        for child in node.named_children:
            match child.type:
                case "type_definition":
                    for one in self._declared(child):
                        self._into.typedefs.setdefault(one.name, one)
                case "preproc_def":
                    name, value = (said(child.child_by_field_name(part)) for part in ("name", "value"))
                    if value:
                        self._into.macros.setdefault(name, re.sub(r"/\*.*?\*/|//.*", "", value).strip())
                case "declaration":
                    self._declaration(child)
                case "function_definition":
                    self._function(child, child.child_by_field_name("declarator"), defined=True)
                case "struct_specifier" | "union_specifier" | "enum_specifier":
                    self._type(child)
                case "ERROR":
                    self._into.unread.append(f"{self._file.name}, line {child.start_point[0] + 1}")
                    self._inside(child)
                case _ if child.type.startswith(("preproc", "linkage", "declaration_list")):
                    self._inside(child)

    def _declaration(self, node: "Node") -> None:
        storage = {said(child) for child in node.named_children if child.type == "storage_class_specifier"}
        for declarator in node.children_by_field_name("declarator"):
            if _function_declarator(declarator) is not None:
                self._function(node, declarator, defined=False)
        for one in self._declared(node):
            line = node.start_point[0] + 1
            self._into.variables.append(
                CVariable(one, self._file, line, "static" in storage, "extern" in storage)
            )

    def _function(self, node: "Node", declarator: "Node | None", *, defined: bool) -> None:
        inner = _function_declarator(declarator)
        if inner is None:
            return
        name = inner.child_by_field_name("declarator")
        static = any(said(c) == "static" for c in node.named_children if c.type == "storage_class_specifier")
        body = node.child_by_field_name("body")
        called = () if body is None else _all(body, "call_expression")
        self._into.functions.append(
            CFunction(
                CDeclared(
                    said(name), self._type(node.child_by_field_name("type")), pointer=inner is not declarator
                ),
                tuple(self._parameters(inner)),
                self._file,
                node.start_point[0] + 1,
                static,
                defined,
                frozenset(said(call.child_by_field_name("function")) for call in called),
            )
        )

    def _parameters(self, declarator: "Node") -> Iterator[CDeclared]:
        written = declarator.child_by_field_name("parameters")
        for child in written.named_children if written is not None else ():
            if child.type == "parameter_declaration" and said(child) != "void":
                yield from self._declared(child)

    def _declared(self, node: "Node") -> Iterator[CDeclared]:
        """The names of a declaration, but functions."""
        type = self._type(node.child_by_field_name("type"))
        const = any(said(c) == "const" for c in node.named_children if c.type == "type_qualifier")
        written = node.children_by_field_name("declarator")
        for declarator in written:
            if _function_declarator(declarator) is not None:
                continue
            name, dimensions, pointer = _taken_apart(declarator)
            bits = next((said(c)[1:].strip() for c in _bits(node, declarator)), "")
            yield CDeclared(name, type, dimensions, pointer, bits, const, self._comment(node))
        if not written and node.type == "field_declaration" and type.partition(" ")[2].startswith("@"):
            yield CDeclared("", type)  # the members of an unnamed one are those of what it is in

    def _type(self, node: "Node | None") -> str:
        """The name of a type; its members and enumerators are noted on the way."""
        if node is None:
            return "int"
        kind = node.type.partition("_")[0]
        if node.type not in (*AGGREGATES, "enum_specifier"):
            return said(node)
        tag = said(node.child_by_field_name("name"))
        key = f"{kind} {tag or f'@{self._file.name}:{node.start_byte}'}"
        body = node.child_by_field_name("body")
        if body is not None and node.type in AGGREGATES:
            members = [one for child in _fields(body) for one in self._declared(child)]
            self._into.members[key] = tuple(members)
        elif body is not None:
            self._into.enumerators[key] = tuple(
                said(child.child_by_field_name("name")) for child in _of_type(body, "enumerator")
            )
        return key

    def _comment(self, node: "Node") -> str:
        """The comment at the end of its last line."""
        row, column = node.end_point
        rest = self._lines[row][column:].decode(errors="replace") if row < len(self._lines) else ""
        found = TRAILING.search(rest)
        return (found[1] or found[2] or "").strip() if found else ""


def _fields(body: "Node") -> "Iterator[Node]":
    yield from _of_type(body, "field_declaration")


def _bits(node: "Node", declarator: "Node") -> "Iterator[Node]":
    """The clause of a bit field that follows a name."""
    after = declarator.next_named_sibling
    if after is not None and after.type == "bitfield_clause" and node.type == "field_declaration":
        yield after


def _function_declarator(node: "Node | None") -> "Node | None":
    """The function in a declarator, below pointers; None for a variable, also one that points to one."""
    while node is not None and node.type == "pointer_declarator":
        node = node.child_by_field_name("declarator")
    if node is None or node.type != "function_declarator":
        return None
    inner = node.child_by_field_name("declarator")
    return node if inner is not None and inner.type == "identifier" else None


def _taken_apart(node: "Node") -> tuple[str, tuple[str, ...], bool]:
    """Name, dimensions and whether it is a pointer."""
    dimensions: list[str] = []
    pointer = False
    while True:
        if node.type == "array_declarator":
            dimensions.insert(0, said(node.child_by_field_name("size")))
        pointer = pointer or node.type in ("pointer_declarator", "function_declarator")
        inner = node.child_by_field_name("declarator") or next(
            (c for c in node.named_children if node.type == "parenthesized_declarator"), None
        )
        if inner is None:
            return said(node), tuple(dimensions), pointer
        node = inner


def _all(node: "Node", type: str) -> "Iterator[Node]":
    """Every node of a type, also those in others."""
    for child in node.named_children:
        if child.type == type:
            yield child
        yield from _all(child, type)


def _parameters(found: CDeclarations, file: Path, function: "Node") -> dict[str, CDeclared]:
    line = function.start_point[0] + 1
    mine = [f for f in found.functions if f.file == file and f.line == line and f.defined]
    return {p.name: p for f in mine for p in f.parameters}
