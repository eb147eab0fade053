"""Certificates beside the verdicts of a search: written down, and checked again without the engine."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from rovercheck.checker.certify.certificate import Certificate
from rovercheck.checker.certify.check import CheckEffort, check
from rovercheck.checker.certify.file import CertificateOrigin, write
from rovercheck.checker.certify.outcome import Accepted, Outcome, Rejected, Undecided
from rovercheck.checker.certify.reader import CertificateReader
from rovercheck.checker.certify.record import rests_on_answers
from rovercheck.checker.engines import Limits, Progress, Stage
from rovercheck.checker.results.verdict import Exhausted, Unknown, Verdict
from rovercheck.checker.verify.decide import Task, decide
from rovercheck.checker.verify.portfolio import Callbacks
from rovercheck.checker.verify.result import Result
from rovercheck.spec_model.lang.system import System, TransitionSystem


@dataclass(frozen=True)
class Certification:
    """What to do with proofs: write them into a ``folder``, check them again, or both.

    ``interpretations``, ``repair``, ``without`` and ``changes`` say how the charts differ from those
    specified.
    """

    folder: Path | None = None
    again: bool = False
    interpretations: Mapping[str, str] = field(default_factory=dict)
    repair: str = ""
    without: tuple[str, ...] = ()
    changes: tuple[tuple[str, ...], ...] = ()
    effort: CheckEffort = field(default_factory=CheckEffort)
    sent: bool = False
    """Whether proofs are found elsewhere, and sent from there to be written and checked here."""

    def origin(self, task: Task, limits: Limits, results: Sequence[Result]) -> CertificateOrigin:
        """Where the questions of one search come from."""
        proved = tuple(r.property.id for r in results if rests_on_answers(r.verdict))
        searched = tuple(p.id for p in task.properties)
        changed = self.interpretations, self.repair, self.without
        return CertificateOrigin(
            task.system.name, searched, proved, *changed, limits.timers.value, self.changes
        )

    def written(
        self, task: Task, limits: Limits, results: Sequence[Result], made: Sequence[Certificate]
    ) -> None:
        """Write the certificates of one search.  Raises ``Unwritable``."""
        if self.folder is not None and made:
            write(self.folder, self.origin(task, limits, results), made)

    def outcomes(
        self,
        task: Task,
        systems: Mapping[str, System],
        limits: Limits,
        results: Sequence[Result],
        made: Sequence[Certificate],
        progress: Progress,
    ) -> dict[str, Outcome]:
        """What comes of deriving again, from the certificates alone, each verdict that rests on a proof."""
        proved = {r.property.id: r for r in results if rests_on_answers(r.verdict)}
        if not proved or not self.again:
            return {}
        progress(Stage(f"certifying {len(proved)} verdict{'s' * (len(proved) != 1)}"))
        reader = CertificateReader(made, self._checked)
        # All of the task: monitors that properties share are named after the first of them.
        again = {
            r.property.id: r for r in decide(task, systems, reader, limits, Callbacks(_staying(progress)))
        }
        return {id: _outcome(first, again[id], reader) for id, first in proved.items()}

    def _checked(self, one: Certificate, system: TransitionSystem) -> Outcome:
        return check(one, system, self.effort)


def _staying(progress: Progress) -> Progress:
    """A progress that stays at certifying, whatever is done for it."""
    return lambda line: None if isinstance(line, Stage) else progress(line)


def _outcome(first: Result, again: Result, reader: CertificateReader) -> Outcome:
    """Whether the certificates show what the engine has shown."""
    for outcome in reader.outcomes.values():
        if isinstance(outcome, Rejected):
            return outcome
    if first.verdict.word == again.verdict.word and again.verdict.engine == reader.NAME:
        return Accepted(reader.ways)
    undecided = [o for o in reader.outcomes.values() if isinstance(o, Undecided)]
    return undecided[0] if undecided else Undecided(_lacking(first.verdict, again.verdict, reader))


def _lacking(first: Verdict, again: Verdict, reader: CertificateReader) -> str:
    """Why no certificate was checked."""
    if reader.certificates and isinstance(again, Unknown):
        return again.reason
    if not isinstance(first, Unknown) and isinstance(first.because, Exhausted):
        too_many = "" if first.because.skipped else ", which are too many"
        return f"{first.engine} wrote no certificate of {first.because.how}{too_many}"
    return f"{first.engine} gave no certificate"
