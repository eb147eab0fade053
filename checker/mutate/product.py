"""Two systems side by side on the same inputs: what no fault reaches is there once, what it reaches twice.

The goal of the product is that something observable differs after a tick, or that the inputs of a tick are
allowed for one system only.  A smaller question comes before it: does the fault ever compute anything else?
"""

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

from rovercheck.checker.system.slice import names
from rovercheck.spec_model.lang.action import Action, Assign, If, each_action, writes
from rovercheck.spec_model.lang.domain import Bool, boolean
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Temporal, Var, any_of
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import Program, Statement, TransitionSystem
from rovercheck.spec_model.lang.walk import structure

DISTINGUISHED, REFUSED, COMPUTED = "distinguished", "refused by one", "computed otherwise"


@dataclass(frozen=True)
class Product:
    """The product, its goal, and the observable variables that may differ at all, by name."""

    system: TransitionSystem
    goal: Var
    observed: tuple[str, ...]


def same(original: TransitionSystem, mutant: TransitionSystem) -> bool:
    """Whether two systems are written alike, so that nothing can tell them apart."""
    return (
        _key(original.step) == _key(mutant.step)
        and structure(original.assume) == structure(mutant.assume)
        and described(original.variables) == described(mutant.variables)
    )


def product(
    original: TransitionSystem, mutant: TransitionSystem, observable: Collection[str]
) -> Product | None:
    """The product; None if the fault reaches neither an observable variable nor the assumption."""
    start, end = _ends(original.step, mutant.step)
    middle = original.step[start : len(original.step) - end], mutant.step[start : len(mutant.step) - end]
    around = (*original.step[:start], *original.step[len(original.step) - end :])
    reached = _reached(original, mutant, middle, around)
    observed = tuple(n for n in sorted(observable) if n in reached)
    refused = bool(names([original.assume]) & reached) or structure(original.assume) != structure(
        mutant.assume
    )
    if not observed and not refused:
        return None
    twin = _Twin(original, mutant, reached)
    step: list[Statement] = []
    one, other = original.assume, twin.formula(mutant.assume)
    goal = Var(twin.free(DISTINGUISHED), boolean, 0, "the mutant and the original are distinguished")
    unlike: list[Expr] = []
    if refused:
        refusing = Var(
            twin.free(REFUSED), boolean, 0, "one of the two does not allow the inputs", hidden=True
        )
        step.append(Assign(refusing, _different(one, other)))
        unlike.append(refusing)
    step += twin.both(original.step[:start])
    step += [*middle[0], *twin.program(middle[1])]
    step += twin.both(original.step[len(original.step) - end :])
    unlike += [_different(original.var(n), twin.renamed[n]) for n in observed]
    step.append(Assign(goal, any_of(*unlike)))
    temps = [*original.temps, *(twin.renamed[v.name] for v in mutant.temps if v.name in reached)]
    more = [twin.renamed[v.name] for v in mutant.variables if v.name in reached]
    checks = [*original.checks, *((twin.renamed[c.name], t) for c, t in mutant.checks if c.name in reached)]
    made = TransitionSystem(
        f"{original.name} beside a mutant",
        _union(original.inputs, mutant.inputs),
        original.frozen,
        (*original.variables, *more, goal),
        (*temps, *([refusing] if refused else [])),
        tuple(step),
        any_of(one, other) if refused else one,
        tuple(checks),
        original.tick_ms,
    )
    return Product(made, goal, observed)


def at_the_fault(original: TransitionSystem, mutant: TransitionSystem) -> Product | None:
    """The original with the faulty statements executed beside its own, on the same values, in every tick.

    The goal is that they ever write anything else.  If they never do, the two systems do the same for ever.
    None if the fault is not in the step alone.
    """
    if described(original.variables) != described(mutant.variables):
        return None
    if structure(original.assume) != structure(mutant.assume):
        return None
    start, end = _ends(original.step, mutant.step)
    before, after = original.step[:start], original.step[len(original.step) - end :]
    ours, theirs = (
        original.step[start : len(original.step) - end],
        mutant.step[start : len(mutant.step) - end],
    )
    written = writes(ours) | writes(theirs)
    twin = _Twin(original, mutant, set(written))
    kept = {v.name for v in original.variables} | writes(before).keys()
    temps = {v.name for v in original.temps}
    if not written.keys() <= twin.renamed.keys() & (kept | temps):
        return None
    blank = [Assign(v, Const(v.init, v.sort)) for n, v in written.items() if n not in kept]
    copied = [Assign(twin.renamed[n], v) for n, v in written.items()]
    goal = Var(twin.free(COMPUTED), boolean, 0, "the fault computes something else")
    found = Assign(goal, any_of(*(_different(v, twin.renamed[n]) for n, v in written.items())))
    made = TransitionSystem(
        f"{original.name} beside a fault",
        _union(original.inputs, mutant.inputs),
        original.frozen,
        (*original.variables, goal),
        (*original.temps, *twin.renamed.values()),
        (*before, *blank, *copied, *twin.program(theirs), *ours, found, *after),
        original.assume,
        original.checks,
        original.tick_ms,
    )
    return Product(made, goal, tuple(written))


