"""What a microstep of XState leaves and enters, for every past that history states may hold."""

from rovercheck.checker.scxml.past import EntryPlan, Known, past_of, targets_of
from rovercheck.checker.scxml.records import MachineState, MachineTransition


def xstate_domain_of(one: MachineTransition, known: Known) -> MachineState | None:
    """The state within which everything is left; the root of the records if the whole machine is."""
    targets = targets_of(one, known)
    if not targets:
        return None
    if one.source.parent is None:
        return one.source
    first, *others = targets
    if one.internal and all(_within(target, one.source) for target in targets):
        return one.source
    *around, root = first.above()
    for state in around:
        if all(other.is_in(state) for other in (*others, one.source)):
            return state
    return root.children[0] if one.internal else root


def _within(state: MachineState, other: MachineState) -> bool:
    return state is other or state.is_in(other)


def xstate_plan_of(one: MachineTransition, known: Known) -> EntryPlan:
    """What a transition enters."""
    plan = EntryPlan()
    domain = xstate_domain_of(one, known)
    if domain is None:
        return plan
    for target in one.targets:
        if target.kind == "history":
            _history(plan, target, known)
            continue
        if not (target is one.source is domain and one.internal):
            _begin(plan, target)
        _inside(plan, target, known)
    for target in targets_of(one, known):
        _up(plan, target, domain, known)
        if domain.kind == "parallel":
            _regions(plan, domain, known, begins=False)
    return plan


def _begin(plan: EntryPlan, state: MachineState) -> None:
    plan.states.add(state)
    if state.compound:
        plan.defaults.add(state)


def _up(plan: EntryPlan, state: MachineState, top: MachineState, known: Known) -> None:
    """What is around a state up to the state ``top``, which it may be itself."""
    for one in state.above() if state is not top else ():
        if one is top or one.parent is None:
            break
        plan.states.add(one)
        if one.kind == "parallel":
            _regions(plan, one, known, begins=False)


def _inside(plan: EntryPlan, state: MachineState, known: Known) -> None:
    if state.kind == "parallel":
        _regions(plan, state, known, begins=True)
    elif state.compound and state.initial is not None:
        child = state.initial.targets[0]
        _begin(plan, child)
        _inside(plan, child, known)


def _regions(plan: EntryPlan, state: MachineState, known: Known, *, begins: bool) -> None:
    """The regions of which no descendant is entered; with ``begins`` they begin where they would."""
    for region in state.children:
        if not any(one.is_in(region) for one in plan.states):
            if begins:
                _begin(plan, region)
            plan.states.add(region)
            _inside(plan, region, known)


def _history(plan: EntryPlan, state: MachineState, known: Known) -> None:
    parent, initial, past = state.parent, state.initial, past_of(state, known)
    assert parent is not None and initial is not None
    if past is None and initial is parent.initial:
        plan.defaults.add(parent)
    found = initial.targets if past is None else past
    for one in found:
        plan.states.add(one)
        _inside(plan, one, known)
    for one in found:
        _up(plan, one, parent, known)


__all__ = ["xstate_domain_of", "xstate_plan_of"]
