"""A run from a state to a condition, found by engines in a child process, or that there is none from there.

The question is that of a property, with another beginning: the state after the ticks executed so far.  What
is found is executed by the interpreter of charts before it is shown (``Session.follow``).
"""

from collections.abc import Generator, Mapping
from contextlib import closing
from dataclasses import dataclass, replace

from rovercheck.checker.engines import AUTO, Limits
from rovercheck.checker.process.isolate import ChildStopped, Send, messages
from rovercheck.checker.results.verdict import Reached, Run, Unreachable
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.expr import Const, Expr, all_of, flag
from rovercheck.spec_model.lang.system import System, TransitionSystem

GOAL = flag("the condition to reach", hidden=True)
SECONDS = 60.0
"""How long is searched, unless a person says otherwise."""
SLACK = 2 << 30
"""Bytes of address space that a child needs besides what an engine may store."""


@dataclass(frozen=True)
class RunFound:
    """A run to the condition: the inputs of each tick from here on, and frozen values where these are open.

    ``shortest``: none with fewer ticks leads there.
    """

    run: Run
    engine: str
    shortest: bool


@dataclass(frozen=True)
class NeverReached:
    """No run from here makes the condition true; ``how`` says what shows it: ``all 154 reachable states``."""

    how: str
    engine: str


@dataclass(frozen=True)
class NotDecided:
    """Neither was found, and why; for ``depth`` ticks from here the condition is known not to be reached."""

    reason: str
    depth: int


ReachAnswer = RunFound | NeverReached | NotDecided


def reach(
    system: System, state: Mapping[str, int], condition: Expr, limits: Limits, *, first: bool
) -> Generator[str | ReachAnswer | None, None, None]:
    """Search a run of a tick or more from a state to a condition: lines on the search, at last an answer.

    ``state`` has all frozen and written values, raw; ``first``: it is the one before the first tick, and
    frozen values are still to be chosen.  None comes after a second without news.  Closing the generator ends
    the search.  Raises ``ModelError`` if the model leaves a domain.
    """
    order = (system, dict(state), condition, limits, first)
    try:
        with closing(
            messages(_search, *order, seconds=limits.seconds, memory=limits.memory + SLACK)
        ) as heard:
            for message in heard:
                if isinstance(message, Exception):
                    raise message
                yield message
                if isinstance(message, ReachAnswer):
                    return
    except ChildStopped as error:
        yield NotDecided(str(error), 0)


def from_state(
    system: TransitionSystem, state: Mapping[str, int], condition: Expr, *, first: bool
) -> TransitionSystem:
    """The system that begins in a state; its variable ``GOAL`` tells when a tick meets a condition."""
    begun = tuple(replace(v, init=state[v.name]) for v in system.variables)
    fixed = () if first else tuple(v == Const(state[v.name], v.sort) for v in system.frozen)
    return replace(
        system,
        variables=(*begun, GOAL),
        assume=all_of(system.assume, *fixed),
        step=(*system.step, Assign(GOAL, condition)),
        source=None,
    )


def _search(
    send: Send, system: System, state: Mapping[str, int], condition: Expr, limits: Limits, first: bool
) -> None:
    from rovercheck.checker.system.lowering_cache import lowered
    from rovercheck.checker.verify.portfolio import Callbacks, PortfolioQuestion, answers
    from rovercheck.checker.verify.result import check_domains
    from rovercheck.checker.verify.search_worker import Seldom
    from rovercheck.spec_model.lang.errors import ModelError

    progress = Seldom(send)
    send(f"lowering {system.name}")
    begun = from_state(lowered(system), state, condition, first=first)
    question = PortfolioQuestion(begun, (GOAL,))
    try:
        found = answers(question, AUTO, limits, Callbacks(progress))
        if not isinstance(found[GOAL.name].answer, Reached):  # a run that is found leaves no domain itself
            check_domains(begun, found)
    except ModelError as error:
        send(ModelError(str(error)))
        return
    answer, engine = found[GOAL.name]
    match answer:
        case Reached(run, shortest):
            send(RunFound(run, engine, shortest))
        case Unreachable(because):
            send(NeverReached(because.how, engine))
        case _:
            send(NotDecided(answer.reason, answer.depth))
