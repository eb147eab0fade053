"""Certificates: what an engine has shown, as a document that anybody can check (docs/certificates.md)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from operator import attrgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rovercheck.checker.certify.diagram import CertifiedDiagram, CertifiedNode, Column, Nodes, positions
from rovercheck.checker.certify.invariant import Conjuncts, Invariant, conjuncts
from rovercheck.checker.certify.question import CertifyQuestion, question
from rovercheck.checker.certify.reduction import diagram
from rovercheck.checker.certify.terms import TRUTH, Malformed, definitions
from rovercheck.checker.certify.tick import conjuncts as parts
from rovercheck.checker.certify.tick import executed
from rovercheck.checker.results.closed_set import ClosedSet, ClosedUnion
from rovercheck.checker.results.diagram import Diagram as Bits
from rovercheck.checker.results.diagram import formula
from rovercheck.checker.results.verdict import Answer, Evidence, Exhausted, Inductive, Unreachable
from rovercheck.checker.system.slice import sliced
from rovercheck.spec_model.lang.domain import Domain
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.walk import variables

MOST = 1 << 31
"""Values (states times variables) of a closed set of which a diagram is made: 4 GiB of 16 bits each."""


@dataclass(frozen=True)
class Certificate:
    """One answer of an engine: the goals it ``claims`` are never true, and an invariant that shows it.

    ``kept``, ``about`` and ``text`` as in ``CertifyQuestion``; ``found`` says what the engine counted.
    """

    system: str
    claims: tuple[str, ...]
    kept: tuple[int, ...]
    about: tuple[str, ...]
    digest: str
    text: str
    invariant: Invariant
    engine: str
    found: Mapping[str, int]


def certificates(
    system: TransitionSystem,
    goals: Sequence[Var],
    answers: Mapping[str, Answer],
    engine: str,
    most: int | None = None,
) -> list[Certificate]:
    """A certificate for each invariant in the answers, for the goals that it excludes.

    Call it where the answers were found, so that a large closed set stays where it is.  An answer without
    an invariant (an exhausted search that kept no closed set) gives none, nor does one with more than
    ``most`` values.  Raises ``MemoryError``.
    """
    claims: dict[object, tuple[Evidence, list[str]]] = {}
    for goal in goals:
        match answers.get(goal.name):
            case Unreachable(
                Exhausted(skipped=False, closed=ClosedSet() | ClosedUnion() as closed) as because
            ):
                if closed.size <= (MOST if most is None else most):
                    claims.setdefault(_memory(closed.whole), (because, []))[1].append(goal.name)
            case Unreachable(Exhausted(skipped=False, diagram=shape)) if shape is not None:
                claims.setdefault(id(shape), (_formula(shape, system), []))[1].append(goal.name)
            case Unreachable(Inductive() as because):
                claims.setdefault(id(because), (because, []))[1].append(goal.name)
    if not claims:
        return []
    step = executed(system)
    made = []
    for because, names in claims.values():
        about = _about(because)
        asked = question(step, names, _kept(system, [*names, *about]), about)
        made.append(_certificate(system, asked, because, engine))
    return made


def _formula(shape: Bits, system: TransitionSystem) -> Inductive:
    """A set of states that an engine has as a diagram over bits, as one conjunct."""
    return Inductive((formula(shape, {name: system.var(name) for name in shape.variables}),))


def _memory(closed: ClosedSet) -> object:
    """Where the states are: one search gives the same ones to all its goals."""
    return closed.words.__array_interface__["data"], closed.words.shape


def _kept(system: TransitionSystem, names: Sequence[str]) -> list[int]:
    """The conjuncts of the assumption that matter to variables: others speak of inputs that nothing reads."""
    used = {id(part) for part in parts(sliced(system, [system.var(n) for n in names]).assume)}
    return [i for i, part in enumerate(parts(system.assume)) if id(part) in used]


def _about(because: Evidence) -> tuple[str, ...]:
    if isinstance(because, Inductive):
        return tuple(variables(*because.conjuncts))
    assert because.closed is not None
    return tuple(place.var.name for place in because.closed.whole.places)


def _certificate(
    system: TransitionSystem, asked: CertifyQuestion, because: Evidence, engine: str
) -> Certificate:
    found: dict[str, int]
    if isinstance(because, Inductive):
        invariant: Invariant = conjuncts(because, asked.tick.frozen, asked.tick.variables)
        found = {"conjuncts": len(because.conjuncts)}
    else:
        assert because.closed is not None
        invariant = diagram(because.closed.whole)
        found = {"valuations": len(because.closed.whole), "depth": because.depth}
    return Certificate(
        system.name,
        asked.claims,
        asked.kept,
        asked.about,
        asked.digest,
        asked.text,
        invariant,
        engine,
        found,
    )


# --- as a document -------------------------------------------------------------------------------


def document(certificate: Certificate) -> dict[str, object]:
    """The certificate as JSON."""
    return {
        "system": certificate.system,
        "claims": list(certificate.claims),
        "assume": list(certificate.kept),
        "about": list(certificate.about),
        "digest": certificate.digest,
        "question": certificate.text.splitlines(),
        "invariant": _invariant(certificate.invariant),
        "engine": certificate.engine,
        "found": dict(certificate.found),
    }


def _invariant(invariant: Invariant) -> dict[str, object]:
    if isinstance(invariant, CertifiedDiagram):
        nodes = [[n.variable, *(number for edge in n.edges for number in edge)] for n in invariant.nodes]
        return {"variables": list(invariant.variables), "nodes": nodes, "root": invariant.root}
    return {
        "definitions": list(invariant.definitions),
        "conjuncts": list(invariant.conjuncts),
        "ticks": invariant.ticks,
        "simple": invariant.simple,
    }


def certificate(found: Any) -> Certificate:
    """The certificate in a JSON document.  Raises ``Malformed``.

    That it has the right shape is checked here; whether it is right, by ``checker.certify.check``.
    """
    try:
        return Certificate(
            _text(found["system"]),
            _strings(found["claims"]),
            _numbers(found["assume"]),
            _strings(found["about"]),
            _text(found["digest"]),
            "\n".join((*_strings(found["question"]), "")),
            _read(found["invariant"]),
            _text(found["engine"]),
            {name: _number(number) for name, number in found["found"].items()},
        )
    except (KeyError, TypeError, ValueError, AttributeError, IndexError, OverflowError) as error:
        raise Malformed(f"{type(error).__name__} {error} in the certificate") from error


def _read(found: Any) -> Invariant:
    if "nodes" in found:
        nodes = Nodes.of(_node(_numbers(n)) for n in found["nodes"])
        return CertifiedDiagram(_strings(found["variables"]), nodes, _number(found["root"]))
    if not isinstance(found["simple"], bool):
        raise Malformed("simple must be true or false")
    texts = _strings(found["definitions"]), _strings(found["conjuncts"])
    return Conjuncts(*texts, _number(found["ticks"]), found["simple"])


def _node(numbers: tuple[int, ...]) -> CertifiedNode:
    edges = tuple(zip(numbers[1::3], numbers[2::3], numbers[3::3], strict=True))
    return CertifiedNode(numbers[0], edges)


def _text(found: Any) -> str:
    return _strings([found])[0]


def _number(found: Any) -> int:
    return _numbers([found])[0]


def _strings(found: Any) -> tuple[str, ...]:
    if not (isinstance(found, list) and all(isinstance(s, str) for s in found)):
        raise Malformed(f"{str(found)[:40]} is no list of texts")
    return tuple(found)


def _numbers(found: Any) -> tuple[int, ...]:
    if not (isinstance(found, list) and all(type(n) is int for n in found)):
        raise Malformed(f"{str(found)[:40]} is no list of whole numbers")
    return tuple(found)


# --- meaning something ---------------------------------------------------------------------------


def meaningful(invariant: Invariant, asked: CertifyQuestion) -> None:
    """Raises ``Malformed`` unless the invariant speaks of states of the question and of nothing else."""
    if isinstance(invariant, CertifiedDiagram):
        _diagram(invariant, asked)
        return
    _, sorts = definitions(invariant.definitions, asked.spoken)
    known = {"true", "false", *(symbol for symbol, sort in sorts.items() if sort == TRUTH)}
    unknown = [c for c in invariant.conjuncts if c not in known]
    if unknown or invariant.ticks < 1:
        raise Malformed(f"{unknown or invariant.ticks} is no conjunct, or no number of ticks")


def _diagram(found: CertifiedDiagram, asked: CertifyQuestion) -> None:
    domains = {v.name: v.domain for v in asked.state}
    if not set(found.variables) <= domains.keys() or len(set(found.variables)) < len(found.variables):
        raise Malformed("the diagram asks for a variable twice, or for one that is not in the question")
    nodes = found.nodes
    known = (nodes.variable >= 0) & (nodes.variable < len(found.variables))
    if not known.all():
        at = int(np.flatnonzero(~known)[0])
        raise Malformed(f"node {at + 1} asks for variable {nodes.variable[at]}, which does not exist")
    if len(nodes.to) and not (fine := _orderly(found, domains)).all():
        low, high, to, owner = (c[np.flatnonzero(~fine)[0]] for c in _edges(nodes))
        raise Malformed(f"node {owner + 1} has an edge {low}..{high} to {to} that cannot be")
    if not 0 <= found.root <= len(nodes):
        raise Malformed(f"there is no node {found.root} to begin with")


def _edges(nodes: Nodes) -> tuple[Column, ...]:
    return nodes.low, nodes.high, nodes.to, nodes.owner


def _orderly(found: CertifiedDiagram, domains: Mapping[str, Domain]) -> NDArray[np.bool_]:
    """Which edges have values of the domain, more than the edge before, and lead to a node after theirs."""
    low, high, to, owner = _edges(found.nodes)
    asking = found.nodes.variable[owner]
    least, most = (
        np.array([end(domains[name]) for name in found.variables])[asking]
        for end in (attrgetter("low"), attrgetter("high"))
    )
    before = (to >= 0) & (to <= owner)
    after = positions(found)[np.where(before, to, 0)] > asking
    ascending = np.ones(len(low), dtype=np.bool_)
    ascending[1:] = (owner[1:] != owner[:-1]) | (low[1:] > high[:-1])
    return (least <= low) & (low <= high) & (high <= most) & before & after & ascending
