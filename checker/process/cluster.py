"""Orders carried out by the workers of a cluster (``dask.distributed``): the same answers as from children.

A job is all orders of one kind, carried out by a child of the worker as by one of ours.  It is named by what
it is made of.  A job whose worker is lost is carried out by another one; what came of it is said once, at its
end.  Orders and messages travel as bytes, which neither scheduler nor worker reads.
"""

import logging
import pickle
import warnings
from collections.abc import Callable, Generator, Hashable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from hashlib import sha256
from typing import TYPE_CHECKING, Any, cast

from rovercheck.checker.extras import CLUSTER
from rovercheck.checker.process.isolate import Send, pickled
from rovercheck.checker.process.pool import Again, Cluster, GrantedTime, Order, Pool, PoolEvent

if TYPE_CHECKING:
    from distributed import Client

CONNECTED = 10.0
"""Seconds in which a scheduler must answer."""
TRIES = 3
"""Times that a job is handed to the scheduler, which gives it up after several workers that it was lost with:
it may be the job that ends them."""


class ClusterError(Exception):
    """The cluster cannot be used; the message says why, and what to do."""


@dataclass(frozen=True)
class _Job:
    """Orders by their numbers, as they travel, and how they are carried out; ``code`` gives the ``key``."""

    code: Callable[[], str]
    key: str
    pool: bytes
    orders: Mapping[int, bytes]
    tried: int = 1

    @property
    def name(self) -> str:
        """The same for the same job."""
        parts = (
            self.key.encode(),
            self.pool,
            *(part for n, o in self.orders.items() for part in (b"%d" % n, o)),
        )
        made = sha256(b"".join(sha256(part).digest() for part in parts)).hexdigest()
        return f"rovercheck-{made}-{self.tried}"


@dataclass(frozen=True)
class _Said:
    """An event of an order, its message as bytes; ``crashed``: it may be carried out once more."""

    event: PoolEvent
    message: bytes | None
    crashed: bool = False


def carried_out(pool: Pool, orders: Sequence[Order], again: Again) -> Generator[PoolEvent, None, None]:
    """What ``Pool.run`` yields, from the workers of ``pool.size``, each job's events when it is done.

    Raises ``ClusterError`` where there is no scheduler, no worker, or a worker of other code.  Closing the
    generator takes the jobs back; one that a worker is at ends when it next says something.
    """
    cluster = pool.size
    assert isinstance(cluster, Cluster)
    with connected(cluster) as client:
        from distributed import KilledWorker, as_completed
        from distributed.client import FutureCancelledError

        here = pickled(replace(pool, size=1))
        jobs = [
            _Job(cluster.code, cluster.code(), here, {n: pickled(orders[n]) for n in numbers})
            for numbers in _kinds(orders)
        ]
        running: Any = as_completed(loop=client.loop)  # type: ignore[no-untyped-call]
        asked: dict[str, _Job] = {}

        def submit(job: _Job) -> None:
            asked[job.name] = job
            running.add(client.submit(carry_out, job, key=job.name, pure=True))

        try:
            for job in jobs:
                submit(job)
            for future in running:
                job = asked[future.key]
                try:
                    said = future.result()
                except KilledWorker as lost:
                    if job.tried < TRIES:
                        submit(replace(job, tried=job.tried + 1))
                        continue
                    said = _failed(job, f"workers of the cluster are lost over it: {lost}")
                except FutureCancelledError as lost:
                    raise ClusterError(
                        f"The scheduler at {cluster.address} is lost. What was decided is kept; run the "
                        "command again when it is there."
                    ) from lost
                told = {one.event.number for one in said if one.event.done}
                if told != job.orders.keys():
                    raise AssertionError(f"a job of the cluster told of the orders {told} of {[*job.orders]}")
                for one in said:
                    more = again(one.event.number) if one.crashed else None
                    message = None if one.message is None else pickle.loads(one.message)
                    yield replace(one.event, message=message, done=one.event.done and more is None)
                    if more is not None:
                        submit(_Job(cluster.code, cluster.code(), here, {one.event.number: pickled(more)}))
        finally:
            cast(Any, client).cancel(list(client.futures), force=True)


