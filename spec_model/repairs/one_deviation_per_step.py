"""Obstacles: a deviation that ends is not followed by another one in the same step."""

from dataclasses import replace

from rovercheck.spec_model.lang.chart import Chart, Transition
from rovercheck.spec_model.lang.edit import edit_transitions
from rovercheck.spec_model.lang.expr import all_of
from rovercheck.spec_model.lang.time import tick
from rovercheck.spec_model.lang.words import after
from rovercheck.spec_model.repairs import Repair


def from_the_next_step_on(chart: Chart) -> Chart:
    """Two signals in one step execute B2Decisions twice: the second finds the Waiting of the first."""

    def wait(transition: Transition) -> Transition:
        if not (transition.event or "").startswith("moveTo"):
            return transition
        later = after(1 * tick)
        return replace(
            transition, guard=later if transition.guard is None else all_of(transition.guard, later)
        )

    return edit_transitions(
        chart, "B2Decisions.Waiting", lambda found: [wait(transition) for transition in found]
    )


one_per_step = Repair(
    name="one-deviation-per-step",
    text="Waiting of B2Decisions follows a signal to deviate only from the step after its entry.",
    fixes=("PB2-09b-straight", "PB2-09c-right", "PB2-10-most", "PB2-09-straight"),
    charts={"Obstacles": from_the_next_step_on},
)
