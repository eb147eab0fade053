"""What must be true of the reception and heartbeat statuses of Board 1 [spec Table 2].

Bits 2 and 7 of the masks follow the two statuses by PB1-10.
"""

from collections.abc import Iterator

from rovercheck.properties.forms import Property, always, holds_after, reachable
from rovercheck.properties.past import ago, at_least
from rovercheck.spec_model.board1.heartbeat import monitor_heartbeat
from rovercheck.spec_model.board1.reception import monitor_reception
from rovercheck.spec_model.lang.expr import Expr, all_of, const, implies, ite
from rovercheck.spec_model.lang.time import ms, ticks
from rovercheck.spec_model.lang.words import previous
from rovercheck.spec_model.signals.board1 import (
    b2_sup_status,
    heartbeat_age,
    heartbeat_slow,
    heartbeat_update,
    rx_age,
    rx_slow,
    rx_status,
    rx_update,
)


def _apart(update: Expr) -> Expr:
    """No update within 60 ms after another."""
    return implies(update, ~previous(update) & ~previous(previous(update)))


PB1_07a = always(
    "PB1-07a", "While no valid frame has arrived for more than 120 ms the reception is critical.",
    that=implies(rx_age > 120, rx_status == "RX_CRITICAL"),
    covers=["B1-RX-03"], on="reception", from_tick=2, interpretations=["S37", "S38", "S39"],
)  # fmt: skip
PB1_07b = always(
    "PB1-07b", "While the heartbeat has not changed for more than 120 ms the supervisor is critical.",
    that=implies(heartbeat_age > 120, b2_sup_status == "SUP_CRITICAL"),
    covers=["B1-SUP-03"], on="heartbeat", from_tick=2, interpretations=["S37", "S38", "S39"],
)  # fmt: skip
PB1_08a = always(
    "PB1-08a", "The reception is OK if and only if its age is at most 120 ms and its mean not above 40 ms.",
    that=(rx_status == "RX_OK") == ((rx_age <= 120) & ~rx_slow),
    covers=["B1-RX-02", "B1-RX-03", "B1-RX-04"], on="reception", from_tick=2, interpretations=["S34", "S38"],
)  # fmt: skip
PB1_08b = always(
    "PB1-08b",
    "The supervisor is OK if and only if its heartbeat is at most 120 ms old and its mean not above 40 ms.",
    that=(b2_sup_status == "SUP_OK") == ((heartbeat_age <= 120) & ~heartbeat_slow),
    covers=["B1-SUP-02", "B1-SUP-03", "B1-SUP-04"], on="heartbeat", from_tick=2,
    interpretations=["S34", "S38"],
)  # fmt: skip
PB1_08g = always(
    "PB1-08g", "A mean of ten intervals that becomes slow degrades the reception in the same step.",
    that=implies((rx_age <= 120) & rx_slow, rx_status == "RX_DEGRADED"),
    covers=["B1-RX-02"], on="reception_exact", from_tick=2, interpretations=["S34", "S38"],
)  # fmt: skip
PB1_08h = always(
    "PB1-08h", "A mean of ten intervals that becomes slow degrades the supervisor in the same step.",
    that=implies((heartbeat_age <= 120) & heartbeat_slow, b2_sup_status == "SUP_DEGRADED"),
    covers=["B1-SUP-02"], on="heartbeat_exact", from_tick=2, interpretations=["S34", "S38"],
)  # fmt: skip
PB1_08c = holds_after(
    "PB1-08c",
    "Frames at least 60 ms apart, never missing for more than 120 ms, make the reception degraded.",
    premise=_apart(rx_update) & (rx_age <= 120), for_=77 * ticks, then=rx_status == "RX_DEGRADED",
    covers=["B1-RX-02"], on="reception_exact", from_tick=2, interpretations=["S34", "S35"],
)  # fmt: skip
PB1_08d = holds_after(
    "PB1-08d", "Frames at most 40 ms apart for the last 440 ms leave the reception OK.",
    premise=rx_update | previous(rx_update), for_=440 * ms, then=rx_status == "RX_OK",
    covers=["B1-RX-02", "B1-RX-04"], on="reception_exact", from_tick=2, interpretations=["S37"],
)  # fmt: skip
PB1_08e = holds_after(
    "PB1-08e",
    "Heartbeats at least 60 ms apart, never missing for more than 120 ms, make the supervisor degraded.",
    premise=_apart(heartbeat_update) & (heartbeat_age <= 120), for_=77 * ticks,
    then=b2_sup_status == "SUP_DEGRADED",
    covers=["B1-SUP-02"], on="heartbeat_exact", from_tick=2, interpretations=["S34", "S35", "S40"],
)  # fmt: skip
PB1_08f = holds_after(
    "PB1-08f", "Heartbeats at most 40 ms apart for the last 440 ms leave the supervisor OK.",
    premise=heartbeat_update | previous(heartbeat_update), for_=440 * ms, then=b2_sup_status == "SUP_OK",
    covers=["B1-SUP-02", "B1-SUP-04"], on="heartbeat_exact", from_tick=2, interpretations=["S37"],
)  # fmt: skip
PB1_32a = always(
    "PB1-32a",
    "The reception is critical exactly while its age exceeds 120 ms, degraded exactly for a slow mean then.",
    that=all_of(
        (rx_status == "RX_CRITICAL") == (rx_age > 120),
        (rx_status == "RX_DEGRADED") == ((rx_age <= 120) & rx_slow),
    ),
    covers=["B1-RX-05"], on="reception", from_tick=2, interpretations=["S34", "S37", "S38", "S39"],
)  # fmt: skip
PB1_32b = always(
    "PB1-32b",
    "The supervisor is critical exactly while its heartbeat is older than 120 ms, else degraded if slow.",
    that=all_of(
        (b2_sup_status == "SUP_CRITICAL") == (heartbeat_age > 120),
        (b2_sup_status == "SUP_DEGRADED") == ((heartbeat_age <= 120) & heartbeat_slow),
    ),
    covers=["B1-RX-05"], on="heartbeat", from_tick=2, interpretations=["S34", "S37", "S38", "S39", "S41"],
)  # fmt: skip


