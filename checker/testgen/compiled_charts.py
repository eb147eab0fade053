"""Charts as one Python function: some ten times as quick as the interpreter, for searching only.

What is found with it counts once the interpreter has run it.
"""

from collections.abc import Callable, Iterator, MutableMapping, Sequence

from rovercheck.checker.encode.python_text import text_of
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.expr import Const, Expr
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.walk import plain

Step = Callable[[MutableMapping[str, int]], None]
"""Runs one tick in place: a state with the inputs of the tick becomes the state after it."""

DEEPEST = 40
"""Python admits a hundred levels of indentation; what lies deeper becomes a function of its own."""


def compiled(system: TransitionSystem) -> Step:
    """The step of a transition system as a function."""
    found: dict[str, Step] = {}
    exec(source(system), found)
    return found["step"]


def source(system: TransitionSystem) -> str:
    """The text of that function."""
    text = _Source()
    text.function("step", system.step)
    return "\n".join(text.lines)


class _Source:
    """Python text of functions over a state ``a``."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self._functions = 0

    def function(self, name: str, program: Sequence[object]) -> None:
        body = list(self._block(program, 1))
        self.lines += [f"def {name}(a):", *(body or [" pass"])]

    def _block(self, program: Sequence[object], depth: int) -> Iterator[str]:
        pad = " " * depth
        for statement in program:
            if isinstance(statement, Assign):
                yield f"{pad}a[{statement.var.name!r}] = {_text(statement.value)}"
            elif isinstance(statement, If):
                yield from self._choice(statement, depth)

    def _choice(self, choice: If, depth: int) -> Iterator[str]:
        pad, test = " " * depth, plain(choice.condition)
        if isinstance(test, Const):
            yield from self._block(choice.then if test.value else choice.otherwise, depth)
        elif depth >= DEEPEST:
            self._functions += 1
            name = f"part{self._functions}"
            self.function(name, [choice])
            yield f"{pad}{name}(a)"
        else:
            yield f"{pad}if {_text(test)}:"
            yield from list(self._block(choice.then, depth + 1)) or [f"{pad} pass"]
            otherwise = list(self._block(choice.otherwise, depth + 1))
            yield from [f"{pad}else:", *otherwise] if otherwise else []


def _text(expr: Expr) -> str:
    return text_of(expr, lambda var: f"a[{var.name!r}]")
