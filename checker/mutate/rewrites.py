"""Changes of one part beyond the counted mutants: any other member, bit, target, order, signal; operands
exchanged, parts negated, transitions added.

They are hypotheses about a cause, and many: what counts mutants does not make them.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from itertools import combinations
from operator import is_

from rovercheck.checker.mutate.charts import transition_lists
from rovercheck.checker.mutate.formulas import TIMED
from rovercheck.checker.mutate.places import FormulaPlace, formula_places, nodes_in
from rovercheck.spec_model.lang.chart import Block, Chart, Path
from rovercheck.spec_model.lang.domain import Bool, Enum, Num
from rovercheck.spec_model.lang.edit import everywhere, in_block, in_expressions
from rovercheck.spec_model.lang.expr import TRUE, Apply, Const, Expr, Named, Temporal, Var
from rovercheck.spec_model.lang.operators import COMPARISONS, Op
from rovercheck.spec_model.lang.time import Span
from rovercheck.spec_model.lang.transition import to
from rovercheck.spec_model.lang.walk import nodes, structure

BITS = 8


@dataclass(frozen=True)
class Rewrite:
    """A part changed in one respect: of what kind, where, what stood there and what stands there."""

    kind: str
    site: str
    old: str
    new: str
    make: Callable[[], Chart | Block]

    @property
    def part(self) -> Chart | Block:
        """The part as it is changed."""
        return self.make()


def rewrites(part: Chart | Block, others: Mapping[str, Var]) -> Iterator[Rewrite]:
    """Changes of a part, the nearer ones first; ``others``: signals that it might read by mistake."""
    places = list(formula_places(part))
    for place in places:
        yield from _of_formula(place)
    if isinstance(part, Chart):
        yield from _targets(part)
        yield from _orders(part)
        yield from _at_entry(part)
    yield from _signals(part, places, others)
    yield from _exchanged(part, others)
    yield from _exchanged_members(part, places)
    yield from _exchanged_bits(part, places)


def timer_rewrites(part: Chart | Block, step_ms: int, steps: Sequence[int]) -> Iterator[Rewrite]:
    """Each timer with other numbers of steps, alone and together with those of the same formula."""
    places = list(formula_places(part))
    found: dict[object, list[Temporal]] = {}
    for place in places:
        for node, put in nodes_in(place.formula):
            if not (isinstance(node, Temporal) and node.when in TIMED and node.span is not None):
                continue
            found.setdefault((node.when, node.span, structure(node)), []).append(node)
            for new in _spans(node, step_ms, steps):
                yield Rewrite("timer", place.site, str(node), str(new), partial(_put, place, put, new))
    for same in found.values():
        if len(same) > 1:
            for new in _spans(same[0], step_ms, steps):
                changed = partial(everywhere_in, part, same[0], new)
                yield Rewrite("timer", "everywhere", str(same[0]), str(new), changed)


def _spans(node: Temporal, step_ms: int, steps: Sequence[int]) -> Iterator[Temporal]:
    assert node.span is not None
    unit = Fraction(1 if node.span.unit == "ticks" else step_ms)
    now = node.span.amount / unit
    for count in sorted({int(now) + d for d in (-2, -1, 1, 2)} | set(steps), key=lambda n: (abs(n - now), n)):
        if count >= 0 and count != now:
            yield replace(node, span=Span(count * unit, node.span.unit))


def _put(place: FormulaPlace, put: Callable[[Expr], Expr], new: Expr) -> Chart | Block:
    return place.put(put(new))


def everywhere_in(part: Chart | Block, old: Expr, new: Expr) -> Chart | Block:
    """The part with every formula that is built like ``old`` replaced."""
    return mapped(part, lambda node: new if same_shape(node, old) else node)


def same_shape(one: Expr, two: Expr) -> bool:
    """Whether two formulas are built alike."""
    return type(one) is type(two) and structure(one) == structure(two)


def mapped(part: Chart | Block, change: Callable[[Expr], Expr]) -> Chart | Block:
    """The part with every node of its formulas changed, innermost first."""

    def walk(expr: Expr) -> Expr:
        return everywhere(expr, change)

    return in_block(part, walk) if isinstance(part, Block) else in_expressions(part, walk)


def _of_formula(place: FormulaPlace) -> Iterator[Rewrite]:
    for node, put in nodes_in(place.formula):
        for kind, new in _of_node(node, node is place.formula):
            yield Rewrite(kind, place.site, str(node), str(new), partial(_put, place, put, new))


def _of_node(node: Expr, whole: bool) -> Iterator[tuple[str, Expr]]:
    match node:
        case Apply(Op.BIT, (mask, Const(index, sort))):
            for other in range(BITS):
                if other not in (index, index + 1):  # the next one is a counted mutant
                    yield "bit", replace(node, args=(mask, Const(other, sort)))
        case Apply(Op.SUB, (left, right)):
            yield "operands", replace(node, args=(right, left))
        case Apply(op, (left, right)) if op in COMPARISONS and op not in (Op.EQ, Op.NE):
            if not (isinstance(left, Const) or isinstance(right, Const)):
                yield "operands", replace(node, args=(right, left))
        case Apply(Op.AND | Op.OR, (_, _, _, *_) as conditions):
            yield from (("only", condition) for condition in conditions)
        case Apply(Op.EQ, (Expr() as left, Const(value, Enum(_, members) as sort))):
            for _, number in members:
                if number != value:
                    also = Apply(Op.EQ, (left, Const(number, sort)), Bool())
                    yield "also", Apply(Op.OR, (node, also), Bool())
        case Const(value, Enum(_, members) as sort):
            for _, number in members:
                if number != value:
                    yield "member", Const(number, sort)
        case _:
            pass
    if isinstance(node.sort, Bool) and not whole and not isinstance(node, Const):
        yield "negated", Apply(Op.NOT, (node,), Bool())


def _signals(
    part: Chart | Block, places: Sequence[FormulaPlace], others: Mapping[str, Var]
) -> Iterator[Rewrite]:
    """Another signal of the same kind read in one place."""
    for place in places:
        for node, put in nodes_in(place.formula):
            if isinstance(node, Var):
                for other in _alike(node, others):
                    yield Rewrite(
                        "signal", place.site, node.name, other.name, partial(_put, place, put, other)
                    )


def _alike(var: Var, others: Mapping[str, Var]) -> Iterator[Var]:
    for other in others.values():
        if other.name != var.name and other.sort == var.sort:
            yield other


def _exchanged(part: Chart | Block, others: Mapping[str, Var]) -> Iterator[Rewrite]:
    """A signal read in place of another wherever it is read; two of them exchanged."""
    for name, var in part.read.items():
        if name in part.written:
            continue
        for other in _alike(var, others):
            if other.name in part.read and other.name < name:
                continue
            swap = {name: other, other.name: var}
            yield Rewrite("exchanged", "everywhere", name, other.name, partial(renamed, part, swap))


def _exchanged_members(part: Chart | Block, places: Sequence[FormulaPlace]) -> Iterator[Rewrite]:
    """Two members of an enumeration in each other's place wherever they are compared, or assigned."""
    found: dict[str, dict[tuple[object, object], Const]] = {COMPARED: {}, ASSIGNED: {}}
    for place in places:
        nodes = [node for node, _ in nodes_in(place.formula)]
        compared = {id(a) for n in nodes if isinstance(n, Apply) and n.op in COMPARISONS for a in n.args}
        for node in nodes:
            if isinstance(node, Const) and isinstance(node.sort, Enum):
                where = COMPARED if id(node) in compared else ASSIGNED
                found[where].setdefault((node.value, node.sort), node)
    for where, change in ((COMPARED, _compared), (ASSIGNED, _assigned)):
        for one, two in combinations(found[where].values(), 2):
            if one.sort == two.sort:
                swap = {one.value: two, two.value: one}
                yield Rewrite(
                    "members", where, str(one), str(two), partial(mapped, part, partial(change, swap))
                )


