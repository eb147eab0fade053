"""What becomes of the chains of the promises where charts or interpretations are changed: link by link."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from rovercheck.checker.commands.check.chains import check
from rovercheck.checker.model.variant import Variant
from rovercheck.checker.mutate.product import same
from rovercheck.checker.mutate.relevance import depends_on
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.properties.catalogue import promises
from rovercheck.properties.forms import Property
from rovercheck.properties.promises.promise import Chain, Promise
from rovercheck.spec_model.lang.system import System, TransitionSystem

if TYPE_CHECKING:
    from rovercheck.checker.verify.checked import CheckedProperty


@dataclass(frozen=True)
class ChainStatus:
    """A chain of a promise: whether all its links hold (None: that is not known), and those that do not."""

    promise: Promise
    chain: Chain
    holds: bool | None
    failing: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """``STOP over PSY-10e does not hold: PSY-10m is violated.``"""
        name = f"{self.promise.id} over {self.chain.across}"
        if self.holds:
            return f"{name} holds."
        so = "is not known to hold" if self.holds is None else "does not hold"
        verb = "is" if len(self.failing) == 1 else "are"
        word = "not decided" if self.holds is None else "violated"
        return f"{name} {so}: {', '.join(self.failing)} {verb} {word}."


@dataclass(frozen=True)
class Chains:
    """The chains of all promises under a variant; those that rest on another repair are left out."""

    variant: Variant

    @cached_property
    def chosen(self) -> Sequence[tuple[Promise, Chain]]:
        """The chains, each without a hole.  Raises ``ModelError`` that names every hole with its place."""
        repair = self.variant.repair.name if self.variant.repair else ""
        found = [(p, c) for p in promises() for c in p.chains if c.under in ("", repair)]
        for promise in {p.id: p for p, _ in found}.values():
            check(promise)
        return found

    @cached_property
    def links(self) -> Mapping[str, Property]:
        """The links to decide, by id: those of which the variant asks another question than the charts as
        specified do.  Of all others, whose slices are written alike, the expected verdict stands.
        """
        ids = dict.fromkeys(id for _, chain in self.chosen for id in chain.properties)
        stated = self.variant.properties()
        links = [stated[id] for id in ids]
        if self.variant.name:
            specified, before, after = Variant({}).properties(), Variant({}).systems(), self.variant.systems()
            concerned = sorted(filter(self.variant.concerns(), links), key=lambda p: p.on)
            made = {p.id: p for p in self.variant.askable(concerned)[0]}
            links = [
                p
                for p in concerned
                if p.id not in made or not same(_slice(before, specified[p.id]), _slice(after, made[p.id]))
            ]
        return {p.id: p for p in links}

    def standings(self, found: Sequence["CheckedProperty"]) -> list[ChainStatus]:
        """What becomes of each chain, from the verdicts that were found and else the expected ones."""
        known = {id: "unknown" for id in self.links} | {c.result.property.id: c.verdict.word for c in found}
        told = list[ChainStatus]()
        for promise, chain in self.chosen:
            words = {id: known.get(id, self.variant.model.expected(id).verdict) for id in chain.properties}
            broken = tuple(id for id, word in words.items() if word == "violated")
            left = tuple(id for id, word in words.items() if word == "unknown")
            told.append(
                ChainStatus(promise, chain, False if broken else None if left else True, broken or left)
            )
        return told


def _slice(systems: Mapping[str, System], prop: Property) -> TransitionSystem:
    """What the verdict on a property rests on."""
    return depends_on(lowered(systems[prop.on]), prop)


__all__ = ["ChainStatus", "Chains"]
