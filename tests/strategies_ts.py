"""Random finite transition systems: small enough for a naive search, rich enough to hurt an engine.

``transition_systems()`` draws programs over booleans, enumerations, dense and sparse numbers
(negative ones too), with inputs, frozen variables, temporaries, an assumption and every operator.
The goals of a system are its boolean variables named ``goal0``, ``goal1`` (see ``goals``).  Values
assigned always fit the domain of their variable.
"""

from collections.abc import Sequence

from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import Bool, Domain, Enum, Num, boolean, chosen, enumeration, integer
from rovercheck.spec_model.lang.expr import TRUE, Apply, Const, Expr, Named, Var, flag
from rovercheck.spec_model.lang.operators import COMPARISONS, Op
from rovercheck.spec_model.lang.system import Program, Statement, TransitionSystem

MODE = enumeration("Mode", {"IDLE": 2, "BUSY": 3, "LOST": 7})
DOMAINS: tuple[Domain, ...] = (
    boolean,
    boolean,
    MODE,
    integer(0, 3),
    integer(-2, 2),
    integer(5, 9),
    chosen([-7, 0, 1, 30]),
    chosen([0, 20, 40, 60]),
)


def goals(system: TransitionSystem) -> tuple[Var, ...]:
    """The goals of a drawn system."""
    return tuple(v for v in system.variables if v.name.startswith("goal"))


def number(value: int) -> Const:
    """A whole constant without unit."""
    return Const(value, Num())


def _pick(variables: Sequence[Var], kind: type) -> list[Var]:
    return [v for v in variables if isinstance(v.sort, kind)]


def integers(draw: DrawFn, scope: Sequence[Var], depth: int) -> Expr:
    """A random whole-number expression over the variables in scope."""
    numbers = _pick(scope, Num)
    if depth <= 0 or draw(st.integers(0, 4)) == 0:
        if bool(numbers) and draw(st.booleans()):
            drawn: Expr = draw(st.sampled_from(numbers))
            return drawn
        return number(draw(st.integers(-4, 9)))
    op = draw(
        st.sampled_from(
            [Op.ADD, Op.SUB, Op.NEG, Op.MUL, Op.SCALE, Op.DIV, Op.MOD, Op.ABS] + [Op.MIN, Op.MAX, Op.ITE]
        )
    )
    first = integers(draw, scope, depth - 1)
    match op:
        case Op.NEG | Op.ABS:
            args: tuple[Expr, ...] = (first,)
        case Op.SCALE | Op.DIV | Op.MOD:
            args = (first, number(draw(st.integers(1, 5))))
        case Op.ITE:
            args = (booleans(draw, scope, depth - 1), first, integers(draw, scope, depth - 1))
        case _:
            args = (first, integers(draw, scope, depth - 1))
    return Apply(op, args, Num())


def booleans(draw: DrawFn, scope: Sequence[Var], depth: int) -> Expr:
    """A random condition over the variables in scope."""
    flags, modes = _pick(scope, Bool), _pick(scope, Enum)
    kind = draw(st.integers(0, 7))
    if depth <= 0 or kind == 0:
        return draw(st.sampled_from(flags)) if flags else Const(draw(st.integers(0, 1)), Bool())
    if kind == 1 and modes:
        member = Const(draw(st.sampled_from(list(MODE.values))), MODE.sort)
        return Apply(draw(st.sampled_from([Op.EQ, Op.NE])), (draw(st.sampled_from(modes)), member), Bool())
    if kind <= 3:
        op = draw(st.sampled_from(sorted(COMPARISONS)))
        return Apply(op, (integers(draw, scope, depth - 1), integers(draw, scope, depth - 1)), Bool())
    if kind == 4:
        mask = Apply(Op.ABS, (integers(draw, scope, depth - 1),), Num())
        return Apply(Op.BIT, (mask, number(draw(st.integers(0, 3)))), Bool())
    parts = tuple(booleans(draw, scope, depth - 1) for _ in range(draw(st.integers(2, 3))))
    if kind == 5:
        return Named("named", Apply(Op.NOT, parts[:1], Bool()))
    if kind == 6:
        op = draw(st.sampled_from([Op.ITE, Op.EQ, Op.NE]))
        return Apply(op, (*parts, parts[0])[:3] if op is Op.ITE else parts[:2], Bool())
    return Apply(draw(st.sampled_from([Op.AND, Op.OR])), parts, Bool())


