"""Check for a failure of Board 1: decides whether Board 2 may send motor commands (E21, E22).

The counterpart of the relay decision of Board 1; the two are not synchronised.  Under B1-ONLY only
Board 1 authorises, by its request; under B2-ONLY the decision needs no relay (``composition.motors``).
"""

from spec_model.lang.action import assign
from spec_model.lang.chart import Chart, State, to
from spec_model.lang.expr import FALSE, any_of
from spec_model.lang.time import sec
from spec_model.lang.words import duration, named
from spec_model.readings import choose
from spec_model.signals.board2_supervisor import (
    autorized_to_send_command,
    b1_requests_switch,
    b1_sup_status,
    rx_status,
)

silent = (rx_status == "RX_CRITICAL") | (b1_sup_status == "SUP_CRITICAL")
own_view = choose("E22", {"RELAY-AND-FLAG": silent, "B2-ONLY": silent, "B1-ONLY": FALSE})
q = named("q", any_of(b1_requests_switch, own_view))

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
            transitions=[to("B1_actuating", when=duration(~q) > 3 * sec)],
        ),
    ],
    default="B1_actuating",
    text="Whether Board 2 is authorised to send motor commands.",
)
