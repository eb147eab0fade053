"""Domains that may be meant for inputs and data of which a file says no range, for a person to correct."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.lower.domains import lines_of
from rovercheck.checker.drawn.lower.lowered import RangeNotKnown
from rovercheck.checker.drawn.lower.uses import uses_of
from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.spec_model.lang.domain import Domain, chosen, fixed

WIDE = fixed(-1_000_000, 1_000_000, Fraction(1, 1000))
"""What stands for a domain while the constants are looked for with which a datum is compared."""
STEPS = (Fraction(1), Fraction(1, 2), Fraction(1, 4), Fraction(1, 10), Fraction(1, 100), Fraction(1, 1000))
ATTEMPTS = 20
BETWEEN_1 = ("sin", "cos", "tanh", "erf")
"""Functions whose values are from -1 to 1, which may be free."""


@dataclass(frozen=True)
class ProposedDomain:
    """A domain for a datum; ``why`` says on what it rests, and ``sure`` that it loses nothing."""

    name: str
    domain: Domain
    why: str
    sure: bool


def proposed_domains(
    model: DrawnModel, file: str, given: Mapping[str, Domain], step: str = ""
) -> list[ProposedDomain]:
    """A domain for each datum that needs one and has none.  Raises ``NotLowered`` for anything else."""
    wide: dict[str, Domain] = {}
    for _ in range(ATTEMPTS):
        try:
            lowered = lowered_model(model, file, {**wide, **given}, step)
        except RangeNotKnown as error:
            if not set(error.names) - wide.keys():
                raise
            wide |= dict.fromkeys(error.names, WIDE)
        else:
            break
    uses = uses_of(lowered)
    found = [_proposed(name, *uses.get(name, (set(), False)), name in lowered.inputs) for name in wide]
    idle = {name for name in wide if name not in lowered.inputs and not uses.get(name, (set(), False))[0]}
    return [one for one in found if one.name not in idle - _needed(model, file, found, idle, given, step)]


def _needed(
    model: DrawnModel, file: str, found: Sequence[ProposedDomain], idle: Collection[str],
    given: Mapping[str, Domain], step: str,
) -> set[str]:  # fmt: skip
    """Of data that are compared with nothing, those whose range does not follow from that of the others."""
    needed = set[str]()
    for _ in range(ATTEMPTS):
        domains = {one.name: one.domain for one in found if one.name not in idle or one.name in needed}
        try:
            lowered_model(model, file, {**domains, **given}, step)
        except RangeNotKnown as error:
            if not set(error.names) - needed:
                break
            needed |= set(error.names)
        else:
            return needed
    return set(idle)


def _proposed(name: str, constants: set[Fraction], otherwise: bool, is_input: bool) -> ProposedDomain:
    if is_input and name in BETWEEN_1:
        return ProposedDomain(name, fixed(-1, 1, Fraction(1, 8)), "its values are from -1 to 1", False)
    if not constants:
        said = "computed with, and compared with no constant" if otherwise else "nothing reads it"
        return ProposedDomain(name, fixed(0, 100, 1), said, False)
    step = _step(constants)
    told = ", ".join(f"{float(one):g}" for one in sorted(constants))
    if is_input and not otherwise:
        near = {one + by for one in constants for by in (-step, 0, step)}
        return ProposedDomain(name, chosen(near), f"only compared, with {told}: on it and beside it", True)
    room = max(constants) - min(constants) or abs(max(constants)) or 1
    low, high = min(Fraction(0), min(constants) - room), max(constants) + room
    ends = (low // step) * step, -(-high // step) * step
    said = (
        f"compared with {told}, and computed with"
        if is_input
        else f"assigned in the model, compared with {told}"
    )
    return ProposedDomain(name, fixed(*ends, step), said, False)


def _step(constants: set[Fraction]) -> Fraction:
    """A resolution in which all constants are exact, and that is finer than what lies between them."""
    gaps = [b - a for a, b in pairwise(sorted(constants))]
    for step in STEPS:
        if all((one / step).denominator == 1 for one in constants) and all(gap > 2 * step for gap in gaps):
            return step
    return STEPS[-1]


def proposed_lines(found: list[ProposedDomain]) -> Iterator[str]:
    """Lines for a file of domains, each with what it rests on."""
    for one in found:
        [line] = lines_of({one.name: one.domain})
        yield f"{line}  # {'' if one.sure else 'check: '}{one.why}"


__all__ = ["ProposedDomain", "proposed_domains", "proposed_lines"]
