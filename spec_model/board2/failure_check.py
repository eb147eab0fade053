"""Check for a failure of Board 1: decides whether Board 2 may send motor commands (E21, E22).

The counterpart of the relay decision of Board 1; the two are not synchronised, but read the same
sentences (S43 to S45).  Under B1-ONLY only Board 1 authorises, by its request; under B2-ONLY the
decision needs no relay (``composition.motors``).
"""

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.expr import FALSE, any_of
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.lang.words import duration, named
from rovercheck.spec_model.readings import choose
from rovercheck.spec_model.signals.board2_supervisor import (
    autorized_to_send_command,
    b1_requests_switch,
    b1_sup_status,
    rx_status,
)

rx_critical, sup_critical = rx_status == "RX_CRITICAL", b1_sup_status == "SUP_CRITICAL"
both_ok = (rx_status == "RX_OK") & (b1_sup_status == "SUP_OK")

link_fault = choose("S43", {"OR": rx_critical | sup_critical, "AND": rx_critical & sup_critical})
silent = choose("S44", {"NOT-CRIT": link_fault, "STRICT-OK-KEPT": link_fault, "STRICT-OK-1": ~both_ok})
own_view = choose("E22", {"RELAY-AND-FLAG": silent, "B2-ONLY": silent, "B1-ONLY": FALSE})
q = named("q", any_of(b1_requests_switch, own_view))

not_critical = choose("S43", {"OR": ~q, "AND": ~(b1_requests_switch | rx_critical | sup_critical)})
all_ok = ~b1_requests_switch & both_ok
returned = choose("S44", {"NOT-CRIT": not_critical, "STRICT-OK-KEPT": all_ok, "STRICT-OK-1": all_ok})
back = named("!q", choose("E22", {"RELAY-AND-FLAG": returned, "B2-ONLY": returned, "B1-ONLY": ~q}))

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
                to(
                    "B1_actuating",
                    when=choose("S45", {"IMMEDIATE": back, "3-S": duration(back) > 3 * sec}),
                ),
            ],
        ),
    ],
    default="B1_actuating",
    text="Whether Board 2 is authorised to send motor commands.",
)
