"""The relay and the authorisation: from the age of frames and heartbeats to who may move the rover."""

from rovercheck.properties.forms import always, costly, enters_only_if, holds_after, leaves_only_if
from rovercheck.properties.promises import hand_over, shown, steered
from rovercheck.properties.promises.driving import unheard
from rovercheck.properties.promises.promise import Chain, Promise
from rovercheck.spec_model.lang.expr import implies
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import bit, held, named
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2_supervisor as b2

asked = named("Board 1 asks to switch", bit(b2.crit_mask_b1, 2) | bit(b2.crit_mask_b1, 7))
"""Its reception or its view of Board 2's supervisor is critical [spec Table 1]."""

OPENS = costly(always(
    "P-RELAY-OPENS",
    "In every step with a last frame or heartbeat of Board 2 over 120 ms old the relay is open.",
    that=implies(unheard, b1.give_b2_actuation),
    covers=["B1-REL-02", "B1-RX-03", "B1-SUP-03"], on="board1_ms", from_tick=2,
    interpretations=["S43", "S37"],
))  # fmt: skip
ONLY_THEN = costly(enters_only_if(
    "P-RELAY-ONLY-THEN",
    "The relay opens only in a step with a last frame or heartbeat of Board 2 over 120 ms old.",
    entering=b1.give_b2_actuation, only_if=unheard,
    covers=["B1-REL-02", "B1-REL-04"], on="board1_ms", from_tick=2, interpretations=["S43", "S44"],
))  # fmt: skip
CLOSES = costly(leaves_only_if(
    "P-RELAY-CLOSES",
    "The relay closes only after 3.02 s in which frames and heartbeats came within 120 ms.",
    leaving=b1.give_b2_actuation, only_if=held(~unheard, for_=151 * ticks),
    covers=["B1-REL-04"], on="board1_ms", from_tick=2, interpretations=["S44", "S45"],
))  # fmt: skip
CLOSED_AGAIN = costly(holds_after(
    "P-RELAY-CLOSED-AGAIN",
    "After 3.02 s in which frames and heartbeats came within 120 ms the relay is closed.",
    premise=~unheard, for_=151 * ticks, then=~b1.give_b2_actuation,
    covers=["B1-REL-04"], on="board1_ms", from_tick=2, interpretations=["S44", "S45"],
))  # fmt: skip
ASKED = costly(always(
    "P-RELAY-ASKED",
    "Board 2 is authorised in every step in which the last mask of Board 1 asks to switch.",
    that=implies(asked, b2.autorized_to_send_command),
    covers=["B2-ACT-01"], on="board2_ms", from_tick=2, interpretations=["E22"],
))  # fmt: skip

RELAY = Promise(
    "RELAY",
    "Relay and authorisation",
    "give_b2_actuation = 1 when reception or supervisor of Board 2 is critical, else 0; Board 2 is "
    "authorised by the detected faults.",
    "§2.5, Fig 16, §3.1",
    "in the same step",
    "opens in the same step, closes after 3.02 s (Fig 16), in steps of 19 to 21 ms after 2.869 to 3.171 s "
    "(PB1-44b, PB1-44c); Board 2 is authorised in the same step if asked, in the second step of silence if "
    "not (PB2-14d, of a part of Board 2); Board 2 drives 240 ms after the last frame for Board 1, or its "
    "power, and Board 1 while only Board 2 hears nothing",
    ("PB1-15", "PB1-44a", "PB2-14c", "PB2-58a", "PSY-02a", "PSY-19"),
    (
        OPENS, ONLY_THEN, CLOSES, CLOSED_AGAIN, ASKED, hand_over.SWITCHED, hand_over.SWITCHED_BACK,
        hand_over.LINK21, hand_over.LINK12, hand_over.LINKS, hand_over.SUPERVISOR2, hand_over.POWER,
        steered.SUPERVISOR2,
    ),
    (
        Chain(
            "PSY-03d",
            stands={
                "asks_switch": bit(b1.critical_mask, 2) | bit(b1.critical_mask, 7),
                "b1_requests_switch": asked,
            },
            by={},
            first=shown.LINK.id,
            cause=unheard,
            last=ASKED.id,
        ),
    ),
)  # fmt: skip
