"""Transitions and junctions, as they are drawn."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from rovercheck.spec_model.lang.action import Action
from rovercheck.spec_model.lang.errors import ModelError, brief, several
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.place import Place, here
from rovercheck.spec_model.lang.stateflow.message import LabelText, label_text


@dataclass(frozen=True)
class Transition:
    """One segment of a transition: ``event [guard] {condition action} / transition action -> target``.

    ``label`` is a text that says all but the target, until a chart reads it with the names that it knows.
    ``place`` is where it is written.
    """

    target: str
    guard: Expr | None = None
    event: str | None = None
    do: tuple[Action, ...] = ()
    then: tuple[Action, ...] = ()
    label: LabelText | None = None
    place: Place | None = field(default=None, compare=False, repr=False)


def to(
    target: str,
    when: Expr | str | None = None,
    on: str | None = None,
    do: Sequence[Action] = (),
    then: Sequence[Action] = (),
) -> Transition:
    """A transition to a state or junction, by name.

    ``when`` is the guard, ``on`` the local event, ``do`` the condition action (run as soon as the
    segment is found valid) and ``then`` the transition action (run only on a complete path).  Or ``when`` is
    a label that says all of it, ``"stop [level > 80] {full = true} / count = 0"``, of names that the chart
    knows.
    """
    of = f"the transition to {target!r}"
    done, last = several(of, "do", do), several(of, "then", then)
    if isinstance(when, str):
        if on is not None or done or last:
            raise ModelError(f"{of} has a label and on=, do= or then= beside it; write all in the label.")
        return Transition(target, label=label_text(when), place=here())
    return Transition(target, when, on, done, last, place=here())


@dataclass(frozen=True)
class Junction:
    """A connective junction; its transitions are tested in order (rule G7)."""

    name: str
    transitions: tuple[Transition, ...]

    def __init__(self, name: str, transitions: Sequence[Transition]) -> None:
        object.__setattr__(self, "name", name)
        object.__setattr__(self, "transitions", several(f"Junction {name!r}", "transitions", transitions))


Default = tuple[Transition, ...]


def default_of(
    of: str, default: str | Transition | Sequence[Transition] | None, place: Place | None
) -> Default:
    match default:
        case None:
            return ()
        case str(name):
            return (Transition(name, place=place),)
        case Transition():
            return (default,)
        case Iterable():
            return several(of, "default", default)
        case _:
            raise ModelError(
                f"{of}: default={brief(default)}; write the name of a state, or a transition to one."
            )