def _exchanged_bits(part: Chart | Block, places: Sequence[FormulaPlace]) -> Iterator[Rewrite]:
    """Two bits in each other's place in all masks that are put together of conditions."""
    nodes = [node for place in places for node, _ in nodes_in(place.formula)]
    bits = sorted({bit for node in nodes if (bit := _bit(node)) is not None})
    for one, two in combinations(bits, 2):
        changed = partial(mapped, part, partial(_other_bit, {one: two, two: one}))
        yield Rewrite("bits", "everywhere", f"bit {one}", f"bit {two}", changed)


def _bit(node: Expr) -> int | None:
    """The bit of a mask that a condition sets: of ``q ? 4 : 0`` it is 2."""
    match node:
        case Apply(Op.ITE, (_, Const(weight, Num()), Const(0, _))) if weight > 0 and not weight & (
            weight - 1
        ):
            return weight.bit_length() - 1
    return None


def _other_bit(swap: Mapping[int, int], node: Expr) -> Expr:
    bit = _bit(node)
    if bit is None or bit not in swap or not isinstance(node, Apply):
        return node
    condition, weight, nothing = node.args
    return replace(node, args=(condition, Const(1 << swap[bit], weight.sort), nothing))


COMPARED, ASSIGNED = "where compared", "where assigned"


