"""Certificates that workers of a cluster send: written and checked here, by a child process."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass

from rovercheck.checker.certify.outcome import Undecided
from rovercheck.checker.engines import Limits
from rovercheck.checker.process.isolate import Send
from rovercheck.checker.process.pool import Order, Pool
from rovercheck.checker.verify.certificates import Certification
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.search_worker import PropertyCertified, Seldom, TaskCertificates
from rovercheck.checker.verify.searches import SLACK
from rovercheck.checker.verify.tasks import Task
from rovercheck.spec_model.lang.system import System


@dataclass(frozen=True)
class CertificateWorker:
    """Checks in a child the certificates of tasks about some systems."""

    systems: Mapping[str, System]
    limits: Limits
    certifying: Certification

    def __call__(self, send: Send, task: Task, results: Sequence[Result], data: bytes) -> None:
        """Write what was sent, where that is wanted, and send what comes of checking it."""
        from rovercheck.checker.certify.file import Unwritable, unpacked
        from rovercheck.checker.certify.terms import Malformed

        try:
            made = unpacked(data).certificates
            self.certifying.written(task, self.limits, results, made)
        except (Unwritable, Malformed) as error:
            send(error)
            return
        found = self.certifying.outcomes(task, self.systems, self.limits, results, made, Seldom(send))
        for id, outcome in found.items():
            send(PropertyCertified(id, outcome))


def certified_here(
    worker: CertificateWorker, sent: TaskCertificates, task: Task, results: Sequence[Result]
) -> Iterator[object]:
    """What the child says: lines on what it does, outcomes, an error; of the rest, that it has died."""
    given = worker.systems, worker.limits, worker.certifying
    pool = Pool(1, CertificateWorker, given, worker.limits.memory + SLACK)
    told = set[str]()
    with closing(pool.run([Order((task, tuple(results), sent.data))])) as events:
        for event in events:
            if isinstance(event.message, PropertyCertified):
                told.add(event.message.id)
            if event.message is not None:
                yield event.message
            elif event.failure:
                for one in results:
                    if one.property.id not in told:
                        yield PropertyCertified(one.property.id, Undecided(event.failure))


__all__ = ["CertificateWorker", "certified_here"]
