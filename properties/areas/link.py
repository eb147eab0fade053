"""What must be true of the link: which frames are accepted, and what the alive counter tells."""

from rovercheck.properties.forms import always, reachable
from rovercheck.properties.past import ago
from rovercheck.spec_model.composition import counters, receiver
from rovercheck.spec_model.lang.expr import implies, ite
from rovercheck.spec_model.lang.words import modulo, previous

FRAME, MODULUS = 6, 16
"""Bytes of a frame and range of the alive counter, both as small as the model of the link has them."""


PSY_16a = always(
    "PSY-16a", "A frame that the line has changed is not accepted: payload and last-valid time stay.",
    that=implies(receiver.accepted, receiver.whole),
    covers=["B1-RX-01", "B2-COM-05"], on="receiver",
)  # fmt: skip
PSY_16b = always(
    "PSY-16b", "Every frame that arrives unchanged is accepted.",
    that=implies(receiver.whole, receiver.accepted),
    covers=["B2-COM-03"], on="receiver",
)  # fmt: skip
PSY_16c = always(
    "PSY-16c",
    "A frame that arrives unchanged, before which no byte was held and inside which the sync word does "
    "not occur, is accepted.",
    that=implies(receiver.whole & receiver.empty_before & ~receiver.sync_inside, receiver.accepted),
    covers=["B2-COM-03"], on="receiver",
)  # fmt: skip
REACH_RECEIVER_ACCEPTS = reachable(
    "REACH-RECEIVER-ACCEPTS", "Two frames can be accepted one directly after the other.",
    that=receiver.accepted & ago(receiver.accepted, FRAME),
    covers=["B2-COM-03"], on="receiver",
)  # fmt: skip
PSY_21a = always(
    "PSY-21a", "The alive counter rises by exactly 1 in each execution and stays in between.",
    that=counters.counter
    == modulo(previous(counters.counter) + ite(counters.executes, 1, 0), MODULUS),
    covers=["B2-COM-06", "B1-SUP-01"], on="counters", from_tick=2, interpretations=["S40"],
)  # fmt: skip
PSY_21b = always(
    "PSY-21b", "A heartbeat is seen in exactly the steps with an accepted frame whose counter is a new one.",
    that=counters.says_new == (counters.accepted & counters.differs),
    covers=["B2-COM-06", "B1-SUP-01"], on="counters", interpretations=["S40"],
)  # fmt: skip
REACH_COUNTER_SKIPS = reachable(
    "REACH-COUNTER-SKIPS", "The received counter can move by more than 1 at once.",
    that=(counters.received == 5) & (previous(counters.received) == 2),
    covers=["B1-SUP-01"], on="counters", interpretations=["S40"],
)  # fmt: skip
