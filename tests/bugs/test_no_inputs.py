"""A system without inputs: its counterexample was calmed to no tick at all, and could not be replayed."""

from rovercheck.checker.results.verdict import Run
from rovercheck.checker.verify.runs.minimise import minimise_inputs
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import flag, var
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.lang.words import minimum


def test_a_run_without_inputs_keeps_its_ticks() -> None:
    n, late = var("n", integer(0, 3)), flag("late")
    count = Block("Count", [assign(n, minimum(n + 1, 3)), assign(late, n == 3)])
    run = Run({}, ({}, {}, {}))
    assert minimise_inputs(lower(in_order("S", count)), late, run) == run
