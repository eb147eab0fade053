"""What the live page asks for: each request by its name, as a function from JSON to JSON."""

from collections.abc import Callable, Generator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from typing import Any

from rovercheck.checker.commands.serve.document import (
    JobDocument,
    OverviewDocument,
    PicturesDocument,
    SessionDocument,
    VerdictRow,
)
from rovercheck.checker.commands.serve.jobs import Job, Jobs, Work
from rovercheck.checker.commands.serve.view import overview, pictures, run_of, session_document, verdict
from rovercheck.checker.commands.serve.workspace import Exploration, Workspace
from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.commands.shared.output import counted
from rovercheck.checker.commands.shared.select import pick
from rovercheck.checker.engines import Limits
from rovercheck.checker.explore.by_hand.session import MOST_TICKS, ExecutedTicks
from rovercheck.checker.explore.by_hand.value_syntax import RefusedInput
from rovercheck.checker.explore.reach import SECONDS, NeverReached, NotDecided, ReachAnswer, RunFound, reach
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.searches import SearchActivity, SearchSettings, events
from rovercheck.spec_model.lang.expr import Expr

DECIDE_SECONDS = 600.0
"""How long a property is searched for from the page; it can be cancelled at any moment."""

CHUNK = 200
"""Ticks that are executed while nothing else is answered."""

Given = Mapping[str, Any]


def text(given: Given, name: str) -> str:
    """A text of a request.  Raises ``UsageError`` where there is none."""
    found = given.get(name)
    if not isinstance(found, str) or not found.strip():
        raise UsageError(f"The request has no {name}.")
    return found.strip()


def number(given: Given, name: str) -> int:
    """A whole number of a request.  Raises ``UsageError`` where there is none."""
    found = given.get(name)
    if not isinstance(found, int) or isinstance(found, bool) or found < 0:
        raise UsageError(f"The request has no number {name}.")
    return found


def texts(given: Given, name: str) -> list[str]:
    """Texts of a request, none if it has none.  Raises ``UsageError`` for something else."""
    found = given.get(name, [])
    if not isinstance(found, list) or not all(isinstance(one, str) for one in found):
        raise UsageError(f"The request has no list {name}.")
    return found


