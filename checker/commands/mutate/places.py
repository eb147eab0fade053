"""Which properties constrain each arrow, action, wire and initial value: what kills the faults put there."""

from collections.abc import Iterator
from dataclasses import dataclass

from checker.commands.mutate.found import MutationResults, One
from checker.mutate.judging import Fate

FAULTY = (Fate.KILLED, Fate.SURVIVOR, Fate.UNKNOWN, Fate.NOTICED)
"""What becomes of a mutant that is not known to behave like the original."""


@dataclass(frozen=True)
class Site:
    """A place in a chart or block: ``Relay/arrow/B1_actuating.1``, with the fates of its mutants."""

    name: str
    told: tuple[One, ...]

    @property
    def killers(self) -> tuple[str, ...]:
        """The properties that notice a fault there, those first that notice most."""
        ids = [judged.killer for _, _, judged in self.told if judged.fate is Fate.KILLED]
        return tuple(sorted(set(ids), key=lambda id: (-ids.count(id), id)))

    @property
    def counts(self) -> str:
        """``3 of 4 killed``; what behaves like the original, or is no chart, is not counted."""
        faults = [judged.fate for _, _, judged in self.told if judged.fate in FAULTY]
        return f"{faults.count(Fate.KILLED)} of {len(faults)} killed" if faults else "no fault"

    @property
    def by(self) -> str:
        """The killers, or that there is none though something can go wrong."""
        return ", ".join(self.killers) or ("-" if self.counts == "no fault" else "NO PROPERTY")


def sites(found: MutationResults) -> Iterator[Site]:
    """The places in the order in which faults were made."""
    by: dict[str, list[One]] = {}
    for one in found.told:
        by.setdefault(one[1].id.rpartition("/")[0], []).append(one)
    return (Site(name, tuple(told)) for name, told in by.items())


__all__ = ["Site", "sites"]
