"""Heartbeat monitor of Board 1: does the supervisor of Board 2 still run [seed §2.4, Table 2].

The heartbeat travels in the frames, so a dead link also stops it; each row is read by itself (S41).
"""

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.lang.words import duration, named
from rovercheck.spec_model.readings import choose, under
from rovercheck.spec_model.signals.board1 import b2_sup_status, heartbeat_age, heartbeat_slow, rx_age


def heartbeat_monitor(age: Var, frame_age: Var) -> Chart:
    """The monitor for ages in ms of the last new heartbeat and of the last valid frame."""
    silent = choose(
        "S37", {"GT": named("age_S > 120 ms", age > 120), "GE": named("age_S >= 120 ms", age >= 120)}
    )
    dead_link = choose("S37", {"GT": frame_age > 120, "GE": frame_age >= 120})
    # A dead link freezes the heartbeat; where that masks the rows, the status is kept meanwhile (S41).
    judged = choose("S41", {"INDEPENDENT": True, "MASKED": ~dead_link})
    # No hold time is given: 2 s, as Board 2 has it for the supervisor of Board 1 (E29).
    released = choose(
        "S38", {"FIRST-FRESH": True, "MEAN-BASED": ~heartbeat_slow, "HOLD-TIME": duration(~silent) > 2 * sec}
    )
    return Chart(
        "Monitor_heartbeat",
        [
            State("Sup_OK", entry=[assign(b2_sup_status, "SUP_OK")], transitions=[to("decide", when=judged)]),
            State(
                "Sup_DEG",
                entry=[assign(b2_sup_status, "SUP_DEGRADED")],
                transitions=[to("decide", when=judged)],
            ),
            State(
                "Sup_CRIT",
                entry=[assign(b2_sup_status, "SUP_CRITICAL")],
                transitions=[to("decide", when=judged & released)],
            ),
        ],
        default=[to("decide", when=judged & under("S65", "CLASSIFY")), to("Sup_OK")],
        junctions=[
            Junction(
                "decide",
                [
                    to("Sup_DEG", when=heartbeat_slow & under("S39", "DEG-WINS")),
                    to("Sup_CRIT", when=silent),  # strict (S37); wins over a slow mean (S39)
                    to("Sup_DEG", when=heartbeat_slow & under("S39", "CRIT-WINS")),
                    to("Sup_OK"),  # released by the first new heartbeat (S38)
                ],
            )
        ],
        text="Status of the Board 2 supervisor from the age of its heartbeat and the mean of ten intervals.",
    )


monitor_heartbeat = heartbeat_monitor(heartbeat_age, rx_age)
