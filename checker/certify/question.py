"""The question that a certificate answers: can some run make one of the claimed goals true?

It is written as SMT-LIB text, so that everybody can read what was proved, and known by the digest of
that text.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from hashlib import sha256

from rovercheck.checker.certify.smtlib import (
    Printer,
    among,
    define,
    joined,
    own,
    quoted,
    sort,
    sort_bits,
    within,
)
from rovercheck.checker.certify.terms import Sort
from rovercheck.checker.certify.tick import CertifiedTick, SymbolicStep
from rovercheck.spec_model.lang.expr import Var


@dataclass(frozen=True)
class CertifyQuestion:
    """Claimed goals of a system, and the part of the system that decides them.

    ``kept`` are the positions of the conjuncts of the assumption that the proof uses: what holds with
    fewer of them holds with all.  ``about`` are the variables that the invariant speaks of.
    """

    claims: tuple[str, ...]
    kept: tuple[int, ...]
    about: tuple[str, ...]
    tick: CertifiedTick

    @cached_property
    def text(self) -> str:
        """The transition system in SMT-LIB (docs/certificates.md)."""
        claimed = f"; claimed: never {' '.join(quoted(c, 1) for c in self.claims)}"
        return "\n".join([claimed, *self.valuation(), *self.one_tick(0), *self.initial(), ""])

    @cached_property
    def digest(self) -> str:
        """SHA-256 of the text, in hexadecimal."""
        return sha256(self.text.encode()).hexdigest()

    @property
    def state(self) -> tuple[Var, ...]:
        """What makes up a state: frozen variables, then the others."""
        return (*self.tick.frozen, *self.tick.variables)

    def symbols(self, at: int) -> dict[str, str]:
        """The symbol of every variable after ``at`` ticks, and of every input of the tick that follows."""
        frozen = {v.name: quoted(v.name) for v in self.tick.frozen}
        return frozen | {v.name: quoted(v.name, at) for v in (*self.tick.variables, *self.tick.inputs)}

    @property
    def spoken(self) -> dict[str, Sort]:
        """The symbols, before a tick, of the variables that the invariant may speak of, with their sorts."""
        symbols = self.symbols(0)
        return {symbols[v.name]: sort_bits(v.domain) for v in self.state if v.name in self.about}

    def valuation(self) -> list[str]:
        """A state of any values, and the formula that all of them belong to their domains."""
        symbols = self.symbols(0)
        inside = [within(symbols[v.name], v.domain) for v in self.state]
        declared = [f"(declare-const {symbols[v.name]} {sort(v.domain)})" for v in self.state]
        return [*declared, define(own("domain", 0), "Bool", joined("and", inside))]

    def initial(self) -> list[str]:
        """The formula that the variables are as before the first tick."""
        parts = [among(quoted(v.name, 0), v.domain, [(v.init, v.init)]) for v in self.tick.variables]
        return [define(own("init", 0), "Bool", joined("and", parts))]

    def one_tick(self, at: int) -> list[str]:
        """The inputs of a tick, the state after it, what is assumed, and what must not happen."""
        inputs, symbols = self.tick.inputs, self.symbols(at)
        printer = Printer(symbols, at)
        declared = [f"(declare-const {symbols[v.name]} {sort(v.domain)})" for v in inputs]
        assumed = [within(symbols[v.name], v.domain) for v in inputs]
        assumed += [printer.boolean(part) for part in self.tick.assume]
        after = [(v, self.tick.next[v.name]) for v in self.tick.variables]
        values = [(v, printer.value(value, v.domain)) for v, value in after]
        stays = [printer.fits(value, v.domain) for v, value in after]
        return [
            *declared,
            *printer.lines,
            define(own("assume", at), "Bool", joined("and", assumed)),
            *(define(quoted(v.name, at + 1), sort(v.domain), value) for v, value in values),
            define(own("stays", at), "Bool", joined("and", stays)),
        ]


def question(
    step: SymbolicStep, claims: Sequence[str], kept: Sequence[int], about: Sequence[str]
) -> CertifyQuestion:
    """The question whether the claimed goals are ever true after a tick.

    Raises ``KeyError`` for a name that is no variable of the system, ``IndexError`` for a position that is
    none of a conjunct of its assumption.
    """
    return CertifyQuestion(tuple(claims), tuple(kept), tuple(about), step.cone([*claims, *about], kept))
