"""A pool of children: every order comes to an end, whatever a child does, and no child is left."""

import os
import signal
import time
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from rovercheck.checker.process.isolate import Send, messages
from rovercheck.checker.process.pool import GrantedTime, Order, Pool, PoolEvent
from tests.process.test_isolate import _tell_and_sleep as tell_and_sleep
from tests.process.test_isolate import gone


class Doing:
    """Does what an order says."""

    def __init__(self, greeting: str) -> None:
        self.greeting = greeting
        self.done = 0

    def __call__(self, send: Send, what: str) -> None:
        self.done += 1
        send((self.greeting, os.getpid(), self.done))
        match what:
            case "crash":
                os.kill(os.getpid(), signal.SIGSEGV)
            case "fail":
                raise ValueError("no such thing")
            case "hang":
                send(GrantedTime(0.2))
                time.sleep(60)
            case "sleep":
                time.sleep(60)
            case "nest":
                for pid in messages(tell_and_sleep, 60):
                    if pid is not None:  # a beat: starting may take longer than one
                        send(pid)
            case "fill":
                send(len(bytearray(4 << 30)))


POOL = Pool(2, Doing, ("hello",), memory=2 << 30, hard=1.0, grace=0.3)


def heard(*orders: str, pool: Pool = POOL) -> dict[int, list[PoolEvent]]:
    """What is heard of each order."""
    found: dict[int, list[PoolEvent]] = {n: [] for n in range(len(orders))}
    for event in pool.run([Order((what,)) for what in orders]):
        found[event.number].append(event)
    return found


def test_every_order_is_carried_out_once_by_few_children() -> None:
    found = heard(*["count"] * 20)
    assert all([e.done for e in events] == [False, True] for events in found.values())
    assert {e.failure for events in found.values() for e in events} == {None}
    pids = {events[0].message[1] for events in found.values()}
    assert len(pids) <= 2 and all(map(gone, pids))


@pytest.mark.parametrize(
    ("what", "reason"),
    [
        ("crash", "ended by SIGSEGV"),
        ("fail", "ValueError: no such thing"),
        ("hang", "did not stop at the time limit of 0.2 s"),
        ("fill", "the memory limit is reached"),
    ],
)
def test_what_goes_wrong_is_told_and_the_others_go_on(what: str, reason: str) -> None:
    found = heard("count", what, "count", what, "count", "count")
    assert reason in str(found[1][-1].failure) and reason in str(found[3][-1].failure)
    assert [found[n][-1].failure for n in (0, 2, 4, 5)] == [None] * 4
    assert all(gone(events[0].message[1]) for events in found.values())


def test_orders_of_a_kind_go_to_the_child_that_knows_it() -> None:
    orders = [Order(("count",), kind) for kind in "aabb"]
    first = {e.number: e.message[2] for e in replace(POOL, size=1).run(orders) if not e.done}
    assert first == {0: 1, 1: 2, 2: 3, 3: 4}
    mixed = [Order(("count",), kind) for kind in "abab"]
    times = {e.number: e.message[2] for e in replace(POOL, size=1).run(mixed) if not e.done}
    assert times == {0: 1, 2: 2, 1: 3, 3: 4}


def test_nobody_listens_any_more() -> None:
    with closing(POOL.run([Order(("sleep",))] * 3)) as events:
        pids = [next(events).message[1], next(events).message[1]]
    assert all(map(gone, pids))


@pytest.mark.skipif(os.name != "posix", reason="process groups")
def test_the_children_of_a_child_die_with_it() -> None:
    with closing(POOL.run([Order(("nest",))])) as events:
        next(events)
        grandchild = next(events).message
    assert isinstance(grandchild, int) and gone(grandchild)


def test_a_child_that_cannot_begin_fails_its_orders() -> None:
    found = heard("count", "count", pool=replace(POOL, args=()))
    assert all("greeting" in str(events[-1].failure) for events in found.values())


class Touching:
    """Makes the file that an order names."""

    def __call__(self, _: Send, path: str) -> None:
        Path(path).touch()


def test_a_child_does_not_wait_for_who_looks_at_what_was_heard(tmp_path: Path) -> None:
    one, two = tmp_path / "one", tmp_path / "two"
    with closing(Pool(1, Touching).run([Order((str(one),)), Order((str(two),))])) as events:
        assert next(events).done
        end = time.monotonic() + 10
        while not two.exists() and time.monotonic() < end:
            time.sleep(0.01)
        assert one.exists() and two.exists()
