"""What is asked of verdicts once they are found: whether cases occur, chains hold, and a fault is noticed."""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rovercheck.checker.model import Model
from rovercheck.checker.model.kept_runs import KILLS, file_of, read
from rovercheck.checker.results.verdict import Proved
from rovercheck.properties.forms import Property, Reachable, Unbounded

if TYPE_CHECKING:
    from rovercheck.checker.commands.check.chain_status import ChainStatus
    from rovercheck.checker.verify.checked import CheckedProperty, PremiseCase


def _ignore(_: "CheckedProperty") -> None:
    """Nothing is asked while others are searched for."""


def _no_cases(_: Sequence["CheckedProperty"]) -> Mapping[str, "PremiseCase"]:
    return {}


def _nothing_kept(_: Sequence["CheckedProperty"]) -> None:
    """No proof is recorded."""


def _no_chains(_: Sequence["CheckedProperty"]) -> Sequence["ChainStatus"]:
    return ()


@dataclass(frozen=True)
class CheckExtras:
    """What is asked of the verdicts; by default nothing.

    ``on_result`` receives each result while others are searched for.  ``cases`` says of each proof that
    speaks of a case, by id, whether the case occurs, ``chains`` what becomes of chains of properties.
    ``noticing`` are the properties that notice a recorded fault; None where none are kept.  ``keep`` records
    proofs in record.
    """

    on_result: Callable[["CheckedProperty"], None] = _ignore
    cases: Callable[[Sequence["CheckedProperty"]], Mapping[str, "PremiseCase"]] = _no_cases
    chains: Callable[[Sequence["CheckedProperty"]], Sequence["ChainStatus"]] = _no_chains
    noticing: Collection[str] | None = None
    keep: Callable[[Sequence["CheckedProperty"]], None] = _nothing_kept

    def noticed(self, one: "CheckedProperty") -> bool | None:
        """Whether a fault is known that a proof notices; None of what no fault is looked for."""
        prop = one.result.property
        if self.noticing is None or not isinstance(one.verdict, Proved) or not needs_mutant(prop):
            return None
        return prop.id in self.noticing


def needs_mutant(prop: Property) -> bool:
    """Whether a fault is looked for that a property notices: not of those that take long, nor of situations
    and of what happens some day.
    """
    return not prop.costly and not isinstance(prop.form, Reachable | Unbounded)


def noticing(model: Model, only: Collection[str] | None = None) -> frozenset[str] | None:
    """The properties that notice a fault, or the charts as they are; None if no kills are recorded.

    With ``only``, those among these.
    """
    place = file_of(model, KILLS)
    if not place.exists():
        return None
    broken = {id for id in model.properties if model.expected(id).verdict == "violated"}
    return frozenset(broken | read(place, KILLS, only).keys())


NOTHING_FURTHER = CheckExtras()

__all__ = ["NOTHING_FURTHER", "CheckExtras", "needs_mutant", "noticing"]