def fitting(draw: DrawFn, domain: Domain, scope: Sequence[Var], depth: int) -> Expr:
    """A random expression whose value always lies in the domain."""
    if isinstance(domain.sort, Bool):
        return booleans(draw, scope, depth)
    if isinstance(domain.sort, Enum):
        first, second = (Const(draw(st.sampled_from(list(MODE.values))), domain.sort) for _ in range(2))
        return Apply(Op.ITE, (booleans(draw, scope, depth), first, second), domain.sort)
    value = integers(draw, scope, depth)
    if not domain.dense:
        return _nearest(value, domain)
    if draw(st.booleans()):
        clamped = Apply(Op.MAX, (value, number(domain.low)), Num())
        return Apply(Op.MIN, (clamped, number(domain.high)), Num())
    offset = Apply(Op.SUB, (value, number(domain.low)), Num())
    return Apply(Op.ADD, (Apply(Op.MOD, (offset, number(len(domain))), Num()), number(domain.low)), Num())


def _nearest(value: Expr, domain: Domain) -> Expr:
    """The lowest member of a sparse domain that is not below the value, or its highest member."""
    result: Expr = number(domain.high)
    for raw in reversed(domain.values):
        result = Apply(Op.ITE, (Apply(Op.LE, (value, number(raw)), Bool()), number(raw), result), Num())
    return result


def programs(
    draw: DrawFn, targets: Sequence[Var], scope: Sequence[Var], size: int, nested: int = 2
) -> Program:
    """A random program of at most ``size`` statements that assigns to the targets."""
    statements: list[Statement] = []
    for _ in range(draw(st.integers(0, size))):
        if nested and draw(st.integers(0, 2)) == 0:
            then = programs(draw, targets, scope, 2, nested - 1)
            otherwise = programs(draw, targets, scope, 2, nested - 1)
            statements.append(If(booleans(draw, scope, 2), then, otherwise))
        else:
            target = draw(st.sampled_from(targets))
            statements.append(Assign(target, fitting(draw, target.domain, scope, 2)))
    return tuple(statements)


def _some(draw: DrawFn, prefix: str, least: int, most: int) -> list[Var]:
    domains = [draw(st.sampled_from(DOMAINS)) for _ in range(draw(st.integers(least, most)))]
    return [
        Var(f"{prefix}{i}", domain, draw(st.sampled_from(list(domain.values))))
        for i, domain in enumerate(domains)
    ]


@st.composite
def transition_systems(draw: DrawFn, most: int = 3) -> TransitionSystem:
    """A random system of at most ``most`` variables and inputs, one frozen variable and two goals."""
    variables, inputs = _some(draw, "x", 1, most), _some(draw, "i", 0, most)
    frozen, temps = _some(draw, "f", 0, 1), _some(draw, "t", 0, 2)
    wanted = [flag(f"goal{i}") for i in range(draw(st.integers(1, 2)))]
    outside = [*variables, *inputs, *frozen]
    setting = tuple(Assign(t, fitting(draw, t.domain, outside, 1)) for t in temps)
    scope = [*outside, *temps]
    body = programs(draw, [*variables, *temps], scope, 4)
    final = tuple(Assign(g, booleans(draw, [*scope, *wanted], 2)) for g in wanted)
    assume = booleans(draw, outside, 2) if inputs and draw(st.integers(0, 2)) == 0 else TRUE
    return TransitionSystem(
        "random",
        tuple(inputs),
        tuple(frozen),
        (*variables, *wanted),
        tuple(temps),
        (*setting, *body, *final),
        assume,
    )
