"""Inductive invariants as a certificate writes them: formulas, or the closed set as a diagram."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Union

from rovercheck.checker.certify.diagram import CertifiedDiagram, CertifiedNode
from rovercheck.checker.certify.question import CertifyQuestion
from rovercheck.checker.certify.smtlib import Printer, among, define, joined, own, quoted
from rovercheck.checker.results.verdict import Inductive
from rovercheck.spec_model.lang.expr import Var


@dataclass(frozen=True)
class Conjuncts:
    """Formulas that all hold: definitions in SMT-LIB, and the symbols of those that are conjuncts.

    They speak of the state after 0 ticks.  ``ticks`` and ``simple`` are those of
    ``checker.results.verdict.Inductive``.
    """

    definitions: tuple[str, ...]
    conjuncts: tuple[str, ...]
    ticks: int = 1
    simple: bool = False


Invariant = Union[Conjuncts, CertifiedDiagram]


def conjuncts(found: Inductive, frozen: Sequence[Var], variables: Sequence[Var]) -> Conjuncts:
    """What an engine found, written down.  Raises ``KeyError`` for a conjunct about anything else."""
    symbols = {v.name: quoted(v.name) for v in frozen} | {v.name: quoted(v.name, 0) for v in variables}
    printer = Printer(symbols, 0, "c")
    written = tuple(printer.boolean(conjunct) for conjunct in found.conjuncts)
    return Conjuncts(tuple(printer.lines), written, found.ticks, found.simple)


def holds(invariant: Invariant, question: CertifyQuestion, at: int) -> list[str]:
    """Definitions up to that of the invariant after ``at`` ticks."""
    if isinstance(invariant, CertifiedDiagram):
        return _diagram(invariant, question, at)
    whole = define(own("invariant", 0), "Bool", joined("and", invariant.conjuncts))
    return [line.replace("@0|", f"@{at}|") for line in (*invariant.definitions, whole)]


def _diagram(diagram: CertifiedDiagram, question: CertifyQuestion, at: int) -> list[str]:
    symbols = question.symbols(at)
    domains = {v.name: v.domain for v in question.state}
    nodes = ["true", *(own(f"n{number}", at) for number in range(1, len(diagram.nodes) + 1))]
    lines = []
    for number, node in enumerate(diagram.nodes, 1):
        name = diagram.variables[node.variable]
        ways = [_way(among(symbols[name], domains[name], to), nodes[n]) for n, to in _leads(node).items()]
        lines.append(define(nodes[number], "Bool", joined("or", ways)))
    return [*lines, define(own("invariant", at), "Bool", nodes[diagram.root])]


def _leads(node: CertifiedNode) -> Mapping[int, list[tuple[int, int]]]:
    """The intervals that lead to each node."""
    found: dict[int, list[tuple[int, int]]] = {}
    for low, high, to in node.edges:
        found.setdefault(to, []).append((low, high))
    return found


def _way(condition: str, then: str) -> str:
    return condition if then == "true" else f"(and {condition} {then})"
