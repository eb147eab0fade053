"""Wheel monitors of Board 1: one chart per wheel, all reading the one coherence flag [spec §2.4, Table 2].

`isMotionConsistent` is the value last received from Board 2, also on a dead link (S31).
"""

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.signals.board1 import WHEELS, has_no_feedback, is_motion_consistent, wheel_status


def monitor_of_wheel(wheel: str) -> Chart:
    """The monitor of one wheel: FL, FR, RL or RR (S33)."""
    lost, status, consistent = has_no_feedback[wheel], wheel_status[wheel], is_motion_consistent
    return Chart(
        f"Monitor_wheel_{wheel}",
        [
            State("Wheel_OK", entry=[assign(status, "WHEEL_OK")], transitions=[to("decide")]),
            State("Wheel_DEG", entry=[assign(status, "WHEEL_DEGRADED_ENCODER")], transitions=[to("decide")]),
            State("Wheel_CRIT", entry=[assign(status, "WHEEL_CRITICAL_MOTOR")], transitions=[to("decide")]),
        ],
        default=[to("decide"), to("Wheel_OK")],
        junctions=[
            Junction(
                "decide",
                [
                    to("Wheel_CRIT", when=lost & ~consistent),  # both together, in one step (S28)
                    to("Wheel_DEG", when=lost & consistent),
                    to("Wheel_OK", when=~lost & consistent),
                    to("Wheel_DEG", when=~lost & ~consistent),  # no row covers it (S27)
                ],
            )
        ],
        text=f"Status of wheel {wheel} from its encoder and the agreement of IMU and odometry.",
    )


monitor_wheels = tuple(monitor_of_wheel(wheel) for wheel in WHEELS)
monitor_wheel_FL, monitor_wheel_FR, monitor_wheel_RL, monitor_wheel_RR = monitor_wheels
