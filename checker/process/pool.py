"""A few child processes that share a list of orders; one that takes too long is killed and replaced."""

import os
from collections.abc import Callable, Generator, Hashable, Iterator, Sequence
from dataclasses import dataclass
from itertools import count
from queue import Empty, SimpleQueue
from time import monotonic
from typing import Any

from rovercheck.checker.process.isolate import Child, End


@dataclass(frozen=True)
class GrantedTime:
    """What a child sends when it begins something that should be over in so many seconds (None: ever).

    The first of an order holds for all of it: later ones can shorten it.  A ``firm`` one is for what cannot
    look at a clock: it is ended at once when the time is over.
    """

    seconds: float | None
    firm: bool = False


@dataclass(frozen=True)
class Order:
    """Arguments for a child.  Orders of one ``kind`` share work: who did one takes the next one first."""

    args: tuple[object, ...]
    kind: Hashable = None


@dataclass(frozen=True)
class PoolEvent:
    """A message about the order of that number, or (``done``) its end and what went wrong, if anything.

    A failure that is not its end is a crash after which it is carried out once more.  ``late``: its time was
    over.
    """

    number: int
    message: Any = None
    done: bool = False
    failure: str | None = None
    late: bool = False


@dataclass(frozen=True)
class Cluster:
    """Workers elsewhere (``checker.process.cluster``): the address of their scheduler, and what gives the key
    of the code that decides, which must be the same there."""

    address: str
    code: Callable[[], str]


Jobs = int | Cluster
"""Children that work at a time: so many here, or those of a cluster."""


def cores() -> int:
    """The processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@dataclass(frozen=True)
class Pool:
    """``size`` children, each made by ``make(*args)`` (see ``isolate.Child``), with ``memory`` bytes each.

    A child that was granted some seconds is killed after ``hard`` times as many and ``grace`` more.
    """

    size: Jobs
    make: Callable[..., Callable[..., None]]
    args: tuple[object, ...] = ()
    memory: int | None = None
    hard: float = 1.1
    grace: float = 2.0

    def run(self, orders: Sequence[Order], again: "Again | None" = None) -> Generator[PoolEvent, None, None]:
        """Have all orders carried out, the first ones first; yield what is heard of each.

        ``again`` is asked what a new child is to do when one has crashed over an order of that number.
        Closing the generator, or an exception in it, kills the children.
        """
        if isinstance(self.size, Cluster):
            from rovercheck.checker.process.cluster import carried_out

            yield from carried_out(self, orders, again or _never)
            return
        at_work = _AtWork(self, dict(enumerate(orders)), again or _never)
        try:
            yield from at_work.events()
        finally:
            at_work.kill()


Again = Callable[[int], Order | None]


def _never(_: int) -> Order | None:
    return None


@dataclass
class _Seat:
    """The place of a child: its order, what it was granted, and when it is killed."""

    child: Child
    number: int | None = None
    kind: Hashable = None
    granted: float = 0.0
    hard: float | None = None
    whole: float | None = None
    """When it is killed whatever it is granted."""

    def hold(self, granted: GrantedTime, killed: float | None) -> None:
        """Note what it is granted, and when it is killed for what takes longer."""
        if granted.seconds is not None:
            self.granted = granted.seconds
        moments = [moment for moment in (killed, self.whole) if moment is not None]
        self.hard = min(moments, default=None)


class ChildTimeout(End):
    """A child was killed when its time was over."""


class _AtWork:
    """The children of a pool and the orders that are left."""

    def __init__(self, pool: Pool, left: dict[int, Order], again: Again) -> None:
        self._pool = pool
        self._left = left
        self._again = again
        # Not a Queue: Ctrl-C in one of its methods can leave it locked, and its writers waiting for ever.
        self._inbox: SimpleQueue[tuple[int, object]] = SimpleQueue()
        self._seats: dict[int, _Seat] = {}
        self._numbers = count()

    def events(self) -> Iterator[PoolEvent]:
        """What is heard, until every order is done."""
        assert isinstance(self._pool.size, int)
        for _ in range(min(self._pool.size, len(self._left))):
            self._hire()
        while self._seats:
            for key, message in self._heard():
                seat = self._seats.get(key)
                if seat is None or seat.number is None:
                    continue  # the last words of a child that was killed
                event = self._event(seat, message)
                end = message if isinstance(message, End) else None
                if (
                    end is not None and end.failure is None
                ):  # it does not wait for who looks at what was heard
                    self._next(key, end)
                if event is not None:
                    yield event
                if end is not None and end.failure is not None:
                    self._next(key, end)

    def kill(self) -> None:
        """End all children."""
        while self._seats:
            _, seat = self._seats.popitem()
            seat.child.kill()

    def _heard(self) -> Iterator[tuple[int, object]]:
        """The next message; the end of each child whose time is over."""
        moments = [s.hard for s in self._seats.values() if s.hard is not None]
        left = max(0.0, min(moments) - monotonic()) if moments else None
        try:
            yield self._inbox.get(timeout=left)
        except Empty:
            now = monotonic()
            for key, seat in list(self._seats.items()):
                if seat.hard is not None and seat.hard <= now:
                    yield (
                        key,
                        ChildTimeout(
                            f"killed: it did not stop at the time limit of {seat.granted:g} s", True
                        ),
                    )

    def _event(self, seat: _Seat, message: object) -> PoolEvent | None:
        assert seat.number is not None
        if isinstance(message, GrantedTime):
            if seat.whole is None:
                seat.whole = self._killed_at(GrantedTime(message.seconds))
            seat.hold(message, self._killed_at(message))
            return None
        if isinstance(message, End):
            order = self._again(seat.number) if message.crashed else None
            if order is not None:
                self._left = {seat.number: order, **self._left}
            return PoolEvent(
                seat.number, None, order is None, message.failure, isinstance(message, ChildTimeout)
            )
        return PoolEvent(seat.number, message)

    def _killed_at(self, granted: GrantedTime) -> float | None:
        if granted.seconds is None:
            return None
        more = 0.0 if granted.firm else (self._pool.hard - 1) * granted.seconds + self._pool.grace
        return monotonic() + granted.seconds + more

    def _next(self, key: int, end: End) -> None:
        """The next order for a child that is done, or for its successor if something went wrong."""
        if end.failure is not None:
            self._seats.pop(key).child.kill()
            if self._left:
                self._hire()
        elif self._left:
            self._assign(self._seats[key])
        else:
            self._seats.pop(key).child.kill()

    def _hire(self) -> None:
        key = next(self._numbers)

        def tell(message: object) -> None:
            self._inbox.put((key, message))

        seat = _Seat(Child(tell, self._pool.make, *self._pool.args, memory=self._pool.memory))
        self._seats[key] = seat
        self._assign(seat)

    def _assign(self, seat: _Seat) -> None:
        same = (n for n, order in self._left.items() if order.kind == seat.kind)
        seat.number, seat.hard, seat.whole = next(same, next(iter(self._left))), None, None
        order = self._left.pop(seat.number)
        seat.kind = order.kind
        seat.child.order(*order.args)
