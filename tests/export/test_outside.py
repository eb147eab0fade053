"""Other model checkers, where they are installed, say of our exports what our explicit engine says."""

import tempfile
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given

from rovercheck.checker.engines import Limits, engines, quiet
from rovercheck.checker.export import Bad, Problem, exporters, problem
from rovercheck.checker.results.verdict import Reached, Unreachable
from rovercheck.properties.catalogue import catalogue
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.domain import Domain, Num, boolean, chosen, integer
from rovercheck.spec_model.lang.expr import Apply, Const, Var, all_of, flag
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.rover import systems
from tests.export import read_aiger, read_btor2, read_smv
from tests.export.outside import Outcome, abc, needs_abc, needs_spin, spin
from tests.export.reading import Machine
from tests.naive import search
from tests.profiles import examples
from tests.strategies_ts import goals, transition_systems

FOR_ABC = ("PB1-10a", "PB1-11", "PB1-11b", "PB1-15", "PB1-17a")
FOR_SPIN = ("PB1-11", "PB1-13a", "PB1-15")


def each(system: TransitionSystem) -> list[tuple[Problem, Outcome]]:
    """A problem for each goal, and what a naive search says of it."""
    reached = search(system, goals(system)).reached
    return [
        (Problem("random", system, (Bad(g, "reached"),)), Outcome(g.name in reached, reached.get(g.name, 0)))
        for g in goals(system)
    ]


@needs_abc
@examples(40)
@given(transition_systems())
def test_abc_agrees_on_random_systems(system: TransitionSystem) -> None:
    with tempfile.TemporaryDirectory() as folder:
        for asked, expected in each(system):
            assert abc(asked, Path(folder)).reached == expected.reached
            if expected.reached:
                assert abc(asked, Path(folder), "bmc3") == expected


@needs_spin
@examples(8)
@given(transition_systems())
def test_spin_agrees_on_random_systems(system: TransitionSystem) -> None:
    with tempfile.TemporaryDirectory() as folder:
        for asked, expected in each(system):
            assert spin(asked, Path(folder)).reached == expected.reached


def of_the_rover(id: str) -> tuple[Problem, Outcome]:
    """The problem of a property, and what the explicit engine says of its first bad state."""
    prop = catalogue()[id]
    asked = problem(lower(systems()[prop.on]), prop)
    goal = asked.bad[0].var
    answer = engines()["explicit"].check(asked.system, [goal], Limits(), quiet)[goal.name]
    assert isinstance(answer, Reached | Unreachable)
    return asked, Outcome(True, len(answer.run)) if isinstance(answer, Reached) else Outcome(False)


@needs_abc
@pytest.mark.parametrize("id", FOR_ABC)
def test_abc_agrees_on_the_rover(id: str, tmp_path: Path) -> None:
    asked, expected = of_the_rover(id)
    assert abc(asked, tmp_path).reached == expected.reached
    if expected.reached:
        assert abc(asked, tmp_path, "bmc3") == expected


@needs_spin
@pytest.mark.parametrize("id", FOR_SPIN)
def test_spin_agrees_on_the_rover(id: str, tmp_path: Path) -> None:
    asked, expected = of_the_rover(id)
    assert spin(asked, tmp_path).reached == expected.reached


DOMAINS = [
    (integer(0, 3), 1),
    (integer(0, 255), 1),
    (integer(-3, 0), -1),
    (chosen([0, 1, 3]), 1),
    (boolean, 0),
]


@needs_spin
@pytest.mark.parametrize(("domain", "by"), DOMAINS)
def test_spin_sees_a_variable_leave_its_domain(domain: Domain, by: int, tmp_path: Path) -> None:
    x, beyond = Var("x", domain), flag("beyond")
    count = Assign(x, Apply(Op.ADD, (x, Const(by, Num())), Num()) if by else x)
    step = (Assign(beyond, x == (1000 if by else True)), count)
    system = TransitionSystem("leaves", (), (), (x, beyond), (), step)
    assert spin(Problem("leaves", system, (Bad(beyond, "never"),)), tmp_path).reached == bool(by)


@needs_spin
def test_spin_reads_a_negation_of_a_negation(tmp_path: Path) -> None:
    before, goal = flag("before"), flag("goal")
    twice = Apply(Op.NOT, (Apply(Op.NOT, (before,), before.sort),), before.sort)
    system = TransitionSystem(
        "twice", (), (), (before, goal), (), (Assign(goal, twice), Assign(before, goal))
    )
    assert not spin(Problem("twice", system, (Bad(goal, "never"),)), tmp_path).reached


ODD = ("linux", "é; \n*/", "do", "0", "t0")
"""Names that SPIN, its C preprocessor or a comment would take for something else."""


def oddly_named() -> Problem:
    """Five variables count together to 1 and stay there; the last tells when all have."""
    parts = [Var(name, integer(0, 1)) for name in ODD]
    goal = flag("goal\nbad")
    ones = (Assign(v, Apply(Op.MAX, (v, Const(1, Num())), Num())) for v in parts)
    step = (*ones, Assign(goal, all_of(*(v == 1 for v in parts))))
    system = TransitionSystem("odd", (), (), (*parts, goal), (), step)
    return Problem("odd", system, (Bad(goal, "all\nare 1"),), ("two\nlines */",))


@needs_spin
def test_spin_reads_odd_names(tmp_path: Path) -> None:
    assert spin(oddly_named(), tmp_path).reached


@needs_abc
def test_abc_reads_odd_names(tmp_path: Path) -> None:
    assert abc(oddly_named(), tmp_path) == Outcome(True, 1)


@pytest.mark.parametrize("format", ["aag", "btor2", "smv"])
def test_a_name_or_a_comment_never_begins_a_line(format: str) -> None:
    readers: dict[str, Callable[[bytes], Machine]]
    readers = {"aag": read_aiger.read, "btor2": read_btor2.read, "smv": read_smv.read}
    machine = readers[format](str(exporters()[format].export(oddly_named())).encode())
    machine.start({})
    allowed, bad = machine.tick({})
    assert allowed and list(bad.values()) == [True]
