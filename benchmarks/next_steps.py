"""How long ``rovercheck serve`` takes to show what can happen next, over HTTP, in the whole rover.

    python -m benchmarks.next_steps [ticks] [system]

Draws inputs at random and executes tick after tick; each reply holds the state and all possible next steps.
Prints medians and the worst tenth: wall time from request to reply, and of the processor in all of it.  The
target is 200 ms of the processor in the median: a busy machine takes longer on the wall.  The exit code is
1 if it is missed.
"""

import http.client
import json
import sys
from statistics import median, quantiles
from threading import Thread
from time import perf_counter, process_time
from typing import Any

from rovercheck.checker.commands.serve.api import Api
from rovercheck.checker.commands.serve.jobs import Jobs
from rovercheck.checker.commands.serve.server import PageServer
from rovercheck.checker.commands.serve.workspace import Workspace
from rovercheck.checker.commands.shared.options import VariantOptions
from rovercheck.checker.process.garbage import collect_seldom

TARGET = 0.2


def main(ticks: int, system: str) -> int:
    """Measure and print; the exit code."""
    collect_seldom()
    server = PageServer("127.0.0.1", 0, Api(Workspace(VariantOptions()), Jobs()), "token")
    Thread(target=server.serve_forever, daemon=True).start()
    begun = perf_counter()
    session = ask(server, "open", name=system)["session"]
    print(f"{system}: opened in {perf_counter() - begun:.2f} s")
    ask(server, "random", session=session)
    wall, processor, steps = [], [], []
    for _ in range(ticks):
        at, of = perf_counter(), process_time()
        told = ask(server, "step", session=session, ticks=1)
        wall.append(perf_counter() - at)
        processor.append(process_time() - of)
        steps.append(len(told["next"]["steps"]))
    server.shutdown()
    print(f"{ticks} ticks, {min(steps)} to {max(steps)} possible steps listed after each")
    for name, times in (("wall", wall), ("processor", processor)):
        print(
            f"{name:>10}: median {1000 * median(times):4.0f} ms, a tenth above {1000 * tenth(times):4.0f} ms"
        )
    return 0 if median(processor) < TARGET else 1


def tenth(times: list[float]) -> float:
    """What a tenth of the times is above."""
    return quantiles(times, n=10)[-1]


def ask(server: PageServer, name: str, /, **given: object) -> Any:
    """The answer to a request."""
    connection = http.client.HTTPConnection("127.0.0.1", server.server_port)
    headers = {"Content-Type": "application/json"}
    connection.request("POST", f"/{server.token}/api/{name}", json.dumps(given), headers)
    reply = connection.getresponse()
    told = json.loads(reply.read())
    connection.close()
    assert reply.status == 200, told
    return told


if __name__ == "__main__":
    arguments = sys.argv[1:]
    sys.exit(main(int(arguments[0]) if arguments else 60, arguments[1] if arguments[1:] else "rover"))