def _compared(swap: Mapping[int, Const], node: Expr) -> Expr:
    """A comparison with one of two members as one with the other."""
    if not (isinstance(node, Apply) and node.op in COMPARISONS):
        return node
    return replace(node, args=tuple(_other(swap, arg) for arg in node.args))


def _assigned(swap: Mapping[int, Const], node: Expr) -> Expr:
    """Any of two members as the other; in comparisons, whose operands come first, they are put back."""
    return _other(swap, node) if isinstance(node, Const) else _compared(swap, node)


def _other(swap: Mapping[int, Const], node: Expr) -> Expr:
    if not isinstance(node, Const):
        return node
    other = swap.get(node.value)
    return other if other is not None and other.sort == node.sort else node


def renamed(part: Chart | Block, swap: Mapping[str, Var]) -> Chart | Block:
    """The part with other variables read in place of some; a formula in which any is loses its name."""

    def change(expr: Expr) -> Expr:
        match expr:
            case Var(name):
                return swap.get(name, expr)
            case Apply(op, args, sort):
                new = tuple(map(change, args))
                return expr if all(map(is_, new, args)) else Apply(op, new, sort)
            case Temporal(_, arg, _, _) if arg is not None:
                return expr if (now := change(arg)) is arg else replace(expr, arg=now)
            case Named(_, body):
                return expr if (inner := change(body)) is body else inner
        return expr

    return in_block(part, change) if isinstance(part, Block) else in_expressions(part, change)


# --- transitions ----------------------------------------------------------------------------------------


def _targets(chart: Chart) -> Iterator[Rewrite]:
    """Every other target beside the one that is drawn."""
    for one in transition_lists(chart):
        for number, segment in enumerate(one.segments):
            for target in _reachable(chart, one.level, segment.target):
                new = [replace(s, target=target) if i == number else s for i, s in enumerate(one.segments)]
                yield Rewrite(
                    "target", f"{one.site}.{number + 1}", segment.target, target, partial(one.changed, new)
                )


def _reachable(chart: Chart, level: Path, drawn: str) -> Iterator[str]:
    """States at the level of a transition, as they are written there."""
    inside = chart.states.get(level)
    for state in () if inside is None or inside.parallel else inside.states:
        if state.name != drawn and chart.resolve(level, state.name) == (*level, state.name):
            yield state.name


