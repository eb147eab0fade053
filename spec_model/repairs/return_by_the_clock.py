"""Relay and authorisation: the 3 s before the motors return are measured, not counted in steps."""

from dataclasses import replace

from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.edit import everywhere, in_expressions
from rovercheck.spec_model.lang.expr import Expr, Temporal, When
from rovercheck.spec_model.lang.time import ms
from rovercheck.spec_model.repairs import Repair

LENGTH = 3020 * ms
"""More than 3 s, and as long as 151 steps of 20 ms."""


def _measured(chart: Chart) -> Chart:
    def change(expr: Expr) -> Expr:
        if isinstance(expr, Temporal) and expr.when is When.DURATION:
            return replace(expr, when=When.HELD, span=LENGTH, strict=False)
        return expr

    return in_expressions(chart, lambda expr: everywhere(expr, change))


return_by_the_clock = Repair(
    name="return-by-the-clock",
    text=(
        "The transitions back to B1_actuating of Fig 16 and of its counterpart on Board 2 compare now_ms "
        "with the time of the first step of the sound stretch, as the monitors of Table 2 do: 3.02 s, in "
        "steps of 20 ms as today."
    ),
    fixes=("PB1-44a", "PB2-58a"),
    charts={"Relay": _measured, "Check_Board1": _measured},
    gives_up={"REACH-RELAY-EARLY": "It shows that the motors may return too early."},
)
