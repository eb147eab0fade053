"""A table of a scenario file, read key by key, so that nothing written in it goes unnoticed."""

from collections.abc import Iterable, Mapping
from typing import Any

from rovercheck.supervisor.bench.errors import ScenarioError, nearest, quoted
from rovercheck.supervisor.bench.quantities import time_us

MOST = 10**12
"""Numbers in scenarios are smaller."""


class Table:
    """The keys of one table; ``path`` is where it stands in the file."""

    def __init__(self, path: str, written: object) -> None:
        if not isinstance(written, Mapping):
            raise ScenarioError(path, f"{quoted(written)} is no table; write [{path}] and keys below it.")
        self.path = path
        self._left: dict[str, Any] = dict(written)

    def at(self, key: str) -> str:
        """The path of a key."""
        return f"{self.path}.{key}" if self.path else key

    def take(self, key: str, default: object = None) -> Any:
        """What is written there, or the default."""
        return self._left.pop(key, default)

    def need(self, key: str, example: str) -> Any:
        """What is written there; ScenarioError if nothing is."""
        if key not in self._left:
            raise ScenarioError(self.path, f"{key} is missing; write {key} = {example}.")
        return self._left.pop(key)

    def text(self, key: str) -> str:
        """A text on one line, empty if none is written."""
        written = self.take(key, "")
        if not isinstance(written, str):
            raise ScenarioError(self.at(key), f'{quoted(written)} is no text; write it in "quotes".')
        return "".join(filter(str.isprintable, " ".join(written.split())))

    def time_us(self, key: str, default_us: int = 0) -> int:
        """A time in microseconds."""
        return time_us(self.at(key), self._left.pop(key)) if key in self._left else default_us

    def whole(self, key: str) -> int:
        """A whole number, 0 if none is written."""
        written = self.take(key, 0)
        if isinstance(written, bool) or not isinstance(written, int) or abs(written) > MOST:
            raise ScenarioError(
                self.at(key), f"{quoted(written)} is no whole number; write one without a unit."
            )
        return written

    def tables(self, key: str) -> list["Table"]:
        """The tables written as ``[[key]]``, numbered from 1 in their paths."""
        written = self.take(key, [])
        if not isinstance(written, list):
            raise ScenarioError(self.at(key), f"there may be several; write [[{key}]] before each.")
        return [Table(f"{self.at(key)}[{number}]", one) for number, one in enumerate(written, 1)]

    def rest(self) -> dict[str, Any]:
        """What has not been taken."""
        rest, self._left = self._left, {}
        return rest

    def end(self, known: Iterable[str]) -> None:
        """ScenarioError if something is left that has no meaning here."""
        for key in self._left:
            raise ScenarioError(self.at(key), f"there is no such key. {nearest(key, known)}")


def number(path: str, written: object) -> float:
    """A finite number without unit, whole if it is written so; ScenarioError for anything else."""
    if isinstance(written, bool) or not isinstance(written, int | float) or not -MOST <= written <= MOST:
        raise ScenarioError(path, f"{quoted(written)} is no number; write one without a unit.")
    return written


def truth(path: str, written: object) -> bool:
    """True or false; ScenarioError for anything else."""
    if not isinstance(written, bool):
        raise ScenarioError(path, f"{quoted(written)} is neither true nor false; write one of them.")
    return written
