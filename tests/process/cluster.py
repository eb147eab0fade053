"""A scheduler and workers of dask as processes of this machine, some of which a test may kill."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).parents[2]
QUIET = {"DASK_LOGGING__DISTRIBUTED": "error", "DASK_DISTRIBUTED__DASHBOARD__LINK": ""}


@dataclass
class LocalCluster:
    """``address`` is that of its scheduler."""

    address: str
    folder: Path
    scheduler: subprocess.Popen[bytes]
    workers: list[subprocess.Popen[bytes]] = field(default_factory=list)

    def start(self, environment: dict[str, str] | None = None) -> subprocess.Popen[bytes]:
        """One more worker."""
        number = len(self.workers)
        options = ["--nthreads", "1", "--no-nanny", "--no-dashboard", "--local-directory", str(self.folder)]
        made = started(["worker", self.address, "--name", str(number), *options], environment)
        self.workers.append(made)
        return made

    def kill(self, number: int) -> None:
        """End a worker and all that it has started, as if its machine were gone."""
        os.killpg(self.workers[number].pid, signal.SIGKILL)
        self.workers[number].wait()


def started(words: list[str], environment: dict[str, str] | None = None) -> subprocess.Popen[bytes]:
    path = os.pathsep.join([str(ROOT), *filter(None, sys.path)])
    return subprocess.Popen(
        [sys.executable, "-m", "distributed.cli.dask_" + words[0], *words[1:]],
        env={**os.environ, **QUIET, "PYTHONPATH": path, **(environment or {})},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )


@contextmanager
def local_cluster(folder: Path, workers: int) -> Iterator[LocalCluster]:
    """A scheduler with so many workers, which are all there when it is given."""
    from distributed import Client

    file = folder / "scheduler.json"
    scheduler = started(["scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard",
                         "--scheduler-file", str(file)])  # fmt: skip
    made = LocalCluster("", folder, scheduler)
    try:
        end = time.monotonic() + 60
        while not file.exists() and time.monotonic() < end:
            time.sleep(0.05)
        with Client(scheduler_file=str(file), timeout=60) as client:
            made.address = client.scheduler.address
            for _ in range(workers):
                made.start()
            if workers:
                client.wait_for_workers(workers, timeout=60)
        yield made
    finally:
        for process in (*made.workers, scheduler):
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
