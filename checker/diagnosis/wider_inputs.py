"""Domains of changed charts: what enters them takes values on each side of their limits, too.

The environment of a system measures a few values beside every limit that the document names, and counts an
age up to where no limit of the document lies beyond.  A chart with another limit needs others, or a verdict
on it would be about values that never come.
"""

from collections.abc import Collection, Container, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import ceil, lcm

from rovercheck.checker.mutate.rewrites import numbers_in
from rovercheck.checker.system.intervals import Interval, intervals
from rovercheck.spec_model.lang.action import Action, Assign, If, kept
from rovercheck.spec_model.lang.chart import Block, Chart, parts
from rovercheck.spec_model.lang.domain import Domain, Num
from rovercheck.spec_model.lang.edit import everywhere, in_system
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Temporal, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.redeclare import Redeclarer
from rovercheck.spec_model.lang.system import Note, System
from rovercheck.spec_model.lang.walk import nodes, structure, variables

TWICE = 2
"""An age whose end is moved is judged once more; one that is still not decided there never is."""
NEAR = 2
"""Beside a limit a measured number takes a value half way to the next of its steps, or nearer."""


@dataclass(frozen=True)
class Limit:
    """A number with which a formula of a chart is compared, both in one resolution."""

    left: Expr
    right: Const

    @property
    def key(self) -> object:
        return structure(self.left), self.value

    @property
    def value(self) -> Fraction:
        assert isinstance(self.right.sort, Num)
        return self.right.value * self.right.sort.resolution

    @property
    def variables(self) -> dict[str, Var]:
        """The numbers that are compared with it, by name."""
        return {n: v for n, v in variables(self.left).items() if isinstance(v.sort, Num)}


def widened(changed: System, drawn: System, measured: Container[str] = ()) -> System:
    """The changed system with domains that are wide enough for the limits that were not there as drawn.

    ``measured`` are the names of numbers of which firmware may hold any, not only those of their domains; a
    domain with gaps is always such a choice.  What is compared with a new limit in steps, and may lie between
    them, is said in a note.  Raises ``ModelError`` where an age stops before a new limit decides, and cannot
    be counted further.
    """
    old = {part.name: part for part in parts(drawn.components)}
    before = {limit.key for part in old.values() for limit in _limits(part)}
    new = [
        limit
        for part in parts(changed.components)
        if part is not old.get(part.name)
        for limit in _limits(part)
        if limit.key not in before
    ]
    if not new:
        return changed
    stepped = [limit for limit in new if not _is_measured(limit, measured) and not _is_exact(limit, changed)]
    made = _counted_further(changed, new)
    made = _with_values_beside(made, [limit for limit in new if _is_measured(limit, measured)])
    return replace(made, notes=(*made.notes, *dict.fromkeys(map(_note, stepped))))


def _limits(part: Chart | Block) -> Iterator[Limit]:
    for _, node, _, limit in numbers_in(part):
        if limit is None or node is not limit:
            continue
        left, right = limit.args
        if isinstance(left, Const):
            left, right = right, left
        if isinstance(right, Const) and not any(isinstance(n, Temporal) for n in nodes(left)):
            yield Limit(left, right)


def _is_measured(limit: Limit, measured: Container[str]) -> bool:
    """Whether it is the limit of one number that is measured."""
    found = limit.variables
    return len(found) == 1 and all(name in measured or not v.domain.dense for name, v in found.items())


def _is_exact(limit: Limit, system: System) -> bool:
    """Whether nothing that is compared with the limit lies between the values of its domain."""
    return all(
        (isinstance(v.sort, Num) and v.sort.resolution == 1) or _stops(system, v)
        for v in limit.variables.values()
    )


def _note(limit: Limit) -> Note:
    names = ", ".join(limit.variables)
    return Note(
        f"{limit.left} is compared with {limit.right}, and only steps of it are tried.",
        brief=f"{names} in steps",
    )


# --- values beside a limit ------------------------------------------------------------------------


def _with_values_beside(system: System, limits: Sequence[Limit]) -> System:
    met: dict[Domain, set[Fraction]] = {}
    for limit in limits:
        [var] = limit.variables.values()
        met.setdefault(var.domain, set()).update(_solutions(limit, var))
    finer = {domain: _finer(domain, at) for domain, at in met.items()}
    anew = [_in_finer_steps(v, finer[v.domain]) for v in _all(system) if v.domain in finer]
    return _declared(system, anew)


def _finer(domain: Domain, at: Collection[Fraction]) -> Domain:
    """A domain with the values ``at``, raw, and one on each side of them, nearer than the next of its own.

    Beyond the ends of a range, such as 0 to 100 %, nothing is measured.
    """
    assert isinstance(domain.sort, Num)
    inside = [value for value in at if not domain.dense or domain.low <= value <= domain.high]
    if not inside:
        return domain
    factor = NEAR * lcm(*(value.denominator for value in inside))
    beside = {int(value * factor) + there for value in inside for there in (-1, 0, 1)}
    if domain.dense:
        beside = {raw for raw in beside if domain.low * factor <= raw <= domain.high * factor}
    sort = Num(domain.sort.resolution / factor, domain.sort.unit)
    return Domain(sort, (*(raw * factor for raw in domain.values), *beside))


