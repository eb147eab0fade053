"""Chains of a promise: whether each link says what the next one takes for granted."""

from collections.abc import Iterator, Mapping

from rovercheck.checker.engines import AUTO, Limits, quiet
from rovercheck.checker.results.verdict import Reached, Unreachable
from rovercheck.checker.verify.portfolio import Callbacks, PortfolioQuestion, answers
from rovercheck.properties.catalogue import as_written
from rovercheck.properties.forms import Always, Form, HoldsAfter
from rovercheck.properties.promises.promise import Chain, Promise
from rovercheck.spec_model.composition.contracts import Contract
from rovercheck.spec_model.composition.fine_systems import CONTRACTS, WIRES
from rovercheck.spec_model.composition.systems import link12, link21
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.edit import everywhere
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Expr, Temporal, Var, flag
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.walk import variables
from rovercheck.spec_model.lang.words import previous

SECONDS = 60
FIELDS: Mapping[str, Expr] = {
    received.name: sent for link in (link12, link21) for sent, received in link.payload
}
"""What each received field is on the board that sends it."""


def check(promise: Promise) -> None:
    """Raises ``ModelError`` that names every hole in the chains of a promise.

    Interpretations are left open, so that a chain without a hole has none under any of their choices.
    """
    found = [f"{_place(promise, chain)}{hole}" for chain in promise.chains for hole in holes(chain)]
    if found:
        raise ModelError("\n".join(found))


def _place(promise: Promise, chain: Chain) -> str:
    across = as_written().get(chain.across)
    where = f"{across.place}: " if across else ""
    return f"{where}the chain of {promise.id} over {chain.across} has a hole: "


def holes(chain: Chain) -> Iterator[str]:
    """What is taken for granted in a chain and said by none of its links, and links that rest on chains."""
    wrong = [*_across(chain), *_links(chain)]
    yield from wrong or _left_open(chain)


def _across(chain: Chain) -> Iterator[str]:
    """Whether the statement in the middle is one about a chain of tasks, of what lasts."""
    across = as_written().get(chain.across)
    if across is None:
        yield f"{chain.across} is no property. {did_you_mean(chain.across, as_written())}"
    elif not isinstance(across.form, HoldsAfter):
        yield f"{across.id} says nothing of what lasts; chains need a statement made with holds_after."
    elif across.on not in WIRES:
        yield f"{across.id} is about {across.on}, no chain of tasks; it is one of {', '.join(WIRES)}."


def _links(chain: Chain) -> Iterator[str]:
    """Whether every link is a property of a board, which rests on no chain in turn: so there is no circle."""
    wanted = {"first": chain.first, "last": chain.last, **chain.by}
    for name, id in wanted.items():
        prop = as_written().get(id)
        if prop is not None and prop.on in WIRES:
            circle = " itself, which is a circle" if id == chain.across else ""
            yield f"{id}, which is to prove {name}, rests on a chain{circle}; take one about a board."
        elif id and prop is None:
            yield f"{id} is no property. {did_you_mean(id, as_written())}"


def _left_open(chain: Chain) -> Iterator[str]:
    """The holes of a chain whose links are properties of the boards."""
    across = as_written()[chain.across]
    assert isinstance(across.form, HoldsAfter)
    contracts = {c.name: c for c in CONTRACTS.get(across.on, ())}
    for name in sorted(chain.by.keys() - contracts.keys()):
        yield f"{across.on} has no contract {name!r}; it has {', '.join(contracts) or 'none'}."
    for name, contract in contracts.items():
        if name not in chain.by:
            yield f"no property proves {name}; write by={{{name!r}: ...}}."
        else:
            yield from _unproved(chain, contract, chain.by[name])
    if not contracts and not (chain.first and chain.last):
        yield f"{across.on} has no contracts; write first= and last=, what leads to it and what follows."
    sent, received = WIRES[across.on]
    yield from _wire(chain, sent, received)
    premise, then = across.form.premise, across.form.then
    if chain.first:
        yield from _leads(chain.first, chain.cause, _where(chain, premise))
    if chain.last:
        yield from _leads(chain.last, _where(chain, received), then)


