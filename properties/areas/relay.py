"""What must be true of the relay decision of Board 1: who has the actuation [spec §2.5, Fig 16]."""

from rovercheck.properties.forms import (
    always,
    enters_only_if,
    holds_after,
    holds_for,
    leaves_only_if,
    reachable,
)
from rovercheck.spec_model.board1.relay import relay
from rovercheck.spec_model.lang.expr import implies
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import held, named, once, previous
from rovercheck.spec_model.signals.board1 import (
    b2_sup_status,
    give_b2_actuation,
    heartbeat_age,
    rx_age,
    rx_status,
)

ON = "relay"
critical = named("a link is critical", (rx_status == "RX_CRITICAL") | (b2_sup_status == "SUP_CRITICAL"))

PB1_11 = always(
    "PB1-11", "Board 2 is given the actuation in every step with a critical reception or supervisor.",
    that=implies(critical, give_b2_actuation),
    covers=["B1-REL-02", "B1-OUT-02"], on=ON, from_tick=2, interpretations=["S43"],
)  # fmt: skip
PB1_11b = always(
    "PB1-11b", "Board 2 has the actuation in every step with no valid frame or no new heartbeat for 120 ms.",
    that=implies((rx_age > 120) | (heartbeat_age > 120), give_b2_actuation),
    covers=["B1-RX-03", "B1-SUP-03", "B1-REL-02"], on="relay_links", from_tick=2,
    interpretations=["S37", "S41", "S43"],
)  # fmt: skip
PB1_12 = enters_only_if(
    "PB1-12", "Board 2 is given the actuation only in a step with a critical reception or supervisor.",
    entering=give_b2_actuation, only_if=critical,
    covers=["B1-REL-02", "B1-OUT-02"], on=ON, from_tick=2, interpretations=["S43", "S50"],
)  # fmt: skip
PB1_13a = leaves_only_if(
    "PB1-13a", "The actuation returns only if neither was critical in any step of the last 3.02 s.",
    leaving=give_b2_actuation, only_if=held(~critical, for_=151 * ticks),
    covers=["B1-REL-04"], on=ON, from_tick=2, interpretations=["S44", "S45"],
)  # fmt: skip
PB1_13b = holds_for(
    "PB1-13b", "Once given, the actuation stays with Board 2 for at least 3.02 s.",
    start=give_b2_actuation, that=give_b2_actuation, for_=151 * ticks,
    covers=["B1-REL-04"], on=ON, from_tick=2, interpretations=["S45", "S46"],
)  # fmt: skip
PB1_13c = leaves_only_if(
    "PB1-13c", "The actuation returns only if for 3.02 s no frame or heartbeat was missing for 120 ms.",
    leaving=give_b2_actuation, only_if=held((rx_age <= 120) & (heartbeat_age <= 120), for_=151 * ticks),
    covers=["B1-REL-04"], on="relay_links", from_tick=2, interpretations=["S37", "S45"],
)  # fmt: skip
PB1_14 = holds_after(
    "PB1-14", "When neither has been critical for 3.02 s, Board 1 has the actuation.",
    premise=~critical, for_=151 * ticks, then=~give_b2_actuation,
    covers=["B1-REL-04"], on=ON, from_tick=2, interpretations=["S45"],
)  # fmt: skip
PB1_14b = always(
    "PB1-14b", "Until a link is critical for the first time Board 1 has the actuation.",
    that=implies(~once(critical), ~give_b2_actuation),
    covers=["B1-REL-03"], on=ON, interpretations=["S43"],
)  # fmt: skip
PB1_15 = always(
    "PB1-15", "With reception and supervisor OK, Board 1 has the actuation in the same step.",
    that=implies((rx_status == "RX_OK") & (b2_sup_status == "SUP_OK"), ~give_b2_actuation),
    covers=["B1-REL-04"], on=ON, from_tick=2, interpretations=["S45"],
)  # fmt: skip

REACH_RELAY_B2 = reachable(
    "REACH-RELAY-B2", "Board 2 can be given the actuation.",
    that=relay.active("B2_actuating"), covers=["B1-REL-01", "B1-REL-02"], on=ON,
)  # fmt: skip
REACH_RELAY_LAST_STEP = reachable(
    "REACH-RELAY-LAST-STEP", "Board 2 can still have the actuation after 3.00 s without a critical link.",
    that=give_b2_actuation & held(~critical, for_=150 * ticks), covers=["B1-REL-04"], on=ON,
    interpretations=["S45"],
)  # fmt: skip
REACH_RELAY_RETURN = reachable(
    "REACH-RELAY-RETURN", "Board 1 can take the actuation back.",
    that=relay.active("B1_actuating") & previous(relay.active("B2_actuating")),
    covers=["B1-REL-03", "B1-REL-04"], on=ON,
)  # fmt: skip
