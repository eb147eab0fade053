"""Bitwuzla decides the scripts of obligations: a solver that no engine uses, in a child that can be killed.

Niemetz, Preiner, *Bitwuzla*, CAV 2023.
"""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rovercheck.checker.certify.obligations import Obligation
from rovercheck.checker.certify.terms import Malformed
from rovercheck.checker.extras import CERTIFICATES
from rovercheck.checker.process.isolate import ChildStopped, Send, messages

if TYPE_CHECKING:
    import bitwuzla

Values = Mapping[str, int]
"""The raw value of symbols; signed where they are bit-vectors."""


@dataclass(frozen=True)
class ObligationMet:
    """The obligation is met."""

    name: str


@dataclass(frozen=True)
class BrokenSolver:
    """The obligation is not met: values of the symbols asked for that show it."""

    name: str
    values: Values


@dataclass(frozen=True)
class SolverLate:
    """Nothing is known of the obligation, and why."""

    name: str
    reason: str


@dataclass(frozen=True)
class IllFormedScript:
    """The script has no meaning to the solver, which is the fault of the invariant in it."""

    reason: str


Decided = ObligationMet | BrokenSolver | SolverLate


def name() -> str:
    """``Bitwuzla 0.9.1``.  Raises ``ImportError`` where it is not installed."""
    import bitwuzla

    return f"Bitwuzla {bitwuzla.version().split()[0]}"


def decide(
    obligations: Sequence[Obligation], symbols: Sequence[Sequence[str]], seconds: float | None
) -> Iterator[Decided]:
    """What the solver says of each obligation, up to the first that it does not find met.

    ``symbols`` are those of each whose values are wanted.  ``seconds`` is for all obligations together.
    Raises ``Malformed`` where the sorts in an invariant do not fit.
    """
    scripts = [o.script for o in obligations]
    waiting = [o.name for o in obligations]
    try:
        with closing(messages(solve, scripts, symbols, seconds=seconds)) as inbox:
            for message in inbox:
                if message is None:
                    continue
                yield _decided(waiting.pop(0), message)
                if message is not True:
                    return
        ended = "the solver ended without an answer"
    except ChildStopped as stopped:
        ended = str(stopped)
    if waiting:
        yield SolverLate(waiting[0], ended)


def _decided(name: str, message: object) -> Decided:
    if isinstance(message, IllFormedScript):
        raise Malformed(message.reason)
    if isinstance(message, dict):
        return BrokenSolver(name, message)
    return ObligationMet(name) if message is True else SolverLate(name, str(message))


# --- in the child --------------------------------------------------------------------------------


def solve(send: Send, scripts: Sequence[str], symbols: Sequence[Sequence[str]]) -> None:
    """Send True for each script that is unsatisfiable, values for one that is satisfiable, else why neither.

    The solver is imported here, so that nothing but certificates needs it.
    """
    try:
        import bitwuzla
    except ImportError as error:
        return send(CERTIFICATES.needed(f"this ({error})"))
    for script, wanted in zip(scripts, symbols, strict=True):
        manager, options = bitwuzla.TermManager(), bitwuzla.Options()
        options.set(bitwuzla.Option.PRODUCE_MODELS, True)
        parser = bitwuzla.Parser(manager, options)
        try:
            parser.parse(script, True, False)
        except bitwuzla.BitwuzlaException as error:
            return send(IllFormedScript(str(error)))
        solver = parser.bitwuzla()
        result = solver.check_sat()
        if result == bitwuzla.Result.SAT:
            send({symbol: _value(solver.get_value(parser.parse_term(symbol))) for symbol in wanted})
        else:
            send(result == bitwuzla.Result.UNSAT or f"the solver answers {result}")


def _value(term: "bitwuzla.Term") -> int:
    if term.sort().is_bool():
        return int(bool(term.value()))
    bits, number = int(term.sort().bv_size()), int(str(term.value(10)))
    return number - (number >> bits - 1 << bits)
