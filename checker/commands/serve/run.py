"""``rovercheck serve``: reads the model, watches it, and serves the page until it is ended."""

import gc
import secrets
import signal
import socket
import webbrowser
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from errno import EACCES, EADDRINUSE, EADDRNOTAVAIL
from ipaddress import ip_address

from rovercheck.checker.commands.serve.api import Api
from rovercheck.checker.commands.serve.jobs import Jobs
from rovercheck.checker.commands.serve.server import PageServer
from rovercheck.checker.commands.serve.watch import ModelWatch
from rovercheck.checker.commands.serve.workspace import Workspace
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.options import VariantOptions
from rovercheck.checker.commands.shared.output import err, out
from rovercheck.checker.process.garbage import collect_seldom


def serve(host: str, port: int, options: VariantOptions, *, opening: bool) -> Exit:
    """Serve the page until Ctrl-C.

    Raises ``UsageError`` for an address that cannot be had, ``ModelError`` for a model that cannot be read.
    """
    collect_seldom()
    workspace = Workspace(options)
    gc.freeze()  # the models stay: they are not looked through again
    jobs = Jobs()
    server = _bound(host, port, Api(workspace, jobs))
    if not _local(host):
        err.print(
            f"Whoever can reach {host} and knows the address may explore this model and run searches here.",
            style="yellow",
        )
    _end_on_signal()
    with server, watched(workspace):
        with suppress(KeyboardInterrupt):  # the usual way to end it
            out.print(f"The page is at {server.url}", markup=False, soft_wrap=True)
            out.file.flush()
            err.print("Only who knows this address can see it. Ctrl-C ends it.", style="dim")
            if opening and not webbrowser.open(server.url):
                err.print("No browser could be opened; open the address by hand.", style="yellow")
            server.serve_forever()
        jobs.cancel()
    return Exit.AS_EXPECTED


def _bound(host: str, port: int, api: Api) -> PageServer:
    token = secrets.token_urlsafe(24)
    try:
        return PageServer(host, port, api, token)
    except socket.gaierror:
        said = f"--host {host}: this is no address of a machine; leave it out for 127.0.0.1."
        raise UsageError(said) from None
    except OSError as error:
        raise UsageError(_refused(host, port, error)) from None


def _refused(host: str, port: int, error: OSError) -> str:
    match error.errno:
        case code if code == EADDRINUSE:
            return f"Port {port} of {host} is in use, perhaps by another page; write --port 0 for a free one."
        case code if code == EACCES:
            return f"Port {port} is not for everybody; write --port 0 for a free one."
        case code if code == EADDRNOTAVAIL:
            return f"--host {host}: this machine has no such address; leave it out for 127.0.0.1."
    return f"The page cannot be served at {host}, port {port}: {error.strerror or error}."


def _local(host: str) -> bool:
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"


@contextmanager
def watched(workspace: Workspace) -> Iterator[None]:
    """Read the model again whenever it is saved."""
    path = workspace.options.model
    watch = ModelWatch(path, workspace.reload, workspace.trouble) if path is not None else None
    if watch is not None:
        watch.start()
    try:
        yield
    finally:
        if watch is not None:
            watch.stop()


def _end_on_signal() -> None:
    """End on a request to end as on Ctrl-C."""
    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) is not signal.SIG_IGN:  # not under nohup
            signal.signal(number, signal.default_int_handler)
