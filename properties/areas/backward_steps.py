"""What one step makes of the combination that switches backward mode, on either board (S59).

btn1, btn1, btn2, btn2 with the stick at rest, at most 1 s from press to press [design].
"""

from collections.abc import Iterator

from rovercheck.properties.forms import Property, always, precedes
from rovercheck.spec_model.board1.backward import toggle
from rovercheck.spec_model.board2.backward import toggle_2
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.expr import Var, all_of, any_of, implies
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import held, previous, rising
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2_motion as b2

START = "Combo_starting_point"


def _combination(
    id: str, chart: Chart, btn1: Var, btn2: Var, x: Var, y: Var, backward: Var, covers: str, on: str
) -> Iterator[Property]:
    hands_off = (x == 0) & (y == 0)
    presses = [
        (START, btn1, "Step2"),
        ("Step2", btn1, "Step3"),
        ("Step3", btn2, "Step4"),
        ("Step4", btn2, START),
    ]

    yield precedes(
        f"{id}a", "Backward mode is off until btn2 is pressed for the first time.",
        first=rising(btn2) & hands_off, then=backward, covers=[covers], on=on, interpretations=["S59"],
    )  # fmt: skip
    yield always(
        f"{id}b", "With the stick at rest each press that is in time leads the combination on.",
        that=all_of(*(
            implies(previous(chart.active(before)) & rising(button) & hands_off, chart.active(after))
            for before, button, after in presses
        )),
        covers=[covers], on=on, from_tick=2, interpretations=["S59"],
    )  # fmt: skip
    yield always(
        f"{id}c", "The fourth press changes backward mode.",
        that=implies(
            previous(chart.active("Step4")) & rising(btn2) & hands_off, backward != previous(backward)
        ),
        covers=[covers], on=on, from_tick=2, interpretations=["S59"],
    )  # fmt: skip
    yield always(
        f"{id}d", "No step of the combination is reached without its press from the step before.",
        that=all_of(*(
            implies(
                chart.active(after) & ~previous(chart.active(after)),
                previous(chart.active(before)) & rising(button) & hands_off,
            )
            for before, button, after in presses[:-1]
        )),
        covers=[covers], on=on, interpretations=["S59"],
    )  # fmt: skip
    yield always(
        f"{id}e", "A step of the combination ends only by its press, a touch of the stick, or after 1 s.",
        that=all_of(*(
            implies(
                previous(chart.active(before)) & ~chart.active(before),
                any_of(rising(button), ~hands_off, previous(held(chart.active(before), for_=49 * ticks))),
            )
            for before, button, _ in presses[1:]
        )),
        covers=[covers], on=on, from_tick=2, interpretations=["S59"],
    )  # fmt: skip


PB1_41a, PB1_41b, PB1_41c, PB1_41d, PB1_41e = _combination(
    "PB1-41", toggle, b1.btn1, b1.btn2, b1.x_norm, b1.y_norm, b1.backward_enabled, "B1-REF-02", "backward"
)
PB2_34a, PB2_34b, PB2_34c, PB2_34d, PB2_34e = _combination(
    "PB2-34", toggle_2, b2.btn1, b2.btn2, b2.bx_norm, b2.ay_norm, b2.backward_enabled, "B2-REF-01",
    "backward_2",
)  # fmt: skip
