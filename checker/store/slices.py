"""The slice that the verdict on a property depends on, as text that is equal where it is written alike."""

import json
from collections.abc import Callable, Mapping
from functools import lru_cache
from hashlib import sha256

from rovercheck.checker.cache import entries
from rovercheck.checker.encode.dead_branches import narrowed
from rovercheck.checker.encode.value_sets import Values
from rovercheck.checker.system.digest import PartDigests
from rovercheck.checker.system.intervals import Interval
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.system.slice import sliced
from rovercheck.checker.system.width import WIDE, bits_of, driven
from rovercheck.properties.forms import Property
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.lower import ByIdentity
from rovercheck.spec_model.lang.system import System, TransitionSystem

_GUESSES = 3
"""That are kept of a system: before an edit, after it, and once more."""


class SliceTexts:
    """Makes the keys of slices.

    ``values`` is the name under which it is kept what the variables of a system were worth lately, given the
    name of the system: after an edit these are guesses, of which one is most often right.
    """

    def __init__(self, values: Callable[[str], str | None]) -> None:
        self._values = values
        self._digests = PartDigests()
        self._least = lru_cache(maxsize=2)(self._narrowed)

    def __call__(self, prop: Property, system: System) -> str | None:
        """The key of the slice; None of a system that is not well formed, or has not all that is named.

        What may be checked of domains is part of it: nothing is proved of a system that leaves one.
        """
        try:
            question = reduce(self._without_dead_branches(system), [prop])
        except (ModelError, KeyError):
            return None
        whole = question.system
        goals = [v for goal in question.goals for v in (goal.var, *goal.recurs)]
        checks = [check for check, _ in whole.checks]
        least = sliced(whole, [*goals, *checks])
        said = system.name, system.over, system.under, system.concrete, whole.tick_ms, len(goals)
        parts = self._digests.system(least), *map(self._digests.expr, (*goals, *checks))
        elapsed = b"" if whole.elapsed is None else self._digests.expr(whole.elapsed)
        return sha256(b"\n".join((repr(said).encode(), *parts, elapsed))).hexdigest()

    def _without_dead_branches(self, system: System) -> TransitionSystem:
        """The transition system; of a scene, in which little is chosen, only what it makes the system do."""
        whole = lowered(system)
        return self._least(ByIdentity(system)) if driven(whole) and bits_of(whole.variables) > WIDE else whole

    def _narrowed(self, key: ByIdentity[System]) -> TransitionSystem:
        name = self._values(key.part.name)
        kept = None if name is None else entries.read(name, code=False)
        guesses = [] if kept is None else _guesses(kept)
        found = narrowed(lowered(key.part), sorted(guesses, key=_size))
        if name is not None and found.values not in guesses:
            rows = [{n: _row(v) for n, v in one.items()} for one in (found.values, *guesses)]
            entries.write(name, json.dumps(rows[:_GUESSES], separators=(",", ":")).encode())
        return found.system


def _row(values: Values) -> list[int] | dict[str, int]:
    if isinstance(values, Interval):
        return {"from": values.low, "to": values.high}
    return sorted(values)


def _guesses(kept: bytes) -> list[Mapping[str, Values]]:
    """What was written; nothing of anything else."""
    try:
        return [{str(name): _read(row) for name, row in one.items()} for one in json.loads(kept)]
    except entries.MEANINGLESS:
        return []


def _size(guess: Mapping[str, Values]) -> int:
    """How many values: the fewer, the more branches are dead."""
    return sum(v.high - v.low + 1 if isinstance(v, Interval) else len(v) for v in guess.values())


def _read(row: object) -> Values:
    match row:
        case {"from": int(low), "to": int(high)}:
            return Interval(low, high)
        case list() if row and all(type(value) is int for value in row):
            return frozenset(row)
    raise ValueError(f"{str(row)[:60]} is nothing that a variable is worth")
