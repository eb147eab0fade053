"""Executable content: what a machine of SCXML does in a transition, or where a state is entered or left."""

from collections.abc import Callable, Iterator, Sequence
from copy import deepcopy
from typing import TypeAlias
from xml.etree.ElementTree import Comment, Element

from rovercheck.checker.export.names import one_line
from rovercheck.checker.export.scxml.formulas import ScxmlFormulas
from rovercheck.spec_model.lang.action import Action, Assign, If, Send, each_action
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Expr

Content: TypeAlias = tuple[Element, ...]


def element(tag: str, content: Sequence[Element] = (), **attributes: str | None) -> Element:
    """An element with copies of what is in it."""
    made = Element(tag, {name: value for name, value in attributes.items() if value is not None})
    made.extend([deepcopy(one) for one in content])
    return made


def comment(text: str) -> Element:
    """A comment, in which no two signs of minus follow each other."""
    return Comment(f" {one_line(text).replace('--', '- -')} ")  # type: ignore[return-value]


def raised(event: str) -> Content:
    """An event that the machine takes after its transition."""
    return (element("raise", event=event),)


def chosen(condition: str, then: Content, otherwise: Content) -> Content:
    """One of two contents."""
    if not then and not otherwise:
        return ()
    if not then:
        return chosen(f"!({condition})", otherwise, ())
    return (element("if", (*then, *((element("else"), *otherwise) if otherwise else ())), cond=condition),)


class ContentWriter:
    """Actions without sends as content; ``plainly`` replaces temporal words in their formulas."""

    def __init__(self, formulas: ScxmlFormulas, plainly: Callable[[Expr], Expr] = lambda expr: expr) -> None:
        self.formulas, self._plainly = formulas, plainly

    def __call__(self, actions: Sequence[Action]) -> Content:
        """Actions in order."""
        return tuple(one for action in actions for one in self._action(action))

    def _action(self, action: Action) -> Iterator[Element]:
        match action:
            case Assign(var, value):
                yield element(
                    "assign", location=self.formulas.names.data(var.name), expr=self._formula(value)
                )
            case If(condition, then, otherwise):
                yield from chosen(self._formula(condition), self(then), self(otherwise))
            case _:
                raise AssertionError(action)

    def _formula(self, expr: Expr) -> str:
        return self.formulas(self._plainly(expr))


def refuse_sends(chart: Chart, actions: Sequence[Action], where: str) -> None:
    """Raises ``ModelError`` for a send where states are being entered or left."""
    for one in sends(actions):
        raise ModelError(
            f"{chart.name}: `{one}` in {where} executes its receiver while states are being entered or left, "
            "which SCXML does in one go; send it in a condition action or in a during action."
        )


def sends(actions: Sequence[Action]) -> list[Send]:
    """The sends among actions."""
    return [a for a in each_action(actions) if isinstance(a, Send)]


__all__ = ["Content", "ContentWriter", "chosen", "comment", "element", "raised", "refuse_sends", "sends"]
