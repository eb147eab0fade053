"""The server behind a live page: local by default, and only for those who know its address.

Every address begins with a token that is new each time.  A name of the machine that is none of its own is
refused, so that no page of somebody else can be led here by a name of theirs (DNS rebinding), and nothing is
done for a page of another origin.
"""

import json
import os
import socket
import sys
from collections.abc import Mapping
from contextlib import suppress
from hmac import compare_digest
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from ipaddress import ip_address
from threading import Timer
from traceback import print_exc
from typing import Any
from urllib.parse import parse_qs, urlsplit

from rovercheck.checker.commands.serve.api import REQUESTS, Api
from rovercheck.checker.commands.serve.document import ProblemDocument
from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.explore.by_hand.value_syntax import RefusedInput
from rovercheck.checker.process.faults import described
from rovercheck.checker.render import explorer, trace_html
from rovercheck.checker.verify.runs.replay import ReplayError
from rovercheck.spec_model.lang.errors import ModelError

MOST_BYTES = 1 << 20
"""Of a request."""
BEAT = 10.0
"""Seconds after which a page that waits for news is told that there are none: so it is known to be there."""
GONE = 15.0
"""Seconds after the last page has gone until its searches are ended."""
HEADERS: Mapping[str, str] = {
    "Cache-Control": "no-store",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
}


def _host_name(host: str) -> str:
    """The name or address in a header Host, without a port; empty for what has no meaning."""
    try:
        return urlsplit(f"//{host}").hostname or ""
    except ValueError:
        return ""


class PageServer(ThreadingHTTPServer):
    """Serves the page and its requests, each in a thread.  Raises ``OSError`` if the port is in use."""

    daemon_threads = True

    def __init__(self, host: str, port: int, api: Api, token: str) -> None:
        self.api, self.host, self.token = api, host, token
        self.address_family = socket.AF_INET6 if ":" in host else socket.AF_INET
        self._listening = 0
        super().__init__((host, port), PageRequest)

    def server_bind(self) -> None:
        """Bind; the name of the machine is not asked for, which may take long."""
        if os.name == "posix":  # elsewhere it would share a port that is in use
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self.socket.bind(self.server_address)
        self.server_address = self.socket.getsockname()
        self.server_name, self.server_port = self.host, self.server_address[1]

    @property
    def url(self) -> str:
        """The address of the page."""
        host = f"[{self.host}]" if ":" in self.host else self.host
        return f"http://{host}:{self.server_port}/{self.token}/"

    def handle_error(self, request: Any, client_address: Any) -> None:
        """A page that is closed meanwhile is no error."""
        if not isinstance(sys.exc_info()[1], OSError):
            print_exc()

    def known(self, host: str) -> bool:
        """Whether a request is for this server: by an address, or a name that is its own."""
        name = _host_name(host)
        with suppress(ValueError):
            return bool(ip_address(name))
        return name in ("localhost", self.host.lower(), socket.gethostname().lower())

    def listens(self, more: int) -> None:
        """A page has begun, or ceased, to wait for news."""
        with self.api.workspace.lock:
            self._listening += more
            if not self._listening and self.api.jobs.searching():
                timer = Timer(GONE, self._end_searches)
                timer.daemon = True
                timer.start()

    def _end_searches(self) -> None:
        """End what nobody waits for any more."""
        if not self._listening:
            self.api.jobs.cancel()