def _union(one: Sequence[Var], other: Sequence[Var]) -> tuple[Var, ...]:
    return tuple({v.name: v for v in (*other, *one)}.values())


def _different(one: Expr, other: Expr) -> Expr:
    return Apply(Op.NE, (one, other), Bool())


def _ends(one: Program, other: Program) -> tuple[int, int]:
    """How many statements the two have in common at the start, and at the end."""
    ours, theirs = [_key([s]) for s in one], [_key([s]) for s in other]
    most = min(len(ours), len(theirs))
    start = next((i for i in range(most) if ours[i] != theirs[i]), most)
    rest = most - start
    end = next((i for i in range(rest) if ours[-1 - i] != theirs[-1 - i]), rest)
    return start, end


def _key(program: Iterable[Action]) -> tuple[object, ...]:
    """Equal for two programs iff they are written alike."""
    return tuple(
        (s.var.name, structure(s.value))
        if isinstance(s, Assign)
        else (structure(s.condition), _key(s.then), _key(s.otherwise))
        if isinstance(s, If)
        else s
        for s in program
    )


def described(variables: Sequence[Var]) -> dict[str, tuple[object, int]]:
    """Domain and initial value of each variable, by name."""
    return {v.name: (v.domain, v.init) for v in variables}


def _reached(
    original: TransitionSystem,
    mutant: TransitionSystem,
    middle: tuple[Program, Program],
    around: Program,
) -> set[str]:
    """The names of all that may have another value in the mutant.

    A statement around the fault that reads such a thing, or writes one, is there twice, and so is all that it
    writes.
    """
    here = described((*original.variables, *original.temps))
    there = described((*mutant.variables, *mutant.temps))
    found = {n for n in here.keys() | there.keys() if here.get(n) != there.get(n)}
    found |= writes(middle[0]).keys() | writes(middle[1]).keys()
    known = [(_read([s]), set(writes([s]))) for s in around]
    while True:
        more = {n for read, written in known if (read | written) & found for n in written}
        if more <= found:
            return found
        found |= more


def _read(program: Iterable[Action]) -> set[str]:
    found: set[str] = set()
    for action in each_action(tuple(program)):
        if isinstance(action, Assign):
            found |= names([action.value])
        elif isinstance(action, If):
            found |= names([action.condition])
    return found


class _Twin:
    """The copies that the mutant has of what the fault reaches."""

    def __init__(self, original: TransitionSystem, mutant: TransitionSystem, reached: set[str]) -> None:
        kinds = (*original.variables, *original.temps, *original.inputs, *original.frozen, *mutant.inputs)
        self._taken = {v.name for v in (*kinds, *mutant.variables, *mutant.temps)}
        self.reached = reached
        self._copies: dict[int, tuple[Expr, Expr]] = {}
        self.renamed = {
            v.name: Var(self.free(f"mutant's {v.name}"), v.domain, v.init, v.doc, v.hidden)
            for v in (*mutant.variables, *mutant.temps)
            if v.name in reached
        }

    def free(self, name: str) -> str:
        """The name, with something behind it if it is taken."""
        while name in self._taken:
            name += "'"
        self._taken.add(name)
        return name

    def both(self, program: Program) -> list[Statement]:
        """Statements that both systems have, twice where the fault reaches them."""
        out: list[Statement] = []
        for statement in program:
            out.append(statement)
            if writes([statement]).keys() & self.reached:
                out += self.program([statement])
        return out

    def program(self, program: Sequence[Statement]) -> list[Statement]:
        """The copies of statements."""
        return [self._statement(s) for s in program]

    def _statement(self, statement: Action) -> Statement:
        if isinstance(statement, Assign):
            return Assign(self.renamed[statement.var.name], self.formula(statement.value))
        assert isinstance(statement, If), "a step holds no sends"
        then = tuple(self._statement(s) for s in statement.then)
        return If(self.formula(statement.condition), then, tuple(map(self._statement, statement.otherwise)))

    def formula(self, expr: Expr) -> Expr:
        """A formula over the copies; what occurs in several places is copied once."""
        if id(expr) not in self._copies:
            self._copies[id(expr)] = expr, self._copied(expr)
        return self._copies[id(expr)][1]

    def _copied(self, expr: Expr) -> Expr:
        match expr:
            case Var(name):
                return self.renamed.get(name, expr)
            case Apply(op, args, sort):
                return Apply(op, tuple(self.formula(a) for a in args), sort)
            case Named(_, body):
                return self.formula(body)
            case Temporal():
                raise AssertionError("a lowered system has no temporal words")
            case _:
                return expr


__all__ = ["Product", "at_the_fault", "described", "product", "same"]