def _mean(id: str, what: str, update: Expr, slow: Expr, covers: str, on: str) -> Iterator[Property]:
    """The mean of ten intervals is not above 40 ms iff ten updates lie in the 400 ms before the one now."""
    ten_before = sum((ite(ago(update, n), const(1), const(0)) for n in range(1, 21)), start=const(0)) >= 10
    interpretations = ["S35", "S36", "S37", "S40"]
    yield always(
        f"{id}a", f"Ten {what} in the 400 ms before one leave the mean of their intervals at 40 ms at most.",
        that=implies(update & ten_before, ~slow), covers=[covers], on=on, from_tick=2,
        interpretations=interpretations,
    )  # fmt: skip
    eleven = at_least(11, update)
    yield always(
        f"{id}b",
        f"From the eleventh on, the mean exceeds 40 ms at any of the {what} that has fewer before it.",
        that=implies(update & ~ten_before & eleven, slow),
        covers=[covers], on=on, from_tick=2, interpretations=interpretations,
    )  # fmt: skip
    yield always(
        f"{id}c", f"Before the eleventh of the {what} there is no mean of ten intervals to be too long.",
        that=implies(slow, eleven), covers=[covers], on=on, interpretations=interpretations,
    )  # fmt: skip
    yield always(
        f"{id}d", f"Between {what} the mean of their intervals stays as it is.",
        that=implies(~update, slow == previous(slow)), covers=[covers], on=on, from_tick=2,
        interpretations=interpretations,
    )  # fmt: skip


PB1_35a, PB1_35b, PB1_35c, PB1_35d = _mean(
    "PB1-35", "frames", rx_update, rx_slow, "B1-RX-02", "reception_exact"
)
PB1_36a, PB1_36b, PB1_36c, PB1_36d = _mean(
    "PB1-36", "heartbeats", heartbeat_update, heartbeat_slow, "B1-SUP-02", "heartbeat_exact"
)

REACH_RX_DEG = reachable(
    "REACH-RX-DEG", "The reception can be degraded.",
    that=monitor_reception.active("Rx_DEG"), covers=["B1-RX-02"], on="reception_exact",
)  # fmt: skip
REACH_RX_DEG_AFTER_CRIT = reachable(
    "REACH-RX-DEG-AFTER-CRIT", "After a silence the first frame can lead from critical to degraded.",
    that=monitor_reception.active("Rx_DEG") & previous(monitor_reception.active("Rx_CRIT")),
    covers=["B1-RX-02", "B1-RX-03"], on="reception_exact", interpretations=["S38"],
)  # fmt: skip
REACH_RX_CRIT = reachable(
    "REACH-RX-CRIT", "The reception can become critical after it was OK.",
    that=monitor_reception.active("Rx_CRIT") & previous(monitor_reception.active("Rx_OK")),
    covers=["B1-RX-03"], on="reception_exact",
)  # fmt: skip
REACH_SUP_DEG = reachable(
    "REACH-SUP-DEG", "The supervisor of Board 2 can be degraded.",
    that=monitor_heartbeat.active("Sup_DEG"), covers=["B1-SUP-02"], on="heartbeat_exact",
)  # fmt: skip
REACH_SUP_CRIT = reachable(
    "REACH-SUP-CRIT", "The supervisor can become critical while frames still arrive.",
    that=monitor_heartbeat.active("Sup_CRIT") & monitor_reception.active("Rx_OK"),
    covers=["B1-SUP-03"], on="board1", interpretations=["S41"],
)  # fmt: skip
