"""A variable that is 0 in every run had no bits, and the engines on bits failed on it."""

import pytest

from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.results.verdict import Proved
from rovercheck.checker.verify.searches import SearchSettings
from rovercheck.properties.forms import always, never
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import flag, var
from rovercheck.spec_model.lang.system import in_order

none = var("none", integer(0, 0))
kept, seen = var("kept", integer(0, 0)), flag("seen")
SYSTEM = in_order("zero", Block("B", [assign(seen, seen | (none > 0)), assign(kept, none)]))
PROPERTIES = (
    never("ZERO-1", "Nothing is seen.", that=seen, covers=["R1"], on=SYSTEM.name),
    always("ZERO-2", "What is kept is what came.", that=kept == none, covers=["R1"], on=SYSTEM.name),
)


@pytest.mark.parametrize("engine", ["bdd", "pdr", "kinduction", "explicit"])
def test_a_variable_of_one_value_is_decided(engine: str) -> None:
    found = list(results(PROPERTIES, {SYSTEM.name: SYSTEM}, SearchSettings(engine)))
    assert [type(result.verdict) for result in found] == [Proved, Proved]
