"""What is exported: a system with bad states, and what each of them means for the property."""

from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import version

from rovercheck.checker.export.names import one_line
from rovercheck.checker.verify.liveness.loops import loop_query
from rovercheck.properties.forms import LeadsTo, Property, Recoverable, Settles
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem

LEAVES = "a variable leaves its domain"
"""The name of the bad state that stands for a model without meaning."""
UNDEFINED = "the model has no meaning"


@dataclass(frozen=True)
class Bad:
    """A boolean variable of the system that is 1 after a bad tick, and what that means."""

    var: Var
    meaning: str


@dataclass(frozen=True)
class Problem:
    """Whether some run reaches a bad state.

    The first of ``bad`` belongs to the property, the others to the system: if one of these is reached,
    the model has no meaning.  Formats add a bad state for variables that may leave their domains.
    ``about`` are lines for readers.
    """

    id: str
    system: TransitionSystem
    bad: tuple[Bad, ...]
    about: tuple[str, ...] = ()

    @property
    def header(self) -> tuple[str, ...]:
        """One line each: tool and version, system, what it is about, what the bad states mean."""
        meanings = (f"bad state {b.var.name}: {b.meaning}" for b in self.bad)
        lines = (f"rovercheck {version('rovercheck')}", f"system: {self.system.name}", *self.about, *meanings)
        return tuple(map(one_line, lines))


def problem(system: TransitionSystem, prop: Property, about: Sequence[str] = ()) -> Problem:
    """The property as a question of reachability on the lowered system.

    A property about infinite runs becomes the question whether a loop closes that breaks it
    (``checker.verify.liveness.loops``).  Raises ``ModelError`` for a ``Recoverable``, which is no such
    question, and for a property that does not fit the system.
    """
    if isinstance(prop.form, Recoverable):
        raise ModelError(
            f"{prop.id} asks that there is always a way back, which no bad state says; "
            "export a property of another form, or decide this one with `rovercheck check`."
        )
    question = reduce(system, [prop])
    goal = question.goals[0]
    checked, var, meaning = question.system, goal.var, _meaning(prop, goal.reach)
    if isinstance(prop.form, LeadsTo | Settles):
        lasso = loop_query(question, goal).lasso
        checked, var, meaning = lasso.system, lasso.goal, f"a loop closes that violates {prop.id}"
    checks = (Bad(check, f"{UNDEFINED}: {text}") for check, text in checked.checks)
    text = f"property {prop.id}: {prop.text}"
    return Problem(prop.id, checked, (Bad(var, meaning), *checks), (text, *about))


def _meaning(prop: Property, reach: bool) -> str:
    return f"{prop.id} is proved, its witness being the run" if reach else f"{prop.id} is violated"
