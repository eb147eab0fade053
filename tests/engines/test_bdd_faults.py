"""Faults put into the symbolic search on purpose: each is caught by the comparison with a naive search."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import pairwise

import pytest
from hypothesis import Phase, given, settings

from benchmarks.roverlite import roverlite
from rovercheck.checker.encode.bits import TRUE, Circuit, Latch
from rovercheck.checker.engines.bdd import layers, relation, search
from rovercheck.checker.engines.bdd import search as groups
from rovercheck.checker.engines.bdd import search as runs
from rovercheck.checker.engines.bdd.layers import Layers
from rovercheck.checker.engines.bdd.relation import Relation
from rovercheck.checker.engines.bdd.search import BddGroup
from rovercheck.checker.engines.bdd.space import Function, Space
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import Var, flag, ite, var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.words import minimum
from tests import naive
from tests.engines.test_bdd import agrees
from tests.faults import PatchSuite
from tests.strategies_ts import goals, transition_systems

Patch = pytest.MonkeyPatch

_step = Layers.step
_image = Relation.image
_relation = relation.relation
_groups = groups.groups
_clusters = relation._clusters
_last = relation._last


@dataclass(frozen=True)
class Example:
    """A system, goals, and what a naive search says of them."""

    system: TransitionSystem
    goals: tuple[str, ...]
    expected: naive.Searched


def example(system: TransitionSystem, wanted: Sequence[Var]) -> Example:
    return Example(system, tuple(g.name for g in wanted), naive.search(system, wanted))


@cache
def examples() -> list[Example]:
    """Small systems with deep runs, and random ones, the same every time."""
    found = [example(*roverlite(comp, k)) for comp, k in ((4, 25), (3, 50), (20, 50))]
    found.append(example(*held_counter()))

    @settings(max_examples=200, phases=[Phase.generate], database=None, derandomize=True)
    @given(transition_systems())
    def collect(system: TransitionSystem) -> None:
        found.append(example(system, goals(system)))

    collect()
    return found


def held_counter() -> tuple[TransitionSystem, tuple[Var, ...]]:
    """It counts as long as the input holds, and from further on for another frozen mode."""
    hold, mode, count = flag("hold"), var("mode", integer(1, 3), 1), var("count", integer(0, 6))
    full, over = flag("full"), flag("over")
    step = (
        Assign(count, ite(hold, minimum(count + mode, 6), 0)),
        Assign(full, count == 5),
        Assign(over, (mode == 3) & (count == 4)),
    )
    return TransitionSystem("held", (hold,), (mode,), (count, full, over), (), step), (full, over)


def disagrees(example: Example) -> bool:
    """Whether the search is wrong about the system, or notices itself that it is."""
    try:
        agrees(example.system, list(example.goals), example.expected)
    except (AssertionError, ArithmeticError, RuntimeError):
        return True
    return False


def with_circuit(patch: Patch, change: Callable[[Circuit], Circuit]) -> None:
    def changed(system: TransitionSystem, names: list[str]) -> Iterator[BddGroup]:
        for group in _groups(system, names):
            yield replace(group, circuit=change(group.circuit))

    patch.setattr(search, "groups", changed)


# --- the faults ---------------------------------------------------------------------------------------


def a_latch_is_quantified_too_early(patch: Patch) -> None:
    """Before the last cluster that speaks of it."""

    def earlier(supports: list[set[int]], quantified: set[int]) -> list[set[int]]:
        found = _last(supports, quantified)
        return [*(a | b for a, b in pairwise(found)), set()] if len(found) > 1 else found

    patch.setattr(relation, "CLUSTER", 1)
    patch.setattr(relation, "_last", earlier)


def a_latch_stays_unquantified(patch: Patch) -> None:
    """The value before the tick is still there after it."""

    def kept(supports: list[set[int]], quantified: set[int]) -> list[set[int]]:
        return [own - {min(quantified, default=-1)} for own in _last(supports, quantified)]

    patch.setattr(relation, "_last", kept)


def a_cluster_is_missing(patch: Patch) -> None:
    def fewer(parts: list[Function]) -> Iterator[Function]:
        yield from list(_clusters(parts))[1:]

    patch.setattr(relation, "CLUSTER", 1)
    patch.setattr(relation, "_clusters", fewer)


def current_and_next_are_swapped_for_one_bit(patch: Patch) -> None:
    def swapped(space: Space) -> Iterator[Function]:
        for i, latch in enumerate(x for x in space.circuit.latches if x.literal in space.next):
            bit = (space.current if i == 0 else space.next)[latch.literal]
            yield space.manager.var(bit).equiv(space(latch.next))

    patch.setattr(relation, "equations", swapped)


def the_image_is_not_merged(patch: Patch) -> None:
    """Only the states of the last ring count as reached; since that has no end, it ends after 20."""

    def step(self: Layers) -> bool:
        self.closed = len(self.rings) == 20 or not _step(self)
        self.reached = self.rings[-1]
        return not self.closed

    patch.setattr(Layers, "step", step)


def the_assumption_is_forgotten(patch: Patch) -> None:
    with_circuit(patch, lambda c: replace(c, assume=TRUE))


def the_assumption_is_left_out_of_the_relation(patch: Patch) -> None:
    patch.setattr(layers, "relation", lambda space, _: _relation(space, space.manager.true()))


def the_domains_of_frozen_variables_are_forgotten(patch: Patch) -> None:
    with_circuit(patch, lambda c: replace(c, start=TRUE))


def a_latch_starts_with_any_value(patch: Patch) -> None:
    def free(latches: tuple[Latch, ...]) -> tuple[Latch, ...]:
        return tuple(replace(x, init=None) if i == 0 else x for i, x in enumerate(latches))

    with_circuit(patch, lambda c: replace(c, latches=free(c.latches)))


def an_input_has_one_value(patch: Patch) -> None:
    def image(self: Relation, states: Function) -> Function:
        fixed = self.space.cube(dict.fromkeys(self.space.inputs[:1], False))
        return _image(self, states & fixed)

    patch.setattr(Relation, "image", image)
    patch.setattr(relation, "_local", lambda _space, parts, _supports: parts)


def the_cut_may_have_any_values(patch: Patch) -> None:
    """Also those that no inputs give it."""
    patch.setattr(Layers, "_possible", lambda self: self.space.manager.true())


def the_outside_inputs_ignore_the_assumption(patch: Patch) -> None:
    with_circuit(patch, lambda c: replace(c, loose=TRUE))


def a_run_is_rebuilt_from_the_wrong_ring(patch: Patch) -> None:
    """Whatever leads to the state, whether it is reached or not."""

    def before(layers: Layers, ring: Function, after: runs.Bits) -> runs.Bits:
        found = layers.assume
        for literal, function in layers.next.items():
            found = found & (function if after[literal] else ~function)
        return runs._picked(found, layers.space.current)

    patch.setattr(runs, "_before", before)


class TestBdd(PatchSuite):
    FAULTS = (
        a_latch_is_quantified_too_early,
        a_latch_stays_unquantified,
        a_cluster_is_missing,
        current_and_next_are_swapped_for_one_bit,
        the_image_is_not_merged,
        the_assumption_is_forgotten,
        the_assumption_is_left_out_of_the_relation,
        the_domains_of_frozen_variables_are_forgotten,
        a_latch_starts_with_any_value,
        an_input_has_one_value,
        the_cut_may_have_any_values,
        the_outside_inputs_ignore_the_assumption,
        a_run_is_rebuilt_from_the_wrong_ring,
    )

    def wrong(self) -> Iterator[str]:
        return (example.system.name for example in examples() if disagrees(example))
