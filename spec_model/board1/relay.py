"""Decides whether Board 2 may move the rover [seed §2.5, Fig 16].

`give_b2_actuation` true: the relay is open and Board 2 moves the rover.  Only reception and the Board 2
supervisor count (S43, S50), only their critical level (S44), and Board 1 takes the motors back after
more than 3 s without it (S45, S46).
"""

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.lang.words import duration
from rovercheck.spec_model.readings import choose
from rovercheck.spec_model.signals.board1 import b2_sup_status, critical_mask, give_b2_actuation, rx_status

rx_critical = rx_status == "RX_CRITICAL"
sup_critical = b2_sup_status == "SUP_CRITICAL"
neither_critical = (rx_status != "RX_CRITICAL") & (b2_sup_status != "SUP_CRITICAL")
both_ok = (rx_status == "RX_OK") & (b2_sup_status == "SUP_OK")

link_fault = choose("S43", {"OR": rx_critical | sup_critical, "AND": rx_critical & sup_critical})
given = choose("S44", {"NOT-CRIT": link_fault, "STRICT-OK-KEPT": link_fault, "STRICT-OK-1": ~both_ok})
returned = choose("S44", {"NOT-CRIT": neither_critical, "STRICT-OK-KEPT": both_ok, "STRICT-OK-1": both_ok})

give = choose("S50", {"RX/SUP-ONLY": given, "ANY-CRITICAL": given | (critical_mask != 0)})
give_back = choose("S50", {"RX/SUP-ONLY": returned, "ANY-CRITICAL": returned & (critical_mask == 0)})

relay = Chart(
    "Relay",
    [
        State(
            "B1_actuating",
            entry=[assign(give_b2_actuation, False)],
            transitions=[
                to("B2_actuating", when=give),
            ],
        ),
        State(
            "B2_actuating",
            entry=[assign(give_b2_actuation, True)],
            transitions=[
                to(
                    "B1_actuating",
                    when=choose("S45", {"IMMEDIATE": give_back, "3-S": duration(give_back) > 3 * sec}),
                ),
            ],
        ),
    ],
    default="B1_actuating",
    text="Who moves the rover: Board 1, or Board 2 while reception or its supervisor is critical.",
)
