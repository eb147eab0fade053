"""A server of the live page in the process of the tests, about a small model in a file."""

import http.client
import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from threading import Thread
from time import monotonic, sleep
from typing import Any

from rovercheck.checker.commands.serve.api import Api
from rovercheck.checker.commands.serve.jobs import Jobs
from rovercheck.checker.commands.serve.run import watched
from rovercheck.checker.commands.serve.server import PageServer
from rovercheck.checker.commands.serve.workspace import Workspace
from rovercheck.checker.commands.shared.options import VariantOptions

LAMP = """from rovercheck import Chart, State, after, always, flag, sec, to

REQUIREMENTS = {"R1": "It is dark."}
switch = flag("switch")
lamp = Chart(
    "Lamp",
    [
        State("Off", transitions=[to("On", when=switch)]),
        State("On", transitions=[to("Off", when=after(1 * sec))]),
    ],
    default="Off",
)
LAMP_1 = always("LAMP-1", "It is never on.", that=lamp.active("Off"), covers=["R1"], on="Lamp")
"""
PATIENCE = 60.0


def eventually(true: Callable[[], bool]) -> None:
    end = monotonic() + PATIENCE
    while not true():
        assert monotonic() < end, "it did not come to pass"
        sleep(0.05)


@dataclass
class Served:
    """A server in this process, and the file of its model."""

    server: PageServer
    file: Path

    def send(
        self, method: str, path: str, body: str | bytes | None = None, **headers: str
    ) -> tuple[int, dict[str, str], str]:
        connection = http.client.HTTPConnection("127.0.0.1", self.server.server_port, timeout=PATIENCE)
        try:
            connection.request(method, path, body, {k.replace("_", "-"): v for k, v in headers.items()})
            reply = connection.getresponse()
            return reply.status, dict(reply.getheaders()), reply.read().decode()
        finally:
            connection.close()

    def post(self, name: str, given: object, **headers: str) -> tuple[int, Any]:
        sent = {"Content_Type": "application/json", **headers}
        status, _, body = self.send("POST", f"/{self.server.token}/api/{name}", json.dumps(given), **sent)
        return status, json.loads(body)

    def ask(self, request: str, /, **given: object) -> Any:
        status, told = self.post(request, given)
        assert status == 200, told
        return told

    def refused(self, request: str, /, **given: object) -> str:
        status, told = self.post(request, given)
        assert status == 400, told
        return str(told["error"])

    def done(self, job: Any) -> Any:
        eventually(lambda: self.ask("job", job=job["job"])["state"] != "searching")
        return self.ask("job", job=job["job"])

    def save(self, text: str) -> None:
        self.file.write_text(text, encoding="utf-8")

    def end(self) -> None:
        """End the server, as somebody might who has the page open."""
        self.server.api.jobs.cancel()
        self.server.shutdown()
        self.server.server_close()

    def problem(self) -> str:
        return str(self.ask("overview")["model"]["problem"])

    def version(self) -> int:
        return int(self.ask("overview")["model"]["version"])


@contextmanager
def serving_model(folder: Path, text: str = LAMP) -> Iterator[Served]:
    """A server about a model that is written into a new folder, ended afterwards."""
    folder.mkdir()
    file = folder / "lamp.py"
    file.write_text(text, encoding="utf-8")
    workspace = Workspace(VariantOptions(model=file))
    server = PageServer("127.0.0.1", 0, Api(workspace, Jobs()), "a-token")
    thread = Thread(target=server.serve_forever, args=(0.05,))
    thread.start()
    one = Served(server, file)
    try:
        with watched(workspace):
            yield one
    finally:
        one.end()
        thread.join()
