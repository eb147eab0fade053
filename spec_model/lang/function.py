"""Functions of a chart: a formula or actions that are written once and used in several places."""

import inspect
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from rovercheck.spec_model.lang.action import Action, Assign, If, Send, shared_actions
from rovercheck.spec_model.lang.domain import own
from rovercheck.spec_model.lang.errors import ModelError, brief, with_article
from rovercheck.spec_model.lang.expr import Expr, Named, Operand, as_formula, const


@dataclass(frozen=True)
class Function:
    """Made by ``function``: called with formulas, in Python or in a label."""

    name: str
    body: Callable[..., Any]
    parameters: tuple[str, ...]

    @property
    def call(self) -> str:
        """How it is called, with the names of its parameters."""
        return f"{self.name}({', '.join(self.parameters)})"

    def __call__(self, *arguments: Operand) -> Any:
        """A formula named like the call, or the actions.

        Raises ``ModelError`` for a wrong number of arguments, and for what is neither.
        """
        given = [a if isinstance(a, Expr) else const(own(a)) for a in arguments]
        if len(given) != len(self.parameters):
            shown = f"{len(self.parameters)} argument{'' if len(self.parameters) == 1 else 's'}"
            raise ModelError(f"{self.name}() takes {shown}, not {len(given)}; write {self.call}.")
        made = self.body(*given)
        if isinstance(made, Expr):
            return Named(f"{self.name}({', '.join(map(str, given))})", made)
        actions = tuple(made) if isinstance(made, Iterable) and not isinstance(made, str) else (made,)
        wrong = [a for a in actions if not isinstance(a, Assign | If | Send)]
        if wrong or not actions:
            what = f"{brief(wrong[0])}, {with_article(type(wrong[0]).__name__)}" if wrong else "nothing"
            raise ModelError(f"{self.name}() returns {what}; return a formula, or a list of actions.")
        return shared_actions(f"{self.name}({', '.join(map(str, given))})", actions)

    def formula(self, *arguments: Operand) -> Expr:
        """The formula.  Raises ``ModelError`` where the function returns actions."""
        made = self(*arguments)
        if not isinstance(made, Expr):
            raise ModelError(f"{self.name}() does something and has no value; call it as an action.")
        return as_formula(made, self.name)

    def actions(self, *arguments: Operand) -> tuple[Action, ...]:
        """The actions.  Raises ``ModelError`` where the function returns a formula."""
        made = self(*arguments)
        if isinstance(made, Expr):
            raise ModelError(f"{self.name}() has a value and does nothing; use it in a formula.")
        return tuple(made)


def function(body: Callable[..., Any]) -> Function:
    """A function of charts: what it returns for given formulas, a formula or a list of actions.

    Written before a definition, ``@function``; the label of a formula shows the call.  Raises ``ModelError``
    for a definition whose parameters have defaults or are not counted.
    """
    if not callable(body):
        raise ModelError(f"function({brief(body)}) takes a definition; write `@function` before `def`.")
    parameters = inspect.signature(body).parameters.values()
    name = getattr(body, "__name__", "")
    for one in parameters:
        if one.kind is not inspect.Parameter.POSITIONAL_OR_KEYWORD or one.default is not one.empty:
            raise ModelError(f"{name}() has the parameter `{one}`; write plain names, without defaults.")
    return Function(name, body, tuple(one.name for one in parameters))
