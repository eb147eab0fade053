"""Cells of inputs: exact, and no finer than the formulas ask for."""

from hypothesis import given

from rovercheck.checker.system.partition import Partition, expressions, partitions
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import Bool, chosen, integer
from rovercheck.spec_model.lang.evaluate import admissible, step
from rovercheck.spec_model.lang.expr import TRUE, Apply, Expr, Var, all_of, any_of, flag, ite, var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import Program, TransitionSystem
from rovercheck.spec_model.lang.words import absolute, named
from tests.naive import vectors
from tests.strategies_ts import transition_systems

DISTANCE = var("d", integer(0, 1000))
OTHER = var("e", integer(0, 9))
COUNT = var("count", integer(-20, 1100))
GOAL = flag("goal")


def cells(*conditions: Expr, assume: Expr = TRUE, more: Program = ()) -> Partition:
    program = (*(If(c, (Assign(GOAL, TRUE),)) for c in conditions), *more)
    system = TransitionSystem("", (DISTANCE, OTHER), (), (GOAL, COUNT), (), program, assume)
    return partitions(system)["d"]


def values(own: Partition) -> list[tuple[int, int]]:
    return [(c.value, c.size) for c in own.cells]


def test_a_range_counts_as_one_condition() -> None:
    assert values(cells((DISTANCE > 100) & (DISTANCE <= 300))) == [(0, 801), (101, 200)]


def test_conditions_beside_others_in_one_conjunction_count_together() -> None:
    assert len(cells(all_of(DISTANCE > 100, GOAL, DISTANCE <= 300)).cells) == 2
    assert len(cells(any_of(DISTANCE <= 100, ~GOAL, DISTANCE > 300)).cells) == 2
    assert len(cells(DISTANCE > 100, DISTANCE <= 300).cells) == 3


def test_names_are_seen_through() -> None:
    assert values(cells(named("near", DISTANCE <= 70))) == [(0, 71), (71, 930)]


def test_an_input_that_is_copied_or_mixed_keeps_its_values() -> None:
    assert len(cells(more=(Assign(COUNT, DISTANCE),)).cells) == 1001
    assert len(cells(DISTANCE + OTHER > 5).cells) == 1001
    assert len(cells(DISTANCE > OTHER).cells) == 1001


def test_a_formula_about_the_input_alone_is_one_value() -> None:
    clamp = ite(DISTANCE > 3, DISTANCE * 0 + 3, DISTANCE)
    assert values(cells(more=(Assign(COUNT, clamp),))) == [(0, 1), (1, 1), (2, 1), (3, 998)]
    assert len(cells(absolute(DISTANCE - 500) > 100).cells) == 2


def test_an_unread_input_has_one_cell() -> None:
    assert values(cells(GOAL)) == [(0, 1001)]


def test_the_assumption_about_one_input_bounds_its_values() -> None:
    assert values(cells(DISTANCE > 100, assume=(DISTANCE > 50) & (OTHER < 5))) == [(51, 50), (101, 900)]
    assert cells(assume=DISTANCE > 1000).cells == ()


def test_the_assumption_bounds_values_however_its_conjunctions_are_nested() -> None:
    """Conjuncts about one input are met by its cells alone: the paths of a tick do not test them again."""
    inner = Apply(Op.AND, (DISTANCE > 50, OTHER > DISTANCE), Bool())
    for first in (inner, named("near", inner)):
        nested = Apply(Op.AND, (first, OTHER < 5), Bool())
        assert cells(assume=nested).cells[0].value == 51


def test_sparse_domains_and_members() -> None:
    sonar = var("d", chosen([-1, 70, 100, 300]))
    program = (If(sonar >= 100, (Assign(GOAL, TRUE),)),)
    own = partitions(TransitionSystem("", (sonar,), (), (GOAL,), (), program))["d"]
    assert values(own) == [(-1, 2), (100, 2)]
    assert [list(own.members(i)) for i in (0, 1)] == [[-1, 70], [100, 300]]
    assert own.cell_of == {-1: 0, 70: 0, 100: 1, 300: 1}


def test_numbers_beyond_64_bits() -> None:
    wide = var("d", chosen([0, 1 << 40, 1 << 41]))
    program = (If(wide * wide * wide > 1 << 121, (Assign(GOAL, TRUE),)),)
    own = partitions(TransitionSystem("", (wide,), (), (GOAL,), (), program))["d"]
    assert values(own) == [(0, 2), (1 << 41, 1)]


@given(transition_systems())
def test_values_of_a_cell_behave_alike(system: TransitionSystem) -> None:
    found = partitions(system)
    at = {**system.init, **{v.name: v.init for v in system.frozen}}
    for inputs in vectors(system.inputs):
        if all(n in found[v].cell_of for v, n in inputs.items()):
            alike = {v: found[v].cells[found[v].cell_of[n]].value for v, n in inputs.items()}
            assert admissible(system, at, inputs) == admissible(system, at, alike)
            assert _after(system, at, inputs) == _after(system, at, alike)
        else:
            assert not admissible(system, at, inputs)


def _after(system: TransitionSystem, at: dict[str, int], inputs: dict[str, int]) -> dict[str, int]:
    after = step(system, at, inputs)
    return {v.name: after[v.name] for v in system.variables}


@given(transition_systems())
def test_sizes_add_up(system: TransitionSystem) -> None:
    assert list(expressions(system.step))
    for own in partitions(system).values():
        assert sum(c.size for c in own.cells) == len(own.values) <= len(own.var.domain)
        assert [c.value for c in own.cells] == [next(own.members(i)) for i in range(len(own.cells))]


def test_the_type_of_a_variable_does_not_matter() -> None:
    ready: Var = flag("ready")
    system = TransitionSystem("", (ready,), (), (GOAL,), (), (Assign(GOAL, ready),))
    assert values(partitions(system)["ready"]) == [(0, 1), (1, 1)]
