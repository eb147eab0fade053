"""Tiny systems with a goal or two, of which it is known whether and when they are reached."""

from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import chosen, integer
from rovercheck.spec_model.lang.expr import FALSE, TRUE, flag, ite, var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.words import minimum

GOAL = flag("goal")


def relay(limit: int = 4) -> TransitionSystem:
    """A relay released ``limit`` ticks after the last critical one, and a history that knows when that was.

    The goal, released too early, is never reached; a proof must relate the two counters.
    """
    critical, on = flag("critical"), flag("on")
    hold, since = var("hold", integer(0, limit - 1)), var("since", integer(0, limit), limit)
    off = (Assign(on, FALSE), Assign(hold, hold * 0))
    step = (
        If(
            critical,
            (Assign(on, TRUE), Assign(hold, hold * 0)),
            (If(on, (If(hold + 1 >= limit, off, (Assign(hold, hold + 1),)),)),),
        ),
        Assign(since, ite(critical, 0, minimum(since + 1, limit))),
        Assign(GOAL, ~on & (since < limit)),
    )
    return TransitionSystem("relay", (critical,), (), (on, hold, since, GOAL), (), step)


def waiting() -> TransitionSystem:
    """A state that is never entered, in which one can wait for long before the goal is true."""
    go, place = flag("go"), var("place", integer(0, 3))
    step = (
        Assign(GOAL, (place == 2) & go),
        Assign(place, ite(place == 0, ite(go, 1, 0), ite(place == 1, 0, ite(go, 3, 2)))),
    )
    return TransitionSystem("waiting", (go,), (), (place, GOAL), (), step)


def counter(at: int, *, top: int, beside: bool = False) -> TransitionSystem:
    """Counts held ticks up to ``top``; the goal is reached ``at`` so many.

    ``beside`` adds a flag that changes nothing.
    """
    hold, count, mark = flag("hold"), var("count", integer(0, top)), flag("mark")
    step = (
        Assign(count, ite(hold, minimum(count + 1, top), 0)),
        Assign(mark, hold),
        Assign(GOAL, (count == at) & (mark | ~mark)),
    )
    own, temps = ((count, mark, GOAL), ()) if beside else ((count, GOAL), (mark,))
    return TransitionSystem("counter", (hold,), (), own, temps, step)


def filling(most: int, *, saturate: bool = True) -> TransitionSystem:
    """Counts held ticks beside an input with gaps; ``full`` is reached after ``most``, ``over`` never.

    Without ``saturate`` the count leaves its domain instead, and ``over`` would be true only outside.
    """
    hold, noise = flag("hold"), var("noise", chosen([3, 5, 40]))
    count, full, over = var("count", integer(0, most)), flag("full"), flag("over")
    raised = minimum(count + 1, most) if saturate else count + 1
    step = (
        Assign(count, ite(hold, raised, 0)),
        Assign(full, count >= most),
        Assign(over, count > most),
    )
    return TransitionSystem("filling", (hold, noise), (), (count, full, over), (), step, noise > 3)


def overflowing(top: int) -> TransitionSystem:
    """Counts held ticks and leaves its domain after ``top``; the goal would be true only outside."""
    hold, count = flag("hold"), var("count", integer(0, top))
    step = (Assign(GOAL, count > top), Assign(count, ite(hold, count + 1, 0)))
    return TransitionSystem("overflowing", (hold,), (), (count, GOAL), (), step)


def once() -> TransitionSystem:
    """The goal is true after the second tick and after no other."""
    first, second = flag("first"), flag("second")
    step = (Assign(GOAL, first & ~second), Assign(second, first), Assign(first, TRUE))
    return TransitionSystem("once", (), (), (first, second, GOAL), (), step)
