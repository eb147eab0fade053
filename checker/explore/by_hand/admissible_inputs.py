"""Which inputs a system admits: what an assumption has against some, and how to draw others at random."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from random import Random

from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import TRUE, Apply, Expr, Named, Var
from rovercheck.spec_model.lang.label import text
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.walk import variables

KEPT = 0.75
"""The probability that an input drawn at random keeps its value: timers need quiet to run out."""
TRIES = 400
MOST_VALUES = 512
"""Values of a large domain that are tried for one input."""


@dataclass(frozen=True)
class AssumedInputs:
    """A condition on the inputs of a tick: one conjunct, and the assumption that it belongs to."""

    formula: Expr
    id: str = ""
    text: str = ""

    @property
    def names(self) -> frozenset[str]:
        """The variables that it speaks of."""
        return frozenset(variables(self.formula))

    @property
    def said(self) -> str:
        """Which assumption this is, and what it asks for."""
        of = f"assumption {self.id} ({self.text.rstrip('.')})" if self.id else "the system's environment"
        return f"{of} requires {text(self.formula, unfold=True)}."


def assumed(system: TransitionSystem) -> Iterator[AssumedInputs]:
    """Every conjunct of what a system assumes, with the assumption that it belongs to."""
    source = system.source
    if source is None:
        yield from (AssumedInputs(part) for part in conjuncts(system.assume))
        return
    yield from (AssumedInputs(part) for part in conjuncts(source.assume))
    for one in source.assumptions:
        yield from (AssumedInputs(part, one.id, one.text) for part in conjuncts(one.formula))


def conjuncts(formula: Expr | None) -> Sequence[Expr]:
    """The parts of a condition that must all be true; none for no condition."""
    if formula is None or formula is TRUE:
        return ()
    body = formula.body if isinstance(formula, Named) else formula
    if isinstance(body, Apply) and body.op is Op.AND:
        return [part for arg in body.args for part in conjuncts(arg)]
    return (formula,)


def broken(
    system: TransitionSystem, before: Mapping[str, int], inputs: Mapping[str, int]
) -> tuple[AssumedInputs, ...]:
    """The conditions that inputs break in the tick after a state."""
    at = {**before, **inputs}
    return tuple(one for one in assumed(system) if not evaluate(one.formula, at))


def drawn(
    system: TransitionSystem,
    before: Mapping[str, int],
    inputs: Mapping[str, int],
    free: Collection[str],
    random: Random,
    keep: float = KEPT,
) -> dict[str, int] | None:
    """Inputs of a tick: those that are free drawn at random, then changed until all that is assumed is true.

    None if that was not found; what is not free stays as it is.  A free input keeps its value with
    probability ``keep``.
    """
    known = {v.name: v for v in system.inputs if v.name in free}
    now = {**inputs}
    for name, var in known.items():
        if random.random() >= keep:
            now[name] = random.choice(var.domain.values)
    conditions = [(one.formula, set(variables(one.formula))) for one in assumed(system)]
    for _ in range(TRIES):
        at = {**before, **now}
        wrong = [(f, names) for f, names in conditions if not evaluate(f, at)]
        if not wrong:
            return now
        formula, names = random.choice(wrong)
        movable = sorted(names & known.keys())
        if not movable:
            return None
        now |= _mended(formula, [known[n] for n in movable], at, [f for f, _ in conditions], random)
    return None


def _mended(
    formula: Expr, movable: Sequence[Var], at: Mapping[str, int], all_of: Sequence[Expr], random: Random
) -> dict[str, int]:
    """One input changed so that the formula is true and few others are false; if none does, all drawn."""
    options = [
        (var.name, raw)
        for var in movable
        for raw in _candidates(var, random)
        if evaluate(formula, {**at, var.name: raw})
    ]
    if not options:
        return {var.name: random.choice(var.domain.values) for var in movable}
    random.shuffle(options)
    best = min(options[:64], key=lambda o: sum(not evaluate(f, {**at, o[0]: o[1]}) for f in all_of))
    return dict([best])


def _candidates(var: Var, random: Random) -> Sequence[int]:
    values = var.domain.values
    return values if len(values) <= MOST_VALUES else random.sample(values, MOST_VALUES)
