"""An implementation in a process of its own that speaks JSON lines, whoever wrote it."""

import json
import os
import sys
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from rovercheck.checker.adapters import AdapterLimits, launch, lines
from rovercheck.checker.adapters.channel import BrokenChannel, Channel
from rovercheck.checker.adapters.implementation import KEPT, ImplementationError, Value, Values
from rovercheck.spec_model.lang.errors import did_you_mean

RESET = lines.encoded({"reset": True})
MAIN = "from rovercheck.checker.adapters.child import main; main()"


class ReportedFault(BrokenChannel):
    """What the implementation itself reports, or what it answers without meaning; the message is whole."""


class Process:
    """An implementation that is asked by lines and answers each with a line (docs/adapters.md).

    ``connect`` starts the process, again after each error.  ``names`` are the outputs of the board: an answer
    may leave some out, and has no other.
    """

    def __init__(
        self,
        address: str,
        connect: Callable[[], Channel],
        names: Collection[str],
        limits: AdapterLimits,
        notes: Sequence[str] = (),
    ) -> None:
        self.notes = notes
        self._address, self._connect, self._names, self._limits = address, connect, frozenset(names), limits
        self._channel: Channel | None = None
        self._closed = False
        self._steps = 0
        self.reset()

    def reset(self) -> None:
        """Return to power-up, in a fresh process after an error."""
        if self._closed:
            raise ImplementationError(f"{self._address}: it is closed; start it again.")
        self._steps = 0
        fresh = self._channel is None
        with self._speaking() as channel:
            channel.send(RESET)
            if found := self._answer(channel, self._limits.start if fresh else self._limits.step):
                raise BrokenChannel(f"answered {lines.shown(found)} to the reset; write {{}}")

    def step(self, inputs: Values) -> dict[str, Value]:
        """Execute one step.  Raises ``ImplementationError`` with its number, counted from the reset."""
        return self.run([inputs])[0]

    def run(self, inputs: Sequence[Values]) -> list[dict[str, Value]]:
        """Execute steps in a row, the process computing while answers are on their way."""
        if self._channel is None:
            raise ImplementationError(f"{self._address}: it is not running; reset it first.")
        with self._speaking() as channel:
            channel.send(b"".join([lines.encoded({"step": one}) for one in inputs]))
            return [self._outputs(channel) for _ in inputs]

    def close(self) -> None:
        """End the process and all that it started."""
        self._closed = True
        if self._channel is not None:
            self._channel.close()
            self._channel = None

    def _outputs(self, channel: Channel) -> dict[str, Value]:
        self._steps += 1
        found = lines.values(self._answer(channel, self._limits.step))
        check_names(found, self._names)
        return found

    def _answer(self, channel: Channel, seconds: float) -> dict[str, object]:
        found = lines.decoded(channel.receive(seconds))
        if "error" in found:
            raise ReportedFault(str(found["error"]))
        return found

    @contextmanager
    def _speaking(self) -> Iterator[Channel]:
        """The process; whatever goes wrong ends it, so that no answer is taken for a later one."""
        try:
            self._channel = self._channel or self._connect()
            yield self._channel
        except (BrokenChannel, ValueError, OSError) as error:
            raise self._failed(error) from None
        except BaseException:
            self._stopped()
            raise

    def _failed(self, error: Exception) -> ImplementationError:
        what = "" if isinstance(error, ReportedFault) else "the process "
        what += "cannot be started: " if isinstance(error, OSError) else ""
        what += "answered " if isinstance(error, ValueError) else ""
        said = "".join(f"\n  {line}" for line in self._stopped())
        heard = f"\nIts standard error ends with{said}" if said else ""
        return failure(self._address, self._steps, f"{what}{error}", heard)

    def _stopped(self) -> list[str]:
        """Kill the process; its last complaints."""
        channel, self._channel = self._channel, None
        if channel is None:
            return []
        channel.kill()
        return channel.complaints()


def check_names(found: Mapping[str, Value], names: Collection[str]) -> None:
    """Raise ``ReportedFault`` unless these are outputs of the board: no others can be compared."""
    for name in found:
        if name not in names and not name.startswith(KEPT):
            raise ReportedFault(
                f"the board has no output {name!r}, which was answered. {did_you_mean(name, names)}"
            )
    if not found:
        raise ReportedFault("no output was answered, so that nothing can be compared; answer one at least")


def failure(address: str, step: int, what: str, more: str = "") -> ImplementationError:
    """What went wrong at a step, counted from power-up, which is 0."""
    where = f"step {step}" if step else "at power-up"
    return ImplementationError(
        f"{address}: {where}: {what if what[-1:] in '.?!' else what + '.'}{more}", step
    )


def ours(module: str, options: Mapping[str, object], limits: AdapterLimits) -> Channel:
    """A process of ours in which ``module.made(**options)`` makes what carries out steps."""
    order = json.dumps({"module": module, "options": options, "memory": limits.memory})
    path = os.pathsep.join(filter(None, sys.path))
    # -P: no module is taken from the folder we happen to be in before those of the path.
    return Channel(
        [sys.executable, "-P", "-c", MAIN, order],
        {**os.environ, **limits.environment, "PYTHONPATH": path, "PYTHONHASHSEED": "0"},
    )


def theirs(command: Sequence[str], limits: AdapterLimits) -> Channel:
    """A process of the user's, confined as ours are."""
    program = str(Path(launch.__file__))
    return Channel([sys.executable, "-I", "-S", program, str(limits.memory), *command])
