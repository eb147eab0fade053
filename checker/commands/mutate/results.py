"""What ``rovercheck mutate`` has found so far."""

from dataclasses import dataclass, field

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.mutate.fate import Fate, MutantFate
from rovercheck.checker.mutate.mutants import Mutant

One = tuple[str, Mutant, MutantFate]
"""The system in which a part was made faulty, the mutant, and its fate."""


@dataclass
class MutationResults:
    """What is known so far: each mutant with its system and its fate; ``made`` counts all, sampled or not."""

    systems: tuple[str, ...]
    made: int = 0
    chosen: int = 0
    seed: int | None = None
    undecided: list[str] = field(default_factory=list)
    judged: list[One] = field(default_factory=list)
    searched: set[str] = field(default_factory=set)
    """Mutants of ``told``, by id, that were not judged before something was searched."""

    def of(self, *fates: Fate) -> list[One]:
        """Those with one of some fates."""
        return [one for one in self.judged if one[2].fate in fates]

    @property
    def code(self) -> Exit:
        """A survivor outweighs what is not known."""
        if self.of(Fate.SURVIVOR):
            return Exit.FAILED
        return Exit.INCONCLUSIVE if self.of(Fate.UNKNOWN) or self.undecided else Exit.AS_EXPECTED


__all__ = ["MutationResults", "One"]