def _in_finer_steps(var: Var, domain: Domain) -> Var:
    assert isinstance(var.sort, Num) and isinstance(domain.sort, Num)
    factor = var.sort.resolution / domain.sort.resolution
    return replace(var, domain=domain, init=int(var.init * factor))


def _solutions(limit: Limit, var: Var) -> Iterator[Fraction]:
    """Where a formula of one variable, which is linear on either side of 0, meets the limit; raw."""
    for start, step in ((max(var.domain.high, 2), -1), (min(var.domain.low, -2), 1)):
        first, second = (evaluate(limit.left, {var.name: at}) for at in (start, start + step))
        if first != second:
            yield start + Fraction(limit.right.value - first, second - first) * step


def _all(system: System) -> list[Var]:
    return list({**system.inputs, **system.written, **{v.name: v for v in system.frozen}}.values())


def _declared(system: System, anew: Sequence[Var]) -> System:
    return Redeclarer(anew).system(system) if anew else system


# --- ages that are counted further ---------------------------------------------------------------


def _counted_further(system: System, limits: Sequence[Limit]) -> System:
    for limit in limits:
        for name in limit.variables:
            for _ in range(TWICE):
                var = {v.name: v for v in _all(system)}.get(name)
                short = 0 if var is None else _short(limit, var, system)
                if var is None or not short:
                    break
                system = _longer(system, var, short)
            else:
                if _short(limit, {v.name: v for v in _all(system)}[name], system):
                    raise _too_short(limit, name, system)
    return system


def _short(limit: Limit, var: Var, system: System) -> int:
    """How much further an age has to be counted for a limit to be decided where it stops; 0 where it is."""
    if not (var.domain.dense and isinstance(var.sort, Num)) or not _stops(system, var):
        return 0
    ends, earlier = (_at(limit, var, var.domain.high - back) for back in (0, 1))
    for there, before in ((ends.low, earlier.low), (ends.high, earlier.high)):  # in every case, or in some
        if there > before:
            return max(0, (limit.right.value - there) // (there - before) + 1)
    for there, before in ((ends.high, earlier.high), (ends.low, earlier.low)):
        if there < before:
            return max(0, (there - limit.right.value) // (before - there) + 1)
    return 0


def _at(limit: Limit, var: Var, raw: int) -> Interval:
    """What the left side can be while one variable has one value."""

    def fixed(node: Expr) -> Expr:
        return Const(raw, var.sort) if isinstance(node, Var) and node.name == var.name else node

    formula = everywhere(limit.left, fixed)
    return intervals(formula)[id(formula)]


def _stops(system: System, var: Var) -> bool:
    """Whether a block counts the variable up to an end."""
    return any(_clamps(block.do, var.name) for block in system.blocks if var.name in block.written)


def _clamps(actions: Sequence[Action], name: str) -> bool:
    for action in actions:
        if isinstance(action, If):
            if _clamps((*action.then, *action.otherwise), name):
                return True
        elif (
            isinstance(action, Assign)
            and action.var.name == name
            and any(_is_end(n, name) for n in nodes(action.value))
        ):
            return True
    return False


def _is_end(node: Expr, name: str) -> bool:
    match node:
        case Apply(Op.MIN, (counted, Const())):
            return name in variables(counted)
    return False


def _longer(system: System, var: Var, more: int) -> System:
    """The system with an age that stops so much later."""
    domain = Domain(var.sort, range(var.domain.low, var.domain.high + more + 1))

    def later(node: Expr) -> Expr:
        if isinstance(node, Apply) and _is_end(node, var.name):
            counted, end = node.args
            assert isinstance(end, Const) and isinstance(end.sort, Num) and isinstance(var.sort, Num)
            raw = end.value + more * var.sort.resolution / end.sort.resolution
            return Apply(Op.MIN, (counted, Const(ceil(raw), end.sort)), node.sort)
        return node

    def moved(action: Action) -> Action:
        if isinstance(action, If):
            then, otherwise = tuple(map(moved, action.then)), tuple(map(moved, action.otherwise))
            return kept(action, If(action.condition, then, otherwise))
        if not isinstance(action, Assign) or action.var.name != var.name:
            return action
        return kept(action, Assign(action.var, everywhere(action.value, later)))

    def block(part: Chart | Block) -> Chart | Block:
        assert isinstance(part, Block)
        return Block(part.name, tuple(map(moved, part.do)), text=part.text, place=part.place)

    for one in system.blocks:
        if var.name in one.written:
            system = in_system(system, one.name, block)
    return _declared(system, [replace(var, domain=domain)])


def _too_short(limit: Limit, name: str, system: System) -> ModelError:
    return ModelError(
        f"{system.name} counts {name} only up to where the limits of the document are decided, and "
        f"{limit.left} is compared with {limit.right} now."
    )
