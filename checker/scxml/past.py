"""What a microstep enters, for every past that history states may hold."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product
from typing import TypeVar

from rovercheck.checker.scxml.records import MachineState, MachineTransition
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import TRUE, Expr, all_of

MOST_PASTS = 64
"""Pasts of one history state that are told apart."""
Past = tuple[MachineState, ...] | None
"""The states that a history stands for; ``None`` before its parent was ever left."""
Known = Mapping[MachineState, Past]
Found = TypeVar("Found")


@dataclass
class EntryPlan:
    """What is entered: states, those entered by default, and by parent the last history without a past."""

    states: set[MachineState] = field(default_factory=set)
    defaults: set[MachineState] = field(default_factory=set)
    begun: dict[MachineState, MachineState] = field(default_factory=dict)


class _Asked(Exception):
    def __init__(self, history: MachineState) -> None:
        self.history = history


def past_of(history: MachineState, known: Known) -> Past:
    """What a history stands for."""
    if history not in known:
        raise _Asked(history)
    return known[history]


def targets_of(one: MachineTransition, known: Known) -> list[MachineState]:
    """The states that the targets of a transition stand for."""
    found = []
    for target in one.targets:
        if target.kind != "history":
            found.append(target)
            continue
        past = past_of(target, known)
        assert target.initial is not None
        found += targets_of(target.initial, known) if past is None else past
    return found


def domain_of(one: MachineTransition, known: Known) -> MachineState | None:
    """The state within which everything is left; ``None`` of a transition without a target."""
    targets = targets_of(one, known)
    if not targets:
        return None
    inside = all(target.is_in(one.source) for target in targets)
    if one.internal and inside and one.source.compound:
        return one.source
    around = [one for one in one.source.above() if one.kind != "parallel"]
    return next(state for state in around if all(target.is_in(state) for target in targets))


def plan_of(one: MachineTransition, known: Known) -> EntryPlan:
    """What a transition enters; the domain is that of the machine for the one that begins it."""
    plan = EntryPlan()
    if one.targets:
        domain = one.source if one.source.parent is None else domain_of(one, known)
        assert domain is not None
        for target in one.targets:
            _down(plan, target, known)
        for target in targets_of(one, known):
            _up(plan, target, domain, known)
    return plan


def _down(plan: EntryPlan, state: MachineState, known: Known) -> None:
    if state.kind == "history":
        assert state.parent is not None and state.initial is not None
        past = past_of(state, known)
        if past is None:
            plan.begun[state.parent] = state
        _each(plan, state.initial.targets if past is None else past, state.parent, known)
        return
    plan.states.add(state)
    if state.kind == "parallel":
        _regions(plan, state, known)
    elif state.compound and state.initial is not None:
        plan.defaults.add(state)
        _each(plan, state.initial.targets, state, known)


def _each(plan: EntryPlan, targets: Sequence[MachineState], top: MachineState, known: Known) -> None:
    for one in targets:
        _down(plan, one, known)
    for one in targets:
        _up(plan, one, top, known)


def _up(plan: EntryPlan, state: MachineState, top: MachineState, known: Known) -> None:
    for one in state.above():
        if one is top:
            break
        plan.states.add(one)
        if one.kind == "parallel":
            _regions(plan, one, known)


def _regions(plan: EntryPlan, state: MachineState, known: Known) -> None:
    for region in state.children:
        if all(not one.is_in(region) for one in plan.states):
            _down(plan, region, known)


class PastVariables:
    """Formulas of what history states remember; ``same`` says that the child of a level was active."""

    def __init__(
        self, never: Callable[[MachineState], Expr],
        same: Callable[[MachineState, MachineState, MachineState], Expr],
    ) -> None:  # fmt: skip
        self.never, self._same = never, same

    def pasts(self, history: MachineState) -> Iterator[tuple[Expr, Past]]:
        """Every past of a history, with its condition."""
        assert history.parent is not None
        yield self.never(history), None
        begun = ~self.never(history)
        if not history.deep:
            if history.parent.kind == "parallel":
                yield begun, tuple(history.parent.children)
            else:
                for child in history.parent.children:
                    yield self._same(history, history.parent, child), (child,)
            return
        for number, (condition, states) in enumerate(self._leaves(history, history.parent)):
            if number >= MOST_PASTS:
                raise ModelError(
                    f"the history {history.id} (line {history.line}) may stand for more than {MOST_PASTS} "
                    "combinations of states. Write a shallow history in each region"
                )
            yield all_of(begun, condition), states

    def _leaves(
        self, history: MachineState, state: MachineState
    ) -> Iterator[tuple[Expr, tuple[MachineState, ...]]]:
        if state.atomic:
            yield TRUE, (state,)
        elif state.kind == "parallel":
            for parts in product(*(list(self._leaves(history, one)) for one in state.children)):
                yield all_of(*(c for c, _ in parts)), tuple(one for _, part in parts for one in part)
        else:
            for child in state.children:
                for condition, found in self._leaves(history, child):
                    yield all_of(self._same(history, state, child), condition), found


def each_past(
    asks: Callable[[Known], Found], pasts: PastVariables, known: Known | None = None, when: Expr = TRUE
) -> Iterator[tuple[Expr, Found]]:
    """What is found for every past that it depends on, with the condition of that past."""
    known = known or {}
    try:
        found = asks(known)
    except _Asked as asked:
        for condition, past in pasts.pasts(asked.history):
            yield from each_past(asks, pasts, {**known, asked.history: past}, all_of(when, condition))
        return
    yield when, found


__all__ = [
    "EntryPlan",
    "Known",
    "PastVariables",
    "domain_of",
    "each_past",
    "past_of",
    "plan_of",
    "targets_of",
]