class PageRequest(BaseHTTPRequestHandler):
    """One request."""

    server: PageServer
    server_version = "rovercheck"
    sys_version = ""
    timeout = 60

    def log_message(self, format: str, *args: Any) -> None:
        """Nothing is logged: the token is in every address."""

    def do_GET(self) -> None:
        """The page, news, a run as a page, a file."""
        if (path := self._path()) is None:
            return
        match path:
            case "":
                self._send(explorer.page(), "text/html; charset=utf-8", csp=False)
            case "news":
                self._news()
            case "trace":
                self._answer(self._trace)
            case _:
                self._problem(HTTPStatus.NOT_FOUND, "There is nothing at this address.")

    def do_POST(self) -> None:
        """A request of the page."""
        if (path := self._path()) is None:
            return
        if self.headers.get_content_type() != "application/json" or not self._same_origin():
            self._problem(HTTPStatus.FORBIDDEN, "Only the page itself may ask for this.")
        elif path.removeprefix("api/") not in REQUESTS or not path.startswith("api/"):
            self._problem(HTTPStatus.NOT_FOUND, "There is no such request.")
        else:
            self._answer(lambda: self._called(path.removeprefix("api/")))

    def _path(self) -> str | None:
        """What is asked for, behind the token; None if it is refused, which the client has then been told."""
        host = self.headers.get("Host", "")
        if not self.server.known(host):
            self._problem(
                HTTPStatus.MISDIRECTED_REQUEST,
                f"This server is not called {host[:80]!r}; use the address that rovercheck serve printed.",
            )
            return None
        token, _, rest = self.path.partition("?")[0].removeprefix("/").partition("/")
        if not compare_digest(token.encode(), self.server.token.encode()):
            self._problem(
                HTTPStatus.FORBIDDEN,
                "The token in this address is not valid: it is new each time. "
                "Use the address that rovercheck serve printed last.",
            )
            return None
        return rest

    def _same_origin(self) -> bool:
        origin = self.headers.get("Origin")
        return origin is None or origin.partition("://")[2] == self.headers.get("Host")

    def _called(self, name: str) -> None:
        self._json(HTTPStatus.OK, self.server.api.call(name, self._given()))

    def _given(self) -> dict[str, Any]:
        written = self.headers.get("Content-Length", "")
        if not written.isdecimal() or int(written) > MOST_BYTES:
            raise UsageError(f"A request needs a length of at most {MOST_BYTES:,} bytes.")
        try:
            given = json.loads(self.rfile.read(int(written)) or b"{}")
        except (ValueError, RecursionError):
            raise UsageError("The request is no JSON.") from None
        if not isinstance(given, dict):
            raise UsageError("The request is no JSON object.")
        return given

    def _trace(self) -> None:
        asked = parse_qs(self.path.partition("?")[2]).get("property", [""])[0]
        trace = self.server.api.trace(asked)
        self._send(trace_html.render(trace), "text/html; charset=utf-8", csp=False)

    def _answer(self, work: Any) -> None:
        """Do what is asked for, or say why not."""
        try:
            work()
        except (UsageError, RefusedInput, ModelError) as error:
            self._problem(HTTPStatus.BAD_REQUEST, str(error))
        except ReplayError as error:
            self._problem(HTTPStatus.INTERNAL_SERVER_ERROR, f"This is a bug of rovercheck: {error}")
        except OSError:
            raise  # nobody reads on
        except Exception as error:
            said = f"This is a bug of rovercheck: {described(error)}"
            self._problem(HTTPStatus.INTERNAL_SERVER_ERROR, said)

    def _news(self) -> None:
        """Say when the model was read again or could not be, as long as somebody listens."""
        workspace = self.server.api.workspace
        self._head(HTTPStatus.OK, "text/event-stream", None)
        self.server.listens(1)
        try:
            told: tuple[int, str] | None = None
            while True:
                with workspace.lock:
                    if told == (workspace.version, workspace.problem):
                        workspace.changed.wait(BEAT)
                    now = (workspace.version, workspace.problem)
                if now == told:
                    self.wfile.write(b": nothing new\n\n")
                else:
                    news = json.dumps({"version": now[0], "problem": now[1]})
                    self.wfile.write(f"data: {news}\n\n".encode())
                self.wfile.flush()
                told = now
        except OSError:  # the page was closed
            pass
        finally:
            self.server.listens(-1)

    # --- writing ---

    def _problem(self, status: HTTPStatus, error: str) -> None:
        problem: ProblemDocument = {"error": error}
        self._json(status, problem)

    def _json(self, status: HTTPStatus, value: object) -> None:
        body = json.dumps(value, ensure_ascii=False, separators=(",", ":"))
        self._send(body, "application/json; charset=utf-8", status)

    def _send(self, body: str, kind: str, status: HTTPStatus = HTTPStatus.OK, *, csp: bool = True) -> None:
        """Send a text; one that is no page gets a policy that lets it do nothing, a page brings its own."""
        whole = body.encode()
        self._head(status, kind, len(whole), csp=csp)
        self.wfile.write(whole)

    def _head(self, status: HTTPStatus, kind: str, length: int | None, *, csp: bool = True) -> None:
        self.send_response(status)
        self.send_header("Content-Type", kind)
        if length is not None:
            self.send_header("Content-Length", str(length))
        policy = "default-src 'none'; frame-ancestors 'none'" if csp else "frame-ancestors 'none'"
        self.send_header("Content-Security-Policy", policy)
        for name, value in HEADERS.items():
            self.send_header(name, value)
        self.end_headers()