@dataclass
class Api:
    """The requests of the page about one workspace."""

    workspace: Workspace
    jobs: Jobs

    def call(self, name: str, given: Given) -> object:
        """Answer a request.  Raises ``KeyError`` for one that there is not, and what the model raises."""
        found: Callable[[Given], object] = getattr(self, f"do_{REQUESTS[name]}")
        with self.workspace.lock:
            return found(given)

    # --- looking ---

    def do_overview(self, given: Given) -> OverviewDocument:
        return overview(self.workspace)

    def do_pictures(self, given: Given) -> PicturesDocument:
        return pictures(self._session(given).session.simulation.system)

    def do_state(self, given: Given) -> SessionDocument:
        return session_document(self._session(given), texts(given, "required"))

    def do_open(self, given: Given) -> SessionDocument:
        """Begin to explore a chart or a system."""
        return session_document(self.workspace.open(text(given, "name")))

    def do_load(self, given: Given) -> SessionDocument:
        """Begin to explore at the end of the run of a property that was decided."""
        id = text(given, "property")
        trace = self.trace(id)
        one = self.workspace.open(trace.system.name)
        one.session.play(trace.before, [tick.inputs for tick in trace.ticks])
        one.said = [
            f"The run of {id} is loaded, and this is its end. Go back to a tick and take another step to see "
            "what else could have happened."
        ]
        return session_document(one)

    def trace(self, id: str) -> Trace:
        """The run of a property that was decided.  Raises ``UsageError`` if there is none."""
        with self.workspace.lock:
            trace = run_of(self.workspace.decided.get(id))
        if trace is None:
            raise UsageError(f"{id} was not decided here, or its verdict rests on no run; decide it first.")
        return trace

    # --- moving ---

    def do_take(self, given: Given) -> SessionDocument:
        """Take a tick in which the steps with some keys happen."""
        one = self._session(given)
        keys = texts(given, "keys")
        if not keys:
            raise UsageError("The request names no step.")
        steps = one.session.next_steps(keys)
        chosen = [steps.of(key) for key in keys]
        found = [step for step in chosen if step is not None]
        if len(found) < len(keys):
            raise RefusedInput("These steps cannot happen together in this tick, or not any more.")
        return self._moved(one, one.session.take(found[0], found))

    def do_step(self, given: Given) -> SessionDocument:
        """Execute ticks with the inputs as they stand, up to a break."""
        one = self._session(given)
        return self._moved(one, one.session.advance(max(1, number(given, "ticks"))))

    def do_until(self, given: Given) -> JobDocument:
        """Execute ticks with the inputs as they stand until a condition is true, or up to a break."""
        one = self._session(given)
        written = text(given, "condition")
        work = self._until(one, one.session.condition(written))
        return self.job_document(self.jobs.start(f"until {written}", work, session=one.id))

    def _until(self, one: Exploration, formula: Expr) -> Work:
        done = 0
        while done < MOST_TICKS:
            with self.workspace.lock:
                ran = one.session.advance(CHUNK, formula)
                self._moved(one, ran)
                if ran.met or ran.stopped:
                    return f"{ran.stopped or 'True'} after tick {ran.last}."
            done += CHUNK
            yield f"tick {ran.last}"
        return f"Not true within {MOST_TICKS:,} ticks with these inputs; that it never is, is not shown."

    def do_goto(self, given: Given) -> SessionDocument:
        """Look at another tick."""
        one = self._session(given)
        one.said = []
        one.session.goto(number(given, "tick"))
        return session_document(one)

    def do_set(self, given: Given) -> SessionDocument:
        """Let inputs stand at values, or, before the first tick, choose a frozen value."""
        one = self._session(given)
        name, written, session = text(given, "name"), text(given, "value"), one.session
        one.said = []
        if name in session.simulation.frozen:
            session.fix(name, written)
        else:
            session.set([(name, written)])
        return session_document(one)

    def do_random(self, given: Given) -> SessionDocument:
        """Draw all inputs at random, or let them stand again."""
        one = self._session(given)
        if one.session.free:
            one.session.hold()
            one.said = ["All inputs stand as they are."]
        else:
            one.session.let_run(one.session.simulation.inputs, one.session.seed + 1)
            one.said = [f"All inputs are drawn at random from the next tick on, seed {one.session.seed}."]
        return session_document(one)

    def do_break(self, given: Given) -> SessionDocument:
        """Stop wherever a condition becomes true."""
        one = self._session(given)
        written = text(given, "condition")
        one.session.breaks.append((written, one.session.condition(written)))
        one.said = []
        return session_document(one)

    def do_unbreak(self, given: Given) -> SessionDocument:
        """Forget a break."""
        one = self._session(given)
        at = number(given, "number")
        if at >= len(one.session.breaks):
            raise UsageError("There is no such break any more.")
        del one.session.breaks[at]
        one.said = []
        return session_document(one)

    def _session(self, given: Given) -> Exploration:
        return self.workspace.exploration(text(given, "session"))

    def _moved(self, one: Exploration, ran: ExecutedTicks) -> SessionDocument:
        one.said = []
        if ran.forgotten:
            left = counted(ran.forgotten, "tick", "ticks")
            one.said.append(f"A new branch: {left} after tick {ran.first - 1} forgotten.")
        if ran.stopped:
            one.said.append(f"Tick {ran.last}: {ran.stopped}")
        return session_document(one)

    # --- searching ---

    def do_reach(self, given: Given) -> JobDocument:
        """Have engines search a run from here to a condition."""
        one = self._session(given)
        written, sim = text(given, "condition"), one.session.simulation
        search = reach(
            sim.system,
            sim.state(),
            one.session.condition(written),
            Limits(seconds=SECONDS),
            first=not sim.at,
        )
        work = self._reached(one, sim.at, one.version, search)
        return self.job_document(self.jobs.start(f"reach {written}", work, session=one.id))

    def _reached(
        self,
        one: Exploration,
        tick: int,
        version: int,
        search: Generator[str | ReachAnswer | None, None, None],
    ) -> Work:
        answer: ReachAnswer | None = None
        with closing(search):
            for heard in search:
                if isinstance(heard, ReachAnswer):
                    answer = heard
                else:
                    yield heard
        match answer:
            case RunFound(run, engine, shortest):
                with self.workspace.lock:
                    if one.version != version or one.session.simulation.at < tick:
                        return "A run was found, but the session has changed meanwhile: search again."
                    one.session.goto(tick)
                    ran = one.session.follow(run.frozen, run.inputs)
                    said = f"Reached in {counted(len(run), 'tick', 'ticks')} by a run that {engine} found; "
                    said += "none is shorter." if shortest else "there may be a shorter one."
                    self._moved(one, ran)["said"].append(said)
                    return said
            case NeverReached(how, engine):
                return f"Never, from tick {tick} on: {how} ({engine}; no certificate)."
            case NotDecided(reason):
                return f"Not decided: {reason}"
        return ""

    def do_decide(self, given: Given) -> JobDocument:
        """Decide a property, as ``rovercheck check`` does."""
        id = text(given, "property")
        prop = pick("property", id, self.workspace.variant.model.properties)
        work = self._decided(prop.id, self.workspace.version)
        return self.job_document(self.jobs.start(f"check {prop.id}", work, prop=prop.id))

    def _decided(self, id: str, version: int) -> Work:
        workspace = self.workspace
        prop, systems = workspace.variant.asked(workspace.variant.model.properties[id]), workspace.systems
        search = SearchSettings(limits=Limits(seconds=DECIDE_SECONDS), jobs=1)
        with closing(events([prop], systems, search)) as found:
            for one in found:
                if isinstance(one, Result):
                    with workspace.lock:
                        if workspace.version != version:
                            return "The model was saved meanwhile: decide it again."
                        workspace.decided[id] = one
                        return f"{id} is {one.verdict.word}: {verdict(workspace, prop)['evidence']}"
                yield one.line if isinstance(one, SearchActivity) else None
        return f"{id} was not decided."

    def do_job(self, given: Given) -> JobDocument:
        return self.job_document(self.jobs.find(text(given, "job")))

    def do_cancel(self, given: Given) -> JobDocument:
        self.jobs.cancel(id := text(given, "job"))
        return self.job_document(self.jobs.find(id))

    def job_document(self, job: Job) -> JobDocument:
        """A search as the page is told of it."""
        over = job.state != "searching"
        session = self.workspace.explorations.get(job.session) if over else None
        row: VerdictRow | None = None
        known = self.workspace.variant.model.properties
        if over and job.prop in known:
            row = verdict(self.workspace, known[job.prop])
        return {
            "job": job.id,
            "about": job.about,
            "state": job.state,
            "line": job.line,
            "seconds": round(job.seconds, 1),
            "answer": job.answer,
            "session": session_document(session) if session else None,
            "verdict": row,
        }


REQUESTS: Mapping[str, str] = {
    name.removeprefix("do_"): name.removeprefix("do_") for name in vars(Api) if name.startswith("do_")
}
"""The requests that there are."""

__all__: Sequence[str] = ["REQUESTS", "Api"]
