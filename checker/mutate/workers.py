"""Mutants judged in child processes, several at a time, each within its own time."""

from collections.abc import Generator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, replace

from rovercheck.checker.cache.listeners import listening
from rovercheck.checker.engines import Limits
from rovercheck.checker.mutate.fate import Fate, MutantCase, MutantFate
from rovercheck.checker.mutate.mutants import Mutant
from rovercheck.checker.mutate.plan import PlannedMutant
from rovercheck.checker.process.faults import Fault, described, is_fault, report
from rovercheck.checker.process.faults import listening as attending
from rovercheck.checker.process.isolate import Send
from rovercheck.checker.process.pool import GrantedTime, Jobs, Order, Pool, PoolEvent, cores
from rovercheck.checker.verify.searches import SLACK


@dataclass(frozen=True)
class MutantProgress:
    """One line on what is being done about a mutant."""

    mutant: Mutant
    line: str


@dataclass(frozen=True)
class MutantJudged:
    """A mutant and its fate."""

    mutant: Mutant
    judged: MutantFate


def fates(
    planned: Sequence[PlannedMutant],
    limits: Limits,
    jobs: Jobs | None = None,
    before: Mapping[str, MutantFate] | None = None,
    search: bool = True,
) -> Generator[MutantProgress | MutantJudged, None, None]:
    """The fate of each mutant as it is found; the time of ``limits`` is for each of them.

    Without ``search`` it is unknown where no run that is known and no single query decides it.

    A child that dies, or does not stop in time, makes its mutant unknown, with the reason.  Raises
    ``ReplayError`` and ``Disagreement``, which are internal errors.  Closing the generator ends all children.
    """
    pool = Pool(jobs or cores(), _Judging, (limits, search), limits.memory + SLACK)
    known = before or {}
    orders = [
        Order((one.mutant.id, one.cases, known.get(one.mutant.id)), one.cases[0].mutant.name)
        for one in planned
    ]
    found: dict[int, MutantFate] = {}
    with closing(pool.run(orders)) as events:
        for event in events:
            mutant = planned[event.number].mutant
            match event.message:
                case Exception() as error:
                    raise error
                case Fault() as fault:
                    report(fault)
                case MutantFate() as heard:
                    found[event.number] = heard
                case str(line):
                    yield MutantProgress(mutant, line)
            if event.done:
                judged = found.pop(event.number) if event.number in found else None
                yield MutantJudged(mutant, judged or _ended(event, limits, known.get(mutant.id)))


def _ended(event: PoolEvent, limits: Limits, before: MutantFate | None) -> MutantFate:
    """The fate of a mutant whose search ended without a word on it."""
    why = event.failure or "the search ended without a word on it"
    if event.late and limits.seconds is not None:
        why = f"time: {limits.seconds:g} s ended"
    return replace(before or MutantFate(Fate.UNKNOWN), fate=Fate.UNKNOWN, why=why)


class _Judging:
    """Judges one mutant after the other, in a child."""

    def __init__(self, limits: Limits, search: bool) -> None:
        self._limits, self._search = limits, search

    def __call__(self, send: Send, id: str, cases: tuple[MutantCase, ...], before: MutantFate | None) -> None:
        from rovercheck.checker.mutate.fate import judged
        from rovercheck.checker.verify.portfolio import Disagreement
        from rovercheck.checker.verify.runs.replay import ReplayError

        send(GrantedTime(self._limits.seconds))
        try:
            with listening(send, anew=False), attending(send):
                send(judged(cases, self._limits, send, before, search=self._search))
        except ReplayError as error:
            send(ReplayError(f"{id}: {error}"))
        except Disagreement as error:
            send(error)
        except Exception as error:  # this mutant stays open
            if is_fault(error):
                send(Fault("the search", id, described(error)))
            raise


__all__ = ["MutantJudged", "MutantProgress", "fates"]
