"""Backward_mode_toggle: four presses of the joystick buttons switch backward mode on and off [spec Fig 19].

The combination is btn1, btn1, btn2, btn2 with the stick at rest, at most 1 s from press to press (S59).
"""

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.lang.words import after, rising


def backward_mode_toggle(
    name: str, *, btn1: Var, btn2: Var, x_norm: Var, y_norm: Var, backward_enabled: Var
) -> Chart:
    """The region of the reference chart that writes ``backward_enabled``, on the signals of one board."""
    too_late = to("too_late", when=after(1 * sec))
    return Chart(
        name,
        [
            State(
                "Combo_starting_point",
                transitions=[to("Combo_toggle_backward", when=rising(btn1) & (x_norm == 0) & (y_norm == 0))],
            ),
            State(
                "Combo_toggle_backward",
                transitions=[to("Combo_starting_point", when=(x_norm != 0) | (y_norm != 0))],
                default="Step2",
                states=[
                    State("Step2", transitions=[to("Step3", when=rising(btn1)), too_late]),
                    State("Step3", transitions=[to("Step4", when=rising(btn2)), too_late]),
                    State(
                        "Step4",
                        transitions=[
                            to(
                                "Combo_starting_point",
                                when=rising(btn2),
                                do=[assign(backward_enabled, ~backward_enabled)],
                            ),
                            too_late,
                        ],
                    ),
                ],
                # Three transitions meet here; each counts the time of the step it leaves.
                junctions=[Junction("too_late", [to("Combo_starting_point")])],
            ),
        ],
        default=to("Combo_starting_point", do=[assign(backward_enabled, False)]),
        text="Backward mode, toggled by btn1, btn1, btn2, btn2 with the stick at rest.",
    )
