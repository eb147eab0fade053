"""Why the rover slows down, stops or changes hands: causes of the safety state, of a switch, of a return."""

from rovercheck.spec_model.ambiguity import choose
from rovercheck.spec_model.lang.expr import FALSE, any_of
from rovercheck.spec_model.lang.words import named
from rovercheck.spec_model.signals.board1 import b1_critical, b1_degraded, b2_critical, b2_degraded
from rovercheck.spec_model.signals.board2_supervisor import (
    b1_emergency,
    b1_requests_switch,
    b1_sup_status,
    b2_emergency,
    rx_status,
)

critical = b1_critical | b2_critical
"""A critical cause in either board [spec §2.7, Fig 21]."""
degraded = b1_degraded | b2_degraded
"""A degraded cause in either board [spec §2.7, Fig 21]."""

emergency = named("emergency", b1_emergency | b2_emergency)
"""While Board 2 drives: a critical fault of a board beyond the link between them [design] (E23)."""

_rx, _sup = rx_status == "RX_CRITICAL", b1_sup_status == "SUP_CRITICAL"
_not_both_ok = ~((rx_status == "RX_OK") & (b1_sup_status == "SUP_OK"))
_link_fault = choose("S43", {"OR": _rx | _sup, "AND": _rx & _sup})
_silent = choose("S44", {"NOT-CRIT": _link_fault, "STRICT-OK-KEPT": _link_fault, "STRICT-OK-1": _not_both_ok})
_own_view = choose("E22", {"RELAY-AND-FLAG": _silent, "B2-ONLY": _silent, "B1-ONLY": FALSE})

q = named("q", any_of(b1_requests_switch, _own_view))
"""Board 2 is to move the rover: asked by Board 1, or reception or Board 1 critical [spec §2.5] (E21, E22)."""
