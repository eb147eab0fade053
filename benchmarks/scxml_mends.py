"""Four defects of python-statemachine 3.2.2, by the standard's algorithm (appendix D), and their mends."""

from collections.abc import Collection, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from importlib import import_module
from typing import Any
from unittest.mock import patch

MENDS: Mapping[str, str] = {
    "numbers": "a state after one with children gets the number of the first of them, so that states are "
    "entered and left in another order than that of the document",
    "order": "states without children choose transitions in the order in which they were entered, not in "
    "that of the document (selectTransitions)",
    "content": "the content of a transition to a history is executed a second time as the content of the "
    "history itself, also where the history has a past (addDescendantStatesToEnter)",
    "past": "a deep history keeps all states that were active, not only those without children, "
    "so that a transition to it leaves more (exitStates)",
}  # fmt: skip
"""What is wrong, by the name of its mend."""


@contextmanager
def mended(which: Collection[str]) -> Iterator[None]:
    """Run something with some defects mended."""
    with ExitStack() as all_of:
        for name in which:
            all_of.enter_context(_MENDS[name]())
        yield


def _numbers() -> Any:
    factory = import_module("statemachine.factory").StateMachineMetaclass
    given = factory._initials_by_document_order

    def number(cls: Any, states: list[Any], parent: Any = None, order: int = 1) -> None:
        given(cls, states, parent, order)
        if parent is None:
            for place, state in enumerate(_each(states), start=1):
                state.document_order = place

    return patch.object(factory, "_initials_by_document_order", number)


def _each(states: list[Any]) -> Iterator[Any]:
    for state in states:
        yield state
        yield from _each(state.states)


def _order() -> Any:
    engine = import_module("statemachine.engines.sync").SyncEngine
    ordered = import_module("statemachine.orderedset").OrderedSet

    def select(self: Any, trigger: Any, predicate: Any) -> Any:
        enabled = ordered()
        for state in sorted(self.sm.configuration, key=lambda one: one.document_order):
            if state.is_atomic:
                found = self._first_transition_that_matches(state, trigger, predicate)
                if found is not None:
                    enabled.add(found)
        return self._filter_conflicting_transitions(enabled)

    return patch.object(engine, "_select_transitions", select)


def _content() -> Any:
    engine = import_module("statemachine.engines.base").BaseEngine
    given = engine._add_history_states_to_enter

    def add(
        self: Any, info: Any, state: Any, entered: Any, begun: Any, content: dict[Any, list[Any]]
    ) -> None:
        given(self, info, state, entered, begun, content)
        parent = state.parent and state.parent.id
        content[parent] = [one for one in content.get(parent, []) if one is not info]

    return patch.object(engine, "_add_history_states_to_enter", add)


def _past() -> Any:
    engine = import_module("statemachine.engines.base").BaseEngine
    given = engine._prepare_exit_states

    def leave(self: Any, enabled: Any) -> Any:
        found = given(self, enabled)
        for one in found[0]:
            for history in one.state.history:
                if history.type.is_deep:
                    kept = self.sm.history_values[history.id]
                    self.sm.history_values[history.id] = [state for state in kept if state.is_atomic]
        return found

    return patch.object(engine, "_prepare_exit_states", leave)


_MENDS = {"numbers": _numbers, "order": _order, "content": _content, "past": _past}

__all__ = ["MENDS", "mended"]
