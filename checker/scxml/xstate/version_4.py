"""What of XState 4 is read: machines in which its algorithm has a plain meaning."""

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence

from rovercheck.checker.io.json_lines import JsonValue
from rovercheck.checker.scxml.records import CancelEvent, MachineState, MachineTransition, NamedAction
from rovercheck.checker.scxml.xstate.content import XstateContent

ANY = "any event"
"""What a region answers that answers an event at all."""
NESTED = "an event is raised while another one waits, which XState 4 takes before it"
GOES_ON = "the machine ends while a raised event waits, which XState 4 takes all the same"
"""What a run may meet that has no plain meaning."""
GO_ON = "Write the machine for XState 5, or another transition"


def check_version_4(content: XstateContent, states: Sequence[MachineState]) -> None:
    """Tell what XState 4 does in a way of its own, which is not read."""
    for state in states:
        if state.kind == "history":
            content.fault(_at(state.line), f"a history of XState 4. {GO_ON}")
        if state.kind == "final" and state.parent is not None and state.parent.kind == "parallel":
            content.fault(_at(state.line), f"a final state as a region in XState 4. {GO_ON}")
    if content.faults:
        return
    for state in states:
        for one in state.transitions:
            if len(one.targets) > 1:
                content.fault(_at(one.line), f"several targets in XState 4. {GO_ON}")
            elif one.targets:
                _target(content, one)
    _regions(content, states)
    _ends(content, states)


def _ends(content: XstateContent, states: Sequence[MachineState]) -> None:
    """Final states have events of their own there, and the last exit actions may come several times."""
    top, *others = states
    stars = any("*" in one.events for state in states for one in state.transitions)
    ends = [one for one in others if one.kind == "final"]
    for one in ends:
        if stars and one.parent is not top:
            content.fault(_at(one.line), f"`*`, which answers the end of {one.id} too in XState 4. {GO_ON}")
    last = others if top.kind == "parallel" else [one for one in ends if one.parent is top]
    for one in [top, *last] if ends else []:
        if any(not isinstance(action, NamedAction | CancelEvent) for part in one.on_exit for action in part):
            content.fault(
                _at(one.line), f"exit actions of {one.id} with a binding, where XState 4 ends. {GO_ON}"
            )


def _target(content: XstateContent, one: MachineTransition) -> None:
    [target] = one.targets
    if one.internal:
        path = chain_to(target)
        around = [state for state in path if one.source is not state and one.source.is_in(state)]
        if any(state.kind == "parallel" for state in path if state not in around):
            content.fault(
                _at(one.line), f"an internal transition of XState 4 from {one.source.id} that enters a "
                f"parallel state. {GO_ON}"
            )  # fmt: skip
        if any(_splits(state, one.source, target) for state in around):
            _across(content, one)
        return
    outer = next((state for state in target.above() if one.source.is_in(state)), None)
    if outer is not None and outer.kind == "parallel":
        _across(content, one)


def _splits(state: MachineState, source: MachineState, target: MachineState) -> bool:
    """Whether source and target are in different regions of a state."""
    if state.kind != "parallel" or not target.is_in(state):
        return False
    return not any(_within(source, one) and _within(target, one) for one in state.children)


def _within(state: MachineState, other: MachineState) -> bool:
    return state is other or state.is_in(other)


def _across(content: XstateContent, one: MachineTransition) -> None:
    content.fault(
        _at(one.line), f"a transition of XState 4 from {one.source.id} to {one.targets[0].id}, between "
        f"regions or to a region itself. {GO_ON}"
    )  # fmt: skip


def chain_to(target: MachineState) -> list[MachineState]:
    """The states from the machine to a target, and on to where it begins."""
    *around, _ = target.above()
    found = [*reversed(around), target]
    while found[-1].compound:
        initial = found[-1].initial
        assert initial is not None
        found.append(initial.targets[0])
    return found


def _regions(content: XstateContent, states: Sequence[MachineState]) -> None:
    """One region leaves a parallel state while another one answers the same event."""
    for state in states:
        if state.kind != "parallel":
            continue
        inside = {region: list(_inside(region)) for region in state.children}
        answered = {region: {_word(one) for one in found} for region, found in inside.items()}
        regions = Counter(
            word for words in answered.values() for word in (*words, *([ANY] if any(words) else []))
        )
        for region, found in inside.items():
            for one in found:
                if (
                    one.targets
                    and not one.targets[0].is_in(region)
                    and _alike(_word(one), regions, answered[region])
                ):
                    content.fault(
                        _at(one.line), f"a transition of XState 4 that leaves {state.id} for an event "
                        f"that another region of it answers too. {GO_ON}"
                    )  # fmt: skip


def _inside(region: MachineState) -> Iterator[MachineTransition]:
    yield from region.transitions
    for child in region.children:
        yield from _inside(child)


def _word(one: MachineTransition) -> str:
    """What a transition waits for; nothing for an eventless one."""
    return one.events[0] if one.events else ""


def _alike(word: str, regions: Mapping[str, int], own: Collection[str]) -> bool:
    """Whether another region than one's own answers the same event."""
    asked = [word] if not word else [word, "*", *([ANY] if word == "*" else [])]
    return any(regions.get(one, 0) > (one in own or (one == ANY and any(own))) for one in asked)


def _at(line: int) -> JsonValue:
    return JsonValue(line)


__all__ = ["GOES_ON", "NESTED", "chain_to", "check_version_4"]
