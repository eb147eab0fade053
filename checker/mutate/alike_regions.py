"""Two regions of a chart that are alike but for numbers and data, and which of their data belong together."""

from collections.abc import Iterator, Mapping, Sequence

from rovercheck.spec_model.lang.action import Action, Assign, If, each_action
from rovercheck.spec_model.lang.chart import State, Transition
from rovercheck.spec_model.lang.domain import Enum
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Temporal, Var
from rovercheck.spec_model.lang.operators import Op


def written_alike(first: State, second: State) -> Mapping[str, tuple[Var, Var]]:
    """What both regions write, in pairs by the name in the first; nothing where they are not alike."""
    if any(s.parallel or not s.states or _own(s) for s in (first, second)):
        return {}
    one, two = list(_content(first)), list(_content(second))
    if [_shape(t) for t in one] != [_shape(t) for t in two]:
        return {}
    pairs: dict[str, tuple[Var, Var]] = {}
    written = [{v.name for v in _assigned(state)} for state in (first, second)]
    for here, there in zip(one, two, strict=True):
        if isinstance(here, Var) and isinstance(there, Var):
            own = here.name in written[0]
            if (
                own != (there.name in written[1])
                or pairs.setdefault(here.name, (here, there))[1].name != there.name
            ):
                return {}
    found = {name: pair for name, pair in pairs.items() if name in written[0]}
    return found if all(_one_memory(here, there) for here, there in found.values()) else {}


def _one_memory(one: Var, two: Var) -> bool:
    """Whether two data may be in one memory: members of enumerations are the numbers that stand for them."""
    same = one.sort == two.sort or (isinstance(one.sort, Enum) and isinstance(two.sort, Enum))
    return one.name != two.name and same and one.domain.values == two.domain.values


def _own(state: State) -> bool:
    """Whether a region has actions or transitions of its own."""
    return bool(state.entry or state.during or state.exit or state.transitions)


def actions_of(state: State) -> Iterator[Action]:
    """The actions of a state and of the transitions from it and in it."""
    yield from (*state.entry, *state.during, *state.exit)
    for segment in _segments(state):
        yield from (*segment.do, *segment.then)


def _segments(state: State) -> Iterator[Transition]:
    yield from (*state.transitions, *state.default, *(t for j in state.junctions for t in j.transitions))


def _assigned(region: State) -> Iterator[Var]:
    for _, state in region.walk():
        for action in each_action(list(actions_of(state))):
            if isinstance(action, Assign):
                yield action.var


def _content(region: State) -> Iterator[object]:
    """What is drawn in a region, in one order: words, and what its formulas are made of."""
    for path, state in region.walk():
        yield path
        for kind in ("entry", "during", "exit"):
            yield kind
            yield from _of_actions(getattr(state, kind))
        for segment in _segments(state):
            yield segment.event, segment.target
            yield from () if segment.guard is None else _of_formula(segment.guard)
            for actions in (segment.do, segment.then):
                yield "then"
                yield from _of_actions(actions)


def _of_actions(actions: Sequence[Action]) -> Iterator[object]:
    for action in actions:
        match action:
            case Assign(var, value):
                yield ":="
                yield var
                yield from _of_formula(value)
            case If(condition, then, otherwise):
                yield "if"
                yield from _of_formula(condition)
                yield from _of_actions(then)
                yield "else"
                yield from _of_actions(otherwise)
                yield "end"


def _of_formula(formula: Expr) -> Iterator[Expr]:
    """The nodes of a formula, without factors: of units, and of numbers that differ."""
    match formula:
        case Apply(Op.MUL | Op.SCALE, (Const(), other)) | Apply(Op.MUL | Op.SCALE, (other, Const())):
            yield from _of_formula(other)
        case Apply(_, args):
            yield formula
            for one in args:
                yield from _of_formula(one)
        case Temporal(_, Expr() as inner):
            yield formula
            yield from _of_formula(inner)
        case Named(_, body):
            yield from _of_formula(body)
        case _:
            yield formula


def _shape(token: object) -> object:
    """What two tokens have in common: numbers and data may be others."""
    match token:
        case Var():
            return Var
        case Const():
            return Const
        case Apply():
            return token.op, len(token.args)
        case Expr():
            return type(token), getattr(token, "when", None)
    return token


__all__ = ["actions_of", "written_alike"]