def _leads(id: str, cause: Expr, then: Expr) -> Iterator[str]:
    """Whether a property says what follows in every step with a cause."""
    form = as_written()[id].form
    yield from _empty(id, cause, then)
    if not isinstance(form, Always):
        yield f"{id} says nothing of the same step; take one made with always."
    elif not _implies(form.that & cause, then):
        yield f"{id} does not say that {then}."


def _empty(id: str, cause: Expr, then: Expr) -> Iterator[str]:
    """Whether nothing would be said: of a cause that never is, or of what is so anyhow."""
    if _implies(cause, FALSE):
        yield f"nothing is asked of {id}: {cause} is never so."
    elif _implies(TRUE, then):
        yield f"nothing is asked of {id}: {then} is always so."


def _unproved(chain: Chain, contract: Contract, id: str) -> Iterator[str]:
    """Whether a property of a board says what a contract does."""
    prop = as_written()[id]
    premise, before = _where(chain, contract.premise), _where(chain, contract.before)
    if prop.from_tick > contract.begins:
        yield f"{id} says nothing before step {prop.from_tick}; {contract.name} does, write first=False."
    yield from _empty(id, premise & before, _where(chain, contract.then))
    match prop.form:
        case HoldsAfter(needed, span, _) if span.ticks(20) > 1 or (span.ticks(20) and before is TRUE):
            yield f"{id} needs {span} of {needed}; {contract.name} gives it less."
            return
        case HoldsAfter(needed, span, _):
            for given in (premise, *([before] if span.ticks(20) else [])):
                if not _implies(given, needed):
                    yield f"{id} demands nothing where {given}, but {contract.name} does."
                    return
    if not _implies(_said(prop.form, premise, before), _where(chain, contract.then)):
        yield f"{id} does not say that {_where(chain, contract.then)}, as {contract.name} does."


def _said(form: Form, cause: Expr, before: Expr) -> Expr:
    """What a property leaves possible in a step with a cause, after a step with something else."""
    match form:
        case HoldsAfter(then=then):
            return then & cause
        case Always(that):
            return that & cause & (TRUE if before is TRUE else previous(before))
    raise ModelError(f"{form} leads to nothing in the same step; a chain takes always or holds_after.")


def _wire(chain: Chain, sent: Var, received: Var) -> Iterator[str]:
    """Whether the receiver reads in the frame what the sender has written."""
    arrives = everywhere(_where(chain, received), _as_sent)
    if not _implies(everywhere(_where(chain, sent) & chain.assuming, _as_sent), arrives):
        yield f"{received.name}, {_where(chain, received)}, is not what the frame carries of {sent.name}."


def _as_sent(expr: Expr) -> Expr:
    return FIELDS.get(expr.name, expr) if isinstance(expr, Var) else expr


def _where(chain: Chain, expr: Expr) -> Expr:
    """A formula of a chain of tasks in variables of the boards."""
    for name in variables(expr):
        if name not in chain.stands:
            raise ModelError(f"The chain over {chain.across} does not say what {name} stands for.")
    return everywhere(expr, lambda e: chain.stands[e.name] if isinstance(e, Var) else e)


def _implies(given: Expr, then: Expr) -> bool:
    """Whether one formula follows from another in every state; what was, and how long, are anything."""
    hole = flag("hole")
    broken = everywhere(given & ~then, lambda e: flag(f"{e}") if isinstance(e, Temporal) else e)
    inputs = tuple(variables(broken).values())
    system = TransitionSystem("chain", inputs, (), (hole,), (), (assign(hole, broken),))
    answer, _ = answers(PortfolioQuestion(system, (hole,)), AUTO, Limits(seconds=SECONDS), Callbacks(quiet))[
        hole.name
    ]
    if not isinstance(answer, Reached | Unreachable):
        raise ModelError(f"whether {then} follows from {given} is not known: {answer.reason}")
    return isinstance(answer, Unreachable)


__all__ = ["check", "holes"]
