"""The receiver byte by byte: it looks for the sync word, collects a frame and tests its checksum.

One byte per tick.  Only what the receiver compares is kept of a byte: first or second byte of the sync
word, or another one.  A frame has ``LENGTH`` bytes here instead of some forty: sync word, two bytes of
payload, two of checksum.  The checksum is taken to be good exactly when the bytes held are those of one
frame as it was sent; that CRC-16 misses some rare errors is left out.
"""

from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import enumeration, integer
from rovercheck.spec_model.lang.expr import all_of, flag, implies, ite, member, var
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.system_table import SystemTable

LENGTH = 6
BYTE = enumeration("Byte", ["OTHER", "SYNC1", "SYNC2"])
SYNC1, SYNC2 = member(BYTE, "SYNC1"), member(BYTE, "SYNC2")

# --- what is sent, and what the line makes of it ------------------------------------------------------

idle = flag("line.idle", "the sender sends nothing in this tick")
noise = flag("line.noise", "while the sender is idle, a stray byte arrives")
drops = flag("line.drops", "the byte sent in this tick is lost")
hits = flag("line.hits", "the byte sent in this tick arrives changed")
body = var("sent_byte", BYTE, doc="free: a byte of payload or checksum")
changed = var("line.byte", BYTE, doc="free: what arrives instead, or out of nothing")

position = var("sender.position", integer(0, LENGTH - 1), doc="bytes of the frame sent before this tick")
arrived = flag("line.arrived", "a byte arrives in this tick")
byte = var("line.received", BYTE, doc="the byte that arrives")
untouched = flag("frame.untouched", "all bytes of the frame so far arrived unchanged")
sync_inside = flag("frame.sync_inside", "the sync word occurs after the beginning of the frame")
last_sent = var("sender.last", BYTE, doc="the byte sent before")
whole = flag("frame.whole", "in this tick the last byte of a frame arrived, all unchanged")
sending = flag("sender.sends", "a byte of a frame is sent in this tick")

transmit = Block(
    "Sender",
    [
        assign(sending, ~idle | (position > 0)),
        when(
            sending,
            [
                assign(
                    byte,
                    ite(
                        position == 0, member(BYTE, "SYNC1"), ite(position == 1, member(BYTE, "SYNC2"), body)
                    ),
                ),
                assign(untouched, ((position == 0) | untouched) & ~drops & ~hits),
                assign(sync_inside, (position > 0) & sync_inside),
                when(
                    (position >= 2) & (last_sent == "SYNC1") & (byte == "SYNC2"), [assign(sync_inside, True)]
                ),
                assign(last_sent, byte),
                assign(whole, (position == LENGTH - 1) & untouched),
                assign(arrived, ~drops),
                when(hits, [assign(byte, changed)]),
            ],
            [assign(byte, changed), assign(arrived, noise), assign(whole, False)],
        ),
    ],
    text="A frame, a byte per tick without a pause; the line may lose or change bytes, or add some.",
)
advance = Block(
    "NextByte",
    [when(sending, [assign(position, ite(position == LENGTH - 1, 0, position + 1))])],
    text="The next byte of the frame.",
)

# --- the receiver -----------------------------------------------------------------------------------------

held = var("receiver.n", integer(0, LENGTH - 1), doc="bytes held")
last = var("receiver.last", BYTE, doc="the last byte held")
clean = flag("receiver.clean", "the bytes held are the first bytes of the frame being sent, unchanged")
empty_before = flag("receiver.was_empty", "no byte was held before the first byte of the frame")
accepted = flag("receiver.accepts", "a frame is accepted in this tick: payload and last-valid time change")

is_sync = (last == "SYNC1") & (byte == "SYNC2")
keeps_clean = all_of(sending, untouched, clean | (held == 0), held == position)

receive = Block(
    "Receiver",
    [
        assign(accepted, False),
        when(sending & (position == 0), [assign(empty_before, held == 0)]),
        when(
            arrived,
            [
                when(
                    held == 0,
                    [assign(clean, keeps_clean), assign(held, 1)],
                    [
                        when(
                            held == 1,
                            [
                                when(
                                    is_sync,
                                    [assign(clean, keeps_clean), assign(held, 2)],
                                    # Only the newer byte is kept; it may be the first of a frame.
                                    [assign(clean, sending & untouched & (position == 0)), assign(held, 1)],
                                )
                            ],
                            [
                                when(
                                    is_sync,
                                    [assign(clean, sending & untouched & (position == 1)), assign(held, 2)],
                                    [
                                        assign(clean, keeps_clean),
                                        when(
                                            held == LENGTH - 1,
                                            [assign(accepted, clean), assign(held, 0)],
                                            [assign(held, held + 1)],
                                        ),
                                    ],
                                )
                            ],
                        )
                    ],
                ),
                assign(last, byte),
            ],
        ),
    ],
    text="Sync word first, a new sync word starts anew, then the checksum; no time-out.",
)

receiver = in_order(
    "receiver",
    transmit,
    receive,
    advance,
    text="The byte-level receiver behind a line that may lose, change and add bytes.",
    assume=implies(hits, ~drops),
    tick_ms=1,
    notes=(
        f"A frame of {LENGTH} bytes; one byte per tick, whatever its length; the checksum finds every error.",
        "Frames may follow each other without a pause, or with any pause.",
    ),
)

SYSTEMS = SystemTable(receiver)
