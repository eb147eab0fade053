"""What a chart does in its first step as in any other, written once."""

from collections.abc import Sequence

from rovercheck.spec_model.lang.action import Action, Assign, If, Send
from rovercheck.spec_model.lang.system import Statement
from rovercheck.spec_model.lang.walk import Shapes


def written_once(choice: If, flag: str) -> list[Statement]:
    """A choice of which the sides begin or end alike, with that before and after it.

    ``flag`` is the variable that it asks for, which the second side sets: what is written before the choice
    has nothing to do with it.
    """
    shapes, then, otherwise = Shapes(), _statements(choice.then), _statements(choice.otherwise)
    after: list[Statement] = []
    while then and otherwise and _alike(shapes, then[-1], otherwise[-1]):
        after.insert(0, then.pop())
        otherwise.pop()
    before: list[Statement] = []
    at = next((n for n, one in enumerate(otherwise) if not _sets(one, flag)), 0)
    while then and at < len(otherwise) and _alike(shapes, then[0], otherwise[at]) and _apart(then[0], flag):
        before.append(then.pop(0))
        del otherwise[at]
    rest = [If(choice.condition, tuple(then), tuple(otherwise))] if then or otherwise else []
    return [*before, *rest, *after]


def _statements(actions: Sequence[Action]) -> list[Statement]:
    """The actions of a program, in which no event is sent."""
    return [one for one in actions if not isinstance(one, Send)]


def _sets(one: object, flag: str) -> bool:
    return isinstance(one, Assign) and one.var.name == flag


def _apart(one: Statement, flag: str) -> bool:
    return flag not in one.read_inside and flag not in one.written


def _alike(shapes: Shapes, one: object, other: object) -> bool:
    match one, other:
        case Assign(), Assign():
            return one.var.name == other.var.name and shapes(one.value) == shapes(other.value)
        case If(), If():
            return (
                shapes(one.condition) == shapes(other.condition)
                and _all_alike(shapes, one.then, other.then)
                and _all_alike(shapes, one.otherwise, other.otherwise)
            )
    return False


def _all_alike(shapes: Shapes, some: Sequence[object], others: Sequence[object]) -> bool:
    return len(some) == len(others) and all(map(lambda a, b: _alike(shapes, a, b), some, others))


__all__ = ["written_once"]
