"""Wheel monitors of Board 1: one chart per wheel, all reading the one coherence flag [seed §2.4, Table 2].

`isMotionConsistent` is the value last received from Board 2, also on a dead link (S31).
"""

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.readings import choose, under
from rovercheck.spec_model.signals.board1 import (
    WHEELS,
    has_no_feedback,
    is_motion_consistent,
    rx_age,
    wheel_status,
)


def monitor_of_wheel(wheel: str, age: Var = rx_age) -> Chart:
    """The monitor of one wheel: FL, FR, RL or RR (S33); ``age`` is that of the last frame."""
    on_a_dead_link = age > 120  # nothing speaks against it
    consistent = choose(
        "S31", {"LAST-VALUE": is_motion_consistent, "IGNORE": is_motion_consistent | on_a_dead_link}
    )
    flag, status = has_no_feedback[wheel], wheel_status[wheel]
    lost = choose("S32", {"TRUE=NO-FEEDBACK": flag, "TRUE=CORRESPONDENCE": ~flag})
    ok = choose("S27", {"HOLD": ~lost & consistent, "OK": ~lost, "DEG": ~lost & consistent})
    released = choose("S30", {"FOLLOW": True, "LATCH": ~lost & consistent})  # from critical
    return Chart(
        f"Monitor_wheel_{wheel}",
        [
            State(
                "Wheel_OK",
                entry=[assign(status, "WHEEL_OK")],
                transitions=[
                    to("Wheel_DEG", when=under("S28", "SEQ") & lost & ~consistent),
                    to("decide"),
                ],
            ),
            State("Wheel_DEG", entry=[assign(status, "WHEEL_DEGRADED_ENCODER")], transitions=[to("decide")]),
            State(
                "Wheel_CRIT",
                entry=[assign(status, "WHEEL_CRITICAL_MOTOR")],
                transitions=[to("decide", when=choose("S29", {"FOLLOW": released, "LATCH": False}))],
            ),
        ],
        default=[
            to("Wheel_DEG", when=under("S28", "SEQ") & under("S65", "CLASSIFY") & lost & ~consistent),
            to("decide", when=under("S65", "CLASSIFY")),
            to("Wheel_OK"),
        ],
        junctions=[
            Junction(
                "decide",
                [
                    to("Wheel_CRIT", when=lost & ~consistent),  # both together, in one step (S28)
                    to("Wheel_DEG", when=lost & consistent),
                    to("Wheel_OK", when=ok),
                    to("Wheel_DEG", when=under("S27", "DEG") & ~lost & ~consistent),
                ],
            )
        ],
        text=f"Status of wheel {wheel} from its encoder and the agreement of IMU and odometry.",
    )


monitor_wheels = tuple(monitor_of_wheel(wheel) for wheel in WHEELS)
monitor_wheel_FL, monitor_wheel_FR, monitor_wheel_RL, monitor_wheel_RR = monitor_wheels
