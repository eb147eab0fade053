"""Every formula of a chart or block with its place, and the part with another formula in it."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from rovercheck.checker.mutate.charts import transition_lists
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.chart import Block, Chart, State
from rovercheck.spec_model.lang.edit import edit_at
from rovercheck.spec_model.lang.expr import Apply, Expr, Named, Temporal

Put = Callable[[Expr], Chart | Block]


@dataclass(frozen=True)
class FormulaPlace:
    """A guard, a condition or an assigned value.

    ``site`` is named as in the ids of mutants; ``put`` makes the part with another formula there.
    """

    site: str
    role: str
    formula: Expr
    put: Put


def formula_places(part: Chart | Block) -> Iterator[FormulaPlace]:
    """Every formula of a part, in the order in which it is drawn."""
    if isinstance(part, Block):
        yield from _in_actions("block", part.do, lambda new: _block(part, new))
        return
    for one in transition_lists(part):
        for number, segment in enumerate(one.segments):

            def put(new: object, one=one, number=number) -> Chart:  # type: ignore[no-untyped-def]
                return one.changed([new if i == number else s for i, s in enumerate(one.segments)])  # type: ignore[no-any-return]

            site = f"{one.site}.{number + 1}"
            if segment.guard is not None:
                yield FormulaPlace(
                    site, "guard", segment.guard, lambda e, s=segment, put=put: put(replace(s, guard=e))
                )
            yield from _in_actions(
                site, segment.do, lambda new, s=segment, put=put: put(replace(s, do=new))
            )
            yield from _in_actions(
                site, segment.then, lambda new, s=segment, put=put: put(replace(s, then=new))
            )
    for path, state in part.states.items():
        for kind in ("entry", "during", "exit"):
            actions: tuple[Action, ...] = getattr(state, kind)
            site = f"state/{'.'.join(path)}/{kind}"
            yield from _in_actions(
                site, actions, lambda new, path=path, kind=kind: _state(part, path, kind, new)
            )


def _block(part: Block, new: Sequence[Action]) -> Block:
    return Block(part.name, new, text=part.text, place=part.place)


def _state(chart: Chart, path: tuple[str, ...], kind: str, new: tuple[Action, ...]) -> Chart:
    def changed(state: State) -> State:
        match kind:
            case "entry":
                return replace(state, entry=new)
            case "during":
                return replace(state, during=new)
            case _:
                return replace(state, exit=new)

    return edit_at(chart, path, changed)


def _in_actions(
    site: str, actions: tuple[Action, ...], put: Callable[[tuple[Action, ...]], Chart | Block]
) -> Iterator[FormulaPlace]:
    for number, action in enumerate(actions):

        def one(new: Action, number: int = number) -> Chart | Block:
            return put((*actions[:number], new, *actions[number + 1 :]))

        if isinstance(action, Assign):
            yield FormulaPlace(
                site, action.var.name, action.value, lambda e, a=action, one=one: one(replace(a, value=e))
            )
        elif isinstance(action, If):
            yield FormulaPlace(
                site, "if", action.condition, lambda e, a=action, one=one: one(replace(a, condition=e))
            )
            yield from _in_actions(
                site, action.then, lambda new, a=action, one=one: one(replace(a, then=new))
            )
            yield from _in_actions(
                site, action.otherwise, lambda new, a=action, one=one: one(replace(a, otherwise=new))
            )


def nodes_in(formula: Expr) -> Iterator[tuple[Expr, Callable[[Expr], Expr]]]:
    """Every node with what makes the formula with another node there; parents first."""
    if not isinstance(formula, Named):
        yield formula, lambda new: new
    match formula:
        case Apply(_, args, _):
            for number, arg in enumerate(args):
                for node, put in nodes_in(arg):

                    def within(new: Expr, number: int = number, put: Callable[[Expr], Expr] = put) -> Expr:
                        return replace(formula, args=(*args[:number], put(new), *args[number + 1 :]))

                    yield node, within
        case Named(_, body):
            yield from nodes_in(body)  # what is changed is no longer what the name says
        case Temporal(_, arg, _, _) if arg is not None:
            for node, put in nodes_in(arg):
                yield node, lambda new, put=put: replace(formula, arg=put(new))


__all__ = ["FormulaPlace", "formula_places", "nodes_in"]
