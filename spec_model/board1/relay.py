"""Decides whether Board 2 may move the rover [spec §2.5, Fig 16].

`give_b2_actuation` true: the relay is open and Board 2 moves the rover.  Only reception and the Board 2
supervisor count (S43, S50), only their critical level (S44), and Board 1 takes the motors back after
more than 3 s without it (S45, S46).
"""

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.lang.words import duration
from rovercheck.spec_model.signals.board1 import b2_sup_status, give_b2_actuation, rx_status

rx_critical = rx_status == "RX_CRITICAL"
sup_critical = b2_sup_status == "SUP_CRITICAL"
neither_critical = (rx_status != "RX_CRITICAL") & (b2_sup_status != "SUP_CRITICAL")

relay = Chart(
    "Relay",
    [
        State(
            "B1_actuating",
            entry=[assign(give_b2_actuation, False)],
            transitions=[to("B2_actuating", when=rx_critical | sup_critical)],
        ),
        State(
            "B2_actuating",
            entry=[assign(give_b2_actuation, True)],
            transitions=[to("B1_actuating", when=duration(neither_critical) > 3 * sec)],
        ),
    ],
    default="B1_actuating",
    text="Who moves the rover: Board 1, or Board 2 while reception or its supervisor is critical.",
)
