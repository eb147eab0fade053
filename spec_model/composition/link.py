"""One direction of the serial link: a frame in every step, seen one or two steps later, or never.

Step-synchronous model of the composition: both supervisors execute once per tick of 20 ms, and what
one board writes in a tick is seen by the other one or two ticks later, because the phases of the four
tasks in between are arbitrary.  Order is preserved.  A frame that is lost or corrupted (checksum,
length) is never seen: it leaves the payload and the time of the last valid data as they were
[spec §1.2, §2.4].

The alive counter is not kept as a number.  The receiver only asks whether the counter of an accepted
frame differs from the one it remembers, which is so iff the sender's supervisor executed between the
building of the two frames; three flags remember that (S40).
"""

from collections.abc import Sequence
from dataclasses import dataclass

from rovercheck.spec_model.lang.action import Action, assign, when
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import enumeration, integer
from rovercheck.spec_model.lang.expr import TRUE, Expr, Var, all_of, flag, implies, var
from rovercheck.spec_model.lang.words import minimum, named

ARRIVAL = enumeration("Arrival", ["nothing", "newest", "older"])
"""The newest frame was sent in the step before, the older one in the step before that."""

MANY = 8
"""Lost frames in a row are counted up to this number: eight make every age exceed its limit."""


@dataclass(frozen=True)
class Link:
    """``receive`` runs before the supervisors of a tick, ``send`` after them.

    ``without_loss`` and ``lost_at_most(n)`` are assumptions about the inputs of a tick; ``payload`` pairs
    what is sent with the variable that receives it.
    """

    receive: Block
    send: Block
    arrives: Var
    waiting: Expr
    comes: Expr
    lost_in_a_row: Var
    payload: tuple[tuple[Expr, Var], ...]

    @property
    def without_loss(self) -> Expr:
        """No frame is lost or corrupted (A02): what waits in its second step arrives."""
        return implies(self.waiting, self.comes)

    def lost_at_most(self, frames: int) -> Expr:
        """At most so many frames in a row are lost or corrupted (A03)."""
        return implies(self.waiting & (self.lost_in_a_row >= frames), self.comes)


def link(
    name: str,
    payload: Sequence[tuple[Expr, Var]],
    *,
    accepted: Var,
    counter_changed: Var,
    executes: Expr = TRUE,
    transmits: Expr = TRUE,
) -> Link:
    """A link whose frames carry the first value of each pair to the variable after it.

    ``accepted`` and ``counter_changed`` tell the receiver that a frame was accepted since its last step
    and that its alive counter differs from the remembered one.  ``executes``: the sender's supervisor
    executed in this tick; ``transmits``: its transmit task did.
    """
    arrives = var(f"{name}.arrives", ARRIVAL, doc="which frame is seen in this step; nothing if none")
    newest, older = (_Slot.named(name, age, payload) for age in ("newest", "older"))
    earlier = flag(f"{name}.earlier_execution", "the sender executed before it built the two frames")
    lost = var(f"{name}.lost_in_a_row", integer(0, MANY), doc="frames lost or corrupted in a row")
    waiting = named(f"{name}: a frame waits in its second step", older.filled & ~older.taken)
    newest_comes = (arrives == "newest") & newest.filled
    comes = named(f"{name}: a frame arrives", newest_comes | ((arrives == "older") & waiting))

    taking_newest: list[Action] = [
        *_taken(newest, payload),
        assign(accepted, True),
        assign(counter_changed, newest.executed | older.executed | earlier),
        *(assign(memory, False) for memory in (newest.executed, older.executed, earlier)),
        assign(older.taken, True),
        assign(lost, 0),
    ]
    taking_older: list[Action] = [
        *_taken(older, payload),
        assign(accepted, True),
        assign(counter_changed, older.executed | earlier),
        *(assign(memory, False) for memory in (older.executed, earlier)),
        assign(lost, 0),
    ]
    taking_none: list[Action] = [
        assign(accepted, False),
        assign(counter_changed, False),
        when(waiting, [assign(lost, minimum(lost + 1, MANY))]),
    ]
    receive = Block(
        f"{name}.receive",
        [
            when(
                newest_comes,
                taking_newest,
                [when((arrives == "older") & waiting, taking_older, taking_none)],
            )
        ],
        text="A frame that arrives intact replaces the payload; without one the payload is kept.",
    )
    send = Block(
        f"{name}.send",
        [
            assign(earlier, earlier | older.executed),
            *(assign(old, new) for old, new in zip(older.all, newest.all, strict=True)),
            *(assign(content, source) for content, (source, _) in zip(newest.content, payload, strict=True)),
            assign(newest.filled, transmits),
            assign(newest.taken, False),
            assign(newest.executed, executes),
        ],
        text="The transmit task builds a frame from the snapshots of this step.",
    )
    return Link(receive, send, arrives, waiting, comes, lost, tuple(payload))


@dataclass(frozen=True)
class _Slot:
    """A frame on its way, and whether the sender's supervisor executed just before it was built."""

    content: tuple[Var, ...]
    filled: Var
    taken: Var
    executed: Var

    @property
    def all(self) -> tuple[Var, ...]:
        return (*self.content, self.filled, self.taken, self.executed)

    @staticmethod
    def named(link: str, age: str, payload: Sequence[tuple[Expr, Var]]) -> "_Slot":
        content = tuple(
            Var(f"{link}.{age}.{received.name}", received.domain, received.init, "content", hidden=True)
            for _, received in payload
        )
        filled, taken, executed = (
            Var(f"{link}.{age}.{what}", flag("x").domain, 0, doc, hidden=True)
            for what, doc in (
                ("filled", "a frame was sent"),
                ("taken", "it was delivered or overtaken"),
                ("executed", "the sender executed in the step in which it was built"),
            )
        )
        return _Slot(content, filled, taken, executed)


def _taken(slot: _Slot, payload: Sequence[tuple[Expr, Var]]) -> list[Action]:
    contents = zip(payload, slot.content, strict=True)
    return [*(assign(received, content) for (_, received), content in contents), assign(slot.taken, True)]


def all_frames_arrive(*links: Link) -> Expr:
    """A02 for several links."""
    return all_of(*(one.without_loss for one in links))
