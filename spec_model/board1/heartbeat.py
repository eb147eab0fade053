"""Heartbeat monitor of Board 1: does the supervisor of Board 2 still run [spec §2.4, Table 2].

The heartbeat travels in the frames, so a dead link also stops it; each row is read by itself (S41).
"""

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.words import named
from rovercheck.spec_model.signals.board1 import b2_sup_status, heartbeat_age, heartbeat_slow


def heartbeat_monitor(age: Var) -> Chart:
    """The monitor for an age of the last new heartbeat in ms, however fine its steps."""
    silent = named("age_S > 120 ms", age > 120)
    return Chart(
        "Monitor_heartbeat",
        [
            State("Sup_OK", entry=[assign(b2_sup_status, "SUP_OK")], transitions=[to("decide")]),
            State(
                "Sup_DEG",
                entry=[assign(b2_sup_status, "SUP_DEGRADED")],
                transitions=[to("decide")],
            ),
            State(
                "Sup_CRIT",
                entry=[assign(b2_sup_status, "SUP_CRITICAL")],
                transitions=[to("decide")],
            ),
        ],
        default=[to("decide"), to("Sup_OK")],
        junctions=[
            Junction(
                "decide",
                [
                    to("Sup_CRIT", when=silent),  # strict (S37); wins over a slow mean (S39)
                    to("Sup_DEG", when=heartbeat_slow),
                    to("Sup_OK"),  # released by the first new heartbeat (S38)
                ],
            )
        ],
        text="Status of the Board 2 supervisor from the age of its heartbeat and the mean of ten intervals.",
    )


monitor_heartbeat = heartbeat_monitor(heartbeat_age)
