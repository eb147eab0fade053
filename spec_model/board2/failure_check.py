"""Check for a failure of Board 1: decides whether Board 2 may send motor commands (E21, E22).

The counterpart of the relay decision of Board 1; the two are not synchronised, but read the same
sentences (S43 to S45).
"""

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.expr import any_of
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.lang.words import duration, named
from rovercheck.spec_model.signals.board2_supervisor import (
    autorized_to_send_command,
    b1_requests_switch,
    b1_sup_status,
    rx_status,
)

rx_critical, sup_critical = rx_status == "RX_CRITICAL", b1_sup_status == "SUP_CRITICAL"
q = named("q", any_of(b1_requests_switch, rx_critical, sup_critical))

check_board1 = Chart(
    "Check_Board1",
    [
        State(
            "B1_actuating",
            entry=[assign(autorized_to_send_command, False)],
            transitions=[to("B2_trying_to_actuate", when=q)],
        ),
        State(
            "B2_trying_to_actuate",
            entry=[assign(autorized_to_send_command, True)],
            transitions=[
                to("B1_actuating", when=duration(named("!q", ~q)) > 3 * sec),
            ],
        ),
    ],
    default="B1_actuating",
    text="Whether Board 2 is authorised to send motor commands.",
)
