"""The model that a live page shows, read again when it is saved, and the sessions that explore it.

Whatever is wrong with what was saved last, the model before it stays, and so does every session.
"""

import secrets
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from threading import Condition, RLock

from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.commands.shared.options import VariantOptions
from rovercheck.checker.explore.by_hand.session import Session
from rovercheck.checker.explore.by_hand.value_syntax import RefusedInput, value
from rovercheck.checker.model.variant import Variant
from rovercheck.checker.verify.result import Result
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System, chart_alone, charts_of

MOST_SESSIONS = 32
"""Sessions that are kept; the one that was used least recently goes."""


@dataclass
class Exploration:
    """A session of the page, on one version of the model; ``said`` is what is to be said of the last move."""

    id: str
    name: str
    session: Session
    version: int
    said: list[str] = field(default_factory=list)


class Workspace:
    """One model, its sessions and what was decided of it.

    All is done with ``lock`` held: solvers and sessions are for one thread at a time.
    """

    def __init__(self, options: VariantOptions) -> None:
        """Raises ``ModelError`` or ``UsageError`` if the model cannot be read at all."""
        self.options = options
        self.lock = RLock()
        self.changed = Condition(self.lock)
        self.variant: Variant = options.variant()
        self.systems: Mapping[str, System] = self.variant.systems()
        self.version = 1
        self.problem = ""
        self.explorations: dict[str, Exploration] = {}
        self.decided: dict[str, Result] = {}

    # --- the model ---

    def reload(self) -> None:
        """Read the model again; what is wrong with it is a problem to show, and the model before it stays."""
        try:
            variant = self.options.variant()
            systems = variant.systems()
        except (ModelError, UsageError) as error:
            self.trouble(str(error))
            return
        except RecursionError:
            self.trouble("The model is nested too deeply to be read.")
            return
        with self.lock:
            self.variant, self.systems, self.problem = variant, systems, ""
            self.version += 1
            self.decided.clear()
            for one in self.explorations.values():
                self._carry_over(one)
            self.changed.notify_all()

    def trouble(self, text: str) -> None:
        """Say what keeps the model from being read again."""
        with self.lock:
            if text != self.problem:
                self.problem = text
                self.changed.notify_all()

    def _carry_over(self, one: Exploration) -> None:
        """Make the run of a session again on the changed model, as far as that goes."""
        try:
            session = Session(self.system(one.name))
        except (ModelError, UsageError) as error:
            one.said = [f"{error} This is the run on the model before it was saved."]
            return
        ticks, looked_at = len(one.session.simulation), one.session.simulation.at
        stopped = _repeated(one.session, session)
        one.session, one.version = session, self.version
        done = len(session.simulation)
        with suppress(RefusedInput):
            session.goto(min(looked_at, done))
        if stopped:
            one.said = [f"The model was saved: the run goes as far as tick {done} of {ticks}. {stopped}"]
        else:
            one.said = [f"The model was saved: {done} ticks are executed again on it."] if done else []

    def system(self, name: str) -> System:
        """The system of that name, or a chart alone.  Raises ``UsageError`` if there is none."""
        if name in self.systems:
            return self.systems[name]
        chart = charts_of(self.systems).get(name)
        if chart is None:
            raise UsageError(f"The model has no system and no chart {name!r} any more.")
        return chart_alone(chart, self.systems)

    # --- sessions ---

    def open(self, name: str) -> Exploration:
        """A new session.  Raises ``UsageError`` for an unknown name, ``ModelError`` if it is ill-formed."""
        one = Exploration(secrets.token_hex(8), name, Session(self.system(name)), self.version)
        while len(self.explorations) >= MOST_SESSIONS:
            del self.explorations[next(iter(self.explorations))]
        self.explorations[one.id] = one
        return one

    def exploration(self, id: str) -> Exploration:
        """The session of that id, now the one used last.  Raises ``UsageError`` if there is none."""
        if id not in self.explorations:
            raise UsageError("This session is over: open the chart or system again.")
        one = self.explorations[id] = self.explorations.pop(id)
        return one


def _repeated(old: Session, new: Session) -> str:
    """Execute the run of a session in another, names and values as they are written; why it ends early."""
    before, after = old.simulation, new.simulation
    try:
        for name, raw in before.frozen.items():
            if name in after.frozen:
                after.fix(name, value(after.variables[name], before.variables[name].domain.show(raw)))
        for tick in range(1, len(before) + 1):
            given = {
                n: value(after.inputs[n], before.inputs[n].domain.show(raw))
                for n, raw in before.given(tick).items()
                if n in after.inputs
            }
            new.follow({}, [given])
        new.breaks = [(text, new.condition(text)) for text, _ in old.breaks]
    except (RefusedInput, ModelError) as error:
        return str(error)
    new.free, new.chosen = old.free & after.inputs.keys(), old.chosen & after.inputs.keys()
    return ""
