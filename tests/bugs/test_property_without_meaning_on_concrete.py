"""A run is reproduced on a concrete system only if the property can be asked about that one."""

from rovercheck import always, assign, in_order, integer, model, var
from rovercheck.checker.results.verdict import Unknown
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.searches import SearchSettings, events
from rovercheck.spec_model.lang.chart import Block


def test_a_property_of_a_free_value_is_unknown_where_that_is_not_free() -> None:
    """`check --variant` ended with exit code 4, and no verdict about anything else."""
    before, level = var("before", integer(0, 9)), var("level", integer(0, 9))
    exact = in_order("exact", Block("Count", [assign(level, 1)]), text="Counts.")
    free = in_order(
        "free", Block("Count", [assign(level, before)]), over=True, concrete="exact", text="From any value."
    )
    prop = always("P-1", "It is 3, or was 4.", that=(level == 3) | (before == 4), covers=["R-1"], on=free)
    checked = model(exact, free, prop)
    [found] = (
        one for one in events([*checked.properties.values()], checked.systems, SearchSettings())
        if isinstance(one, Result)
    )  # fmt: skip
    assert (
        isinstance(found.verdict, Unknown)
        and "exact, on which it would be reproduced" in found.verdict.reason
    )