def _kinds(orders: Sequence[Order]) -> Iterator[list[int]]:
    """The numbers of orders of one kind, which share work, together; those without a kind each alone."""
    found: dict[Hashable, list[int]] = {}
    for number, order in enumerate(orders):
        found.setdefault((number,) if order.kind is None else order.kind, []).append(number)
    yield from found.values()


def _failed(job: _Job, why: str) -> list[_Said]:
    return [_Said(PoolEvent(number, done=True, failure=why), None) for number in job.orders]


@contextmanager
def connected(cluster: Cluster) -> "Iterator[Client]":
    """A client of the scheduler, whose workers are all of our code.  Raises ``ClusterError``."""
    if not CLUSTER.installed:
        raise ClusterError(CLUSTER.needed("--scheduler"))
    from distributed import Client
    from distributed.versions import VersionMismatchWarning

    for name in logging.root.manager.loggerDict:  # what is wrong is told here, once
        if name.partition(".")[0] in ("distributed", "asyncio", "tornado"):
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)
    warnings.simplefilter("ignore", VersionMismatchWarning)  # what matters is refused below
    try:
        client: Any = Client(  # type: ignore[no-untyped-call]
            cluster.address, timeout=CONNECTED, set_as_default=False
        )
    except (OSError, TimeoutError, ValueError, RuntimeError) as error:
        why = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise ClusterError(
            f"There is no scheduler at {cluster.address} ({why}). Start one with `dask scheduler`, and "
            "workers with `dask worker ADDRESS`."
        ) from error
    with client:
        _require_workers(client, cluster)
        yield client


def _require_workers(client: "Client", cluster: Cluster) -> None:
    ours = cluster.code()
    found = client.run(cluster.code, on_error="return")
    if not found:
        raise ClusterError(
            f"The scheduler at {cluster.address} has no worker. Start one: `dask worker {cluster.address}`."
        )
    for worker, theirs in sorted(found.items()):
        if theirs != ours:
            raise ClusterError(_other(worker, theirs))


def _other(worker: str, theirs: object) -> str:
    why = f" ({type(theirs).__name__}: {theirs})" if isinstance(theirs, BaseException) else ""
    return (
        f"The worker {worker} has another version of rovercheck, Python or a solver{why}: its verdicts would "
        "be those of other code. Install there what is here (the same commit and lock file), and start it "
        "anew."
    )


# --- on a worker ----------------------------------------------------------------------------------


def carry_out(job: _Job) -> list[_Said]:
    """Carry out the orders of a job in a child; all that it says.  Raises ``ClusterError`` for other code."""
    from distributed import get_worker

    worker = get_worker()
    if job.key != (theirs := job.code()):
        raise ClusterError(_other(worker.address, theirs))
    numbers, said, crashed = list(job.orders), list[_Said](), set[int]()

    def again(number: int) -> None:
        crashed.add(number)

    pool: Pool = pickle.loads(job.pool)
    inside = replace(pool, make=_opened, args=(pool.make, pool.args))
    for event in inside.run([Order((job.orders[n],)) for n in numbers], again):
        at = worker.state.tasks.get(job.name)
        if at is None or at.state == "cancelled":
            raise ClusterError("The job was taken back.")  # which nobody hears
        if not isinstance(event.message, str):
            bare = replace(event, number=numbers[event.number], message=None)
            said.append(_Said(bare, event.message, event.done and event.number in crashed))
    return said


def _opened(make: Callable[..., Callable[..., None]], args: tuple[object, ...]) -> Callable[..., None]:
    """In the child: carries out an order that comes as bytes, and sends what is said as bytes."""
    do = make(*args)

    def work(send: Send, order: bytes) -> None:
        asked: Order = pickle.loads(order)
        do(lambda said: send(said if isinstance(said, str | GrantedTime) else pickled(said)), *asked.args)

    return work


__all__ = ["ClusterError", "carried_out", "connected"]
