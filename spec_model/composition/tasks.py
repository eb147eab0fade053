"""The fine time of the composition: ticks of 1 ms, tasks at constant phases nobody knows.

Every task of 20 ms executes where a clock of 20 ms passes its phase, a frozen variable; the control task
of Board 1 executes every 10 ms.  The time origin is arbitrary, so that one task of a system may have
phase 0.  Within one millisecond the order is: receive, sensor tasks, supervisor, motor commands,
transmit.  A frame is on the line for 0.9 ms, which is one tick.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import Expr, Var, flag, var
from rovercheck.spec_model.lang.words import modulo, named

PERIOD = 20
"""Milliseconds between two executions of a supervisor or of a transmit task [spec §1.2]."""

MILLISECOND = 1

now = var("clock", integer(0, PERIOD - 1), doc="milliseconds, modulo 20")

clock = Block("Clock", [assign(now, modulo(now + 1, PERIOD))], text="A millisecond passes.")


@dataclass(frozen=True)
class RoverTask:
    """A periodic task: ``due`` is true in the ticks in which it executes."""

    due: Expr
    phase: Var | None = None


def task(name: str, *, at_zero: bool = False) -> RoverTask:
    """A task of period 20 ms at an unknown constant phase, or at phase 0."""
    if at_zero:
        return RoverTask(named(f"{name} executes", now == 0))
    phase = var(f"{name}_phase", integer(0, PERIOD - 1), doc=f"when {name} executes, in ms modulo 20")
    return RoverTask(named(f"{name} executes", now == phase), phase)


def control_task(name: str) -> RoverTask:
    """A task of period 10 ms at an unknown constant phase."""
    phase = var(f"{name}_phase", integer(0, PERIOD // 2 - 1), doc=f"when {name} executes, in ms modulo 10")
    return RoverTask(named(f"{name} executes", modulo(now, PERIOD // 2) == phase), phase)


def phases(*tasks: RoverTask) -> tuple[Var, ...]:
    """The frozen variables of the tasks."""
    return tuple(t.phase for t in tasks if t.phase is not None)


@dataclass(frozen=True)
class FineLine:
    """A link in fine time: ``send`` at the transmit task, ``receive`` one tick later.

    ``intact`` is the input that says whether the frame on the line arrives whole.
    """

    receive: Block
    send: Block
    intact: Var
    busy: Var


def line(name: str, payload: Sequence[tuple[Var, Var]], transmit: Expr, accepted: Var) -> FineLine:
    """A line that carries the first variable of each pair to the second; ``accepted`` tells of a frame."""
    busy = flag(f"{name}.busy", "a frame is on the line")
    intact = flag(f"{name}.intact", "the frame on the line is neither lost nor corrupted")
    content = tuple(
        Var(f"{name}.{received.name}", received.domain, received.init, "content of the frame", hidden=True)
        for _, received in payload
    )
    arrived = [assign(received, held) for (_, received), held in zip(payload, content, strict=True)]
    receive = Block(
        f"{name}.receive",
        [
            assign(accepted, busy & intact),
            when(busy & intact, arrived),
            assign(busy, False),
        ],
        text="A frame that arrives whole replaces the payload [spec §2.4].",
    )
    send = Block(
        f"{name}.send",
        [
            when(
                transmit,
                [
                    assign(busy, True),
                    *(assign(held, source) for held, (source, _) in zip(content, payload, strict=True)),
                ],
            )
        ],
        text="The transmit task sends what the snapshots hold [spec §1.2].",
    )
    return FineLine(receive, send, intact, busy)
