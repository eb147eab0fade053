"""Verdicts for the items of a session: the properties of one system are decided together, once."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import pytest

from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.commands.shared.failure import alarm, error_message
from rovercheck.checker.commands.shared.select import pick_engine
from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.engines import Limits
from rovercheck.checker.model.kept_invariants import invariants_of
from rovercheck.checker.process.faults import Fault, listening
from rovercheck.checker.render.verdict_text import evidence, recorded
from rovercheck.checker.store.verdicts import store
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.checker.verify.searches import SearchSettings

if TYPE_CHECKING:
    from rovercheck.checker.pytest_plugin.item import PropertyItem

Key = tuple[int, str]
"""A model, by identity, and a property of it."""


class NoVerdict(Exception):
    """There is no verdict; the message says why."""


@dataclass
class Decider:
    """Decides properties when the first of their system is asked for.

    ``apart``: each alone, because the items of a system may be spread over several workers.
    """

    engine: str
    limits: Limits
    jobs: int | None = None
    apart: bool = False
    _found: dict[Key, CheckedProperty | NoVerdict] = field(default_factory=dict)

    @staticmethod
    def of(config: pytest.Config) -> "Decider":
        """What the options of pytest ask for.  Raises ``pytest.UsageError``."""
        seconds = config.getoption("rovercheck_timeout")
        if seconds is not None and not seconds > 0:
            raise pytest.UsageError("--rovercheck-timeout needs seconds, more than 0.")
        depth = config.getoption("rovercheck_depth")
        if depth is not None and depth < 1:
            raise pytest.UsageError("--rovercheck-depth needs ticks, at least 1.")
        try:
            engine = pick_engine(config.getoption("rovercheck_engine"))
        except UsageError as error:
            raise pytest.UsageError(f"--rovercheck-engine: {error}") from error
        worker = hasattr(config, "workerinput")
        apart = worker and not getattr(config.option, "loadgroup", False)  # xdist's own word for it
        return Decider(engine, Limits(depth, seconds), 1 if worker else None, apart)

    def compared(self, item: "PropertyItem") -> CheckedProperty:
        """The verdict of an item beside the expected one.  Raises ``NoVerdict``."""
        key = _key(item)
        if key not in self._found:
            self._decide([item] if self.apart else _together(item))
        found = self._found[key]
        if isinstance(found, NoVerdict):
            raise found
        return found

    def _decide(self, items: Sequence["PropertyItem"]) -> None:
        model, left = items[0].model, {item.prop.id: item for item in items}
        properties = [item.prop for item in items]
        faults: list[Fault] = []
        try:
            with listening(faults.append):
                search = SearchSettings(
                    self.engine,
                    self.limits,
                    self.jobs,
                    invariants_of(model),
                    store=store(self.engine, self.limits),
                )
                found = results(properties, model.systems, search, quiet=True)
                for one in found:  # no progress line: with `pytest -s` the line is one of pytest's
                    item = left.pop(one.property.id)
                    self._found[_key(item)] = CheckedProperty(one, model.expected(item.prop.id))
        except Exception as error:
            self._found |= {_key(item): NoVerdict(error_message(error)) for item in left.values()}
        if faults:
            self._found |= {_key(item): self._faulty(item, faults) for item in items}

    def _faulty(self, item: "PropertyItem", faults: Sequence[Fault]) -> NoVerdict:
        """What is said of an item while whose system was decided an engine failed: its verdict, too."""
        found = self._found[_key(item)]
        if isinstance(found, NoVerdict):
            return found
        verdict = f"{item.prop.id} is {found.word}; expected: {recorded(found.expected)}"
        verdict += f": {evidence(found.result)}"
        return NoVerdict("\n".join([verdict, *dict.fromkeys(map(alarm, faults))]))


def _key(item: "PropertyItem") -> Key:
    return id(item.model), item.prop.id


def _together(item: "PropertyItem") -> list["PropertyItem"]:
    """The items of the session about the same system that are not to be skipped."""
    others = (i for i in item.session.items if type(i) is type(item))
    return [
        other
        for other in others
        if (other.model is item.model and other.prop.on == item.prop.on)
        and (other is item or not any(other.iter_markers("skip")))
    ]
