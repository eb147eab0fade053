"""Searches that a live page has begun: what they do, what came of them, and how they are ended."""

import secrets
from collections.abc import Generator
from contextlib import closing
from dataclasses import dataclass, field
from threading import Thread
from time import monotonic

from rovercheck.checker.commands.serve.document import JobState
from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.explore.by_hand.value_syntax import RefusedInput
from rovercheck.checker.process.faults import described
from rovercheck.checker.verify.runs.replay import ReplayError
from rovercheck.spec_model.lang.errors import ModelError

Work = Generator[str | None, None, str]
"""A search: lines on what it does, None now and then; what it returns is said at its end."""
MOST_JOBS = 64


@dataclass
class Job:
    """A search in a thread of its own; its child processes end with it."""

    id: str
    about: str
    session: str = ""
    prop: str = ""
    state: JobState = "searching"
    line: str = ""
    answer: str = ""
    begun: float = field(default_factory=monotonic)
    ended: float = 0.0
    cancelled: bool = False

    @property
    def seconds(self) -> float:
        """How long it has taken."""
        return (self.ended or monotonic()) - self.begun


class Jobs:
    """The searches of a page."""

    def __init__(self) -> None:
        self._jobs: dict[str, Job] = {}

    def start(self, about: str, work: Work, *, session: str = "", prop: str = "") -> Job:
        """Begin a search."""
        job = Job(secrets.token_hex(8), about, session, prop)
        while len(self._jobs) >= MOST_JOBS and (over := self._over()):
            del self._jobs[over]
        self._jobs[job.id] = job
        Thread(target=self._run, args=(job, work), name="search", daemon=True).start()
        return job

    def _over(self) -> str:
        return next((id for id, job in self._jobs.items() if job.state != "searching"), "")

    def find(self, id: str) -> Job:
        """The search of that id.  Raises ``UsageError`` if there is none."""
        if id not in self._jobs:
            raise UsageError("There is no such search any more.")
        return self._jobs[id]

    def cancel(self, id: str = "") -> None:
        """End a search, or all."""
        for job in [self.find(id)] if id else list(self._jobs.values()):
            job.cancelled = True

    def searching(self) -> bool:
        """Whether one is under way."""
        return any(job.state == "searching" for job in self._jobs.values())

    def _run(self, job: Job, work: Work) -> None:
        state: JobState = "done"
        try:
            with closing(work):
                job.answer = self._followed(job, work)
            state = "cancelled" if job.cancelled and not job.answer else "done"
        except (ModelError, RefusedInput, UsageError) as error:
            job.answer, state = str(error), "failed"
        except ReplayError as error:
            job.answer, state = f"A bug of rovercheck: {error}", "failed"
        except Exception as error:
            job.answer, state = f"A bug of rovercheck: {described(error)}", "failed"
        job.ended = monotonic()
        job.state = state

    def _followed(self, job: Job, work: Work) -> str:
        while not job.cancelled:
            try:
                line = next(work)
            except StopIteration as end:
                return str(end.value)
            if line is not None and line != job.line:
                job.line = line
        return ""