def _orders(chart: Chart) -> Iterator[Rewrite]:
    """Each transition tested first, or last."""
    for one in transition_lists(chart):
        count = len(one.segments)
        for number, segment in enumerate(one.segments):
            rest = [s for i, s in enumerate(one.segments) if i != number]
            for word, new in (("first", [segment, *rest]), ("last", [*rest, segment])):
                if count > 2 and new != list(one.segments):
                    yield Rewrite(
                        "order", f"{one.site}.{number + 1}", f"transition {number + 1}", word,
                        partial(one.changed, new),
                    )  # fmt: skip


def _at_entry(chart: Chart) -> Iterator[Rewrite]:
    """Transitions of a state that is entered by default tested in that step, all of them or one.

    Not those that wait for a time, which has not passed then.
    """
    lists = list(transition_lists(chart))
    by_site = {one.site: one for one in lists}
    for one in lists:
        for number, segment in enumerate(one.segments if one.default else ()):
            path = ".".join((*one.level, segment.target))
            own = by_site.get(f"arrow/{path}")
            tested = (
                [] if own is None else [(n, s) for n, s in enumerate(own.segments, 1) if not _waits(s.guard)]
            )
            for n, some in ((n, [s]) for n, s in tested):
                new = [*one.segments[:number], *some, *one.segments[number:]]
                yield Rewrite(
                    "entry", f"{one.site}.{number + 1}", path, f"transition {n}", partial(one.changed, new)
                )
            if len(tested) > 1:
                new = [*one.segments[:number], *(s for _, s in tested), *one.segments[number:]]
                yield Rewrite(
                    "entry", f"{one.site}.{number + 1}", path, "every transition", partial(one.changed, new)
                )


def _waits(guard: Expr | None) -> bool:
    return guard is not None and any(isinstance(node, Temporal) for node in nodes(guard))


def extra_transitions(chart: Chart, conditions: Sequence[Expr]) -> Iterator[Rewrite]:
    """Transitions that are not drawn, from each state to each beside it, tested first or last."""
    for one in transition_lists(chart):
        for target in () if one.default else _reachable(chart, one.level, ""):
            if one.site == f"arrow/{'.'.join((*one.level, target))}":
                continue
            for condition in (*conditions, TRUE):
                more = to(target) if condition is TRUE else to(target, when=condition)
                for word in ("first", "last"):
                    new = [more, *one.segments] if word == "first" else [*one.segments, more]
                    yield Rewrite(
                        "extra", one.site, f"no transition to {target}", f"{word}: [{condition}] to {target}",
                        partial(one.changed, new),
                    )  # fmt: skip


Written = tuple[FormulaPlace, Expr, Callable[[Expr], Expr], Apply | None]


def numbers_in(part: Chart | Block) -> Iterator[Written]:
    """Every number that is written in a part, with the comparison that it is the limit of, if it is one.

    The factor of a change of resolution is none: nobody has written it.
    """
    for place in formula_places(part):
        inside: set[int] = set()
        for node, put in nodes_in(place.formula):
            if isinstance(node, Apply) and node.op in COMPARISONS and _is_limit(node):
                inside.add(id(node.args[1]))
                inside.add(id(node.args[0]))
                yield place, node, put, node
            elif isinstance(node, Apply) and node.op is Op.SCALE:
                inside.add(id(node.args[1]))
            elif isinstance(node, Const) and isinstance(node.sort, Num) and id(node) not in inside:
                yield place, node, put, None


def _is_limit(node: Apply) -> bool:
    left, right = node.args
    return isinstance(left.sort, Num) and isinstance(left, Const) != isinstance(right, Const)


__all__ = [
    "Rewrite", "everywhere_in", "extra_transitions", "mapped", "numbers_in", "renamed", "rewrites",
    "same_shape", "timer_rewrites",
]  # fmt: skip
