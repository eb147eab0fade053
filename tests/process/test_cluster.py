"""Workers elsewhere: every order is carried out and told once, whichever workers are lost meanwhile."""

import os
import signal
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from rovercheck.checker.extras import CLUSTER
from rovercheck.checker.process.cluster import ClusterError
from rovercheck.checker.process.isolate import Send
from rovercheck.checker.process.pool import Cluster, GrantedTime, Order, Pool, PoolEvent
from tests.process.cluster import LocalCluster, local_cluster

pytestmark = pytest.mark.skipif(not CLUSTER.installed, reason=CLUSTER.needed("a cluster"))


def code() -> str:
    return os.environ.get("CODE_OF_TEST", "ours")


class Noting:
    """Does what an order says, and notes in a folder that it has begun."""

    def __init__(self, folder: str) -> None:
        self.folder = Path(folder)
        self.done = 0

    def __call__(self, send: Send, name: str, seconds: float) -> None:
        (self.folder / f"{name}.{time.monotonic_ns()}").touch()
        self.done += 1
        send(f"working on {name}")
        if name == "late":
            send(GrantedTime(0.2, firm=True))
        time.sleep(seconds)
        if name == "crash":
            os.kill(os.getpid(), signal.SIGSEGV)
        if name == "fail":
            raise ValueError("no such thing")
        send((name, self.done))


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LocalCluster]:
    with local_cluster(tmp_path_factory.mktemp("cluster"), 2) as made:
        yield made


def pool(made: LocalCluster, folder: Path) -> Pool:
    return Pool(Cluster(made.address, code), Noting, (str(folder),))


def heard(pool: Pool, *orders: Order) -> list[PoolEvent]:
    return sorted(pool.run(orders), key=lambda event: (event.number, event.done))


def test_every_order_is_told_once_and_those_of_a_kind_by_one_child(
    cluster: LocalCluster, tmp_path: Path
) -> None:
    orders = [Order((f"o{n}", 0.0), "same" if n < 3 else None) for n in range(6)]
    events = heard(pool(cluster, tmp_path), *orders)
    assert [e.number for e in events if e.done] == list(range(6))
    assert [e.message for e in events if not e.done] == [
        ("o0", 1), ("o1", 2), ("o2", 3), ("o3", 1), ("o4", 1), ("o5", 1)
    ]  # fmt: skip
    assert {e.failure for e in events} == {None}


def test_what_goes_wrong_is_told_as_from_a_child_here(cluster: LocalCluster, tmp_path: Path) -> None:
    names = ("fail", "crash", "late", "well")
    there = heard(pool(cluster, tmp_path), *(Order((name, 0.5 * (name == "late"))) for name in names))
    here = Pool(1, Noting, (str(tmp_path),))
    same = [e for e in heard(here, *(Order((name, 0.5 * (name == "late"))) for name in names))]
    assert [e for e in there if e.done] == [e for e in same if e.done]
    assert [e.failure and e.failure[:20] for e in there if e.done][3] is None


def test_after_a_crash_it_is_asked_what_to_do(cluster: LocalCluster, tmp_path: Path) -> None:
    asked = []

    def again(number: int) -> Order | None:
        asked.append(number)
        return Order(("well", 0.0)) if len(asked) == 1 else None

    events = list(pool(cluster, tmp_path).run([Order(("crash", 0.0))], again))
    assert asked == [0] and [(e.done, e.message) for e in events] == [
        (False, None), (False, ("well", 1)), (True, None)
    ]  # fmt: skip


def test_the_jobs_of_a_lost_worker_are_done_by_another(tmp_path: Path) -> None:
    folder = tmp_path / "notes"
    folder.mkdir()
    with local_cluster(tmp_path, 3) as made:
        names = [f"o{n}" for n in range(12)]

        def lose() -> None:
            for number in range(2):
                while len(list(folder.iterdir())) < 3 * (number + 1):
                    time.sleep(0.02)
                made.kill(number)

        losing = threading.Thread(target=lose)
        losing.start()
        events = heard(pool(made, folder), *(Order((name, 0.4)) for name in names))
        losing.join()
    assert [e.message[0] for e in events if e.message] == names
    assert [(e.number, e.failure) for e in events if e.done] == [(n, None) for n in range(12)]
    begun = [path.name.split(".")[0] for path in folder.iterdir()]
    assert set(begun) == {*names}


def test_closing_takes_the_jobs_back(cluster: LocalCluster, tmp_path: Path) -> None:
    events = pool(cluster, tmp_path).run([Order((f"o{n}", 0.3)) for n in range(40)])
    assert next(events)
    events.close()
    begun, end = -1, time.monotonic() + 30
    while (now := len(list(tmp_path.iterdir()))) != begun and time.monotonic() < end:
        begun = now
        time.sleep(3.0)
    assert begun == now < 40


def test_a_lost_scheduler_is_one_message(tmp_path: Path) -> None:
    with local_cluster(tmp_path, 1) as made:
        events = pool(made, tmp_path).run([Order((f"o{n}", 0.1)) for n in range(50)])
        assert next(events)
        made.scheduler.kill()
        with pytest.raises(ClusterError, match=r"is lost\. What was decided is kept"):
            list(events)


def test_a_worker_of_other_code_is_refused(tmp_path: Path) -> None:
    with local_cluster(tmp_path, 0) as made:
        with pytest.raises(ClusterError, match=r"has no worker\. Start one: `dask worker tcp://"):
            list(pool(made, tmp_path).run([Order(("o", 0.0))]))
        made.start({"CODE_OF_TEST": "theirs"})
        end = time.monotonic() + 30
        while time.monotonic() < end:
            with pytest.raises(ClusterError) as refused:
                list(pool(made, tmp_path).run([Order(("o", 0.0))]))
            if "has no worker" not in str(refused.value):
                break
            time.sleep(0.2)
        assert "has another version of rovercheck, Python or a solver" in str(refused.value)


def test_no_scheduler_is_one_message(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr("rovercheck.checker.process.cluster.CONNECTED", 0.5)
    for address, said in (
        ("tcp://127.0.0.1:9", "There is no scheduler at"),
        ("nonsense://x", "no scheduler"),
    ):
        with pytest.raises(ClusterError, match=said):
            list(Pool(Cluster(address, code), Noting, (str(tmp_path),)).run([Order(("o", 0.0))]))
