"""What a reviewer may want on top of verdicts: what forces a counterexample, whether proofs say anything."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from checker.commands.check import Compared, results
from checker.commands.output import err
from checker.commands.progress import Watch
from checker.engine import Limits
from checker.explain.explained import explained
from checker.result import Result
from checker.trace import Trace
from checker.verdict import Proved, Violated
from properties.premise import premise
from spec_model.lang.system import System

PATIENCE = 60.0
"""Seconds for each search for a case, unless the user sets a limit: a witness may be hard to find."""


def with_reasons(found: Sequence[Compared], systems: Mapping[str, System]) -> list[Compared]:
    """The same verdicts, each counterexample with the inputs that force its end.

    It takes as long as it takes: a limit of time would make the page depend on the machine.
    """
    broken = [c for c in found if _run(c) is not None]
    with Watch(err, len(broken)) as watch:
        return [_with_reason(c, systems, watch) for c in found]


def _run(compared: Compared) -> Trace | None:
    """The counterexample, if there is one."""
    verdict = compared.verdict
    return verdict.because if isinstance(verdict, Violated) and isinstance(verdict.because, Trace) else None


def _with_reason(compared: Compared, systems: Mapping[str, System], watch: Watch) -> Compared:
    run, prop = _run(compared), compared.result.property
    if run is None:
        return compared
    task = f"{prop.id}: what forces it"
    forced = explained(run, prop, systems[run.system], lambda line: watch.say(task, line))
    watch.finished(task)
    verdict = Violated(forced, compared.verdict.engine)
    return replace(compared, result=replace(compared.result, verdict=verdict))


def premises(
    found: Sequence[Compared], systems: Mapping[str, System], engine: str, limits: Limits, jobs: int | None
) -> dict[str, Result]:
    """Of each property that is proved, by id, whether the case occurs of which it speaks."""
    proved = (c.result.property for c in found if isinstance(c.verdict, Proved))
    cases = [case for case in map(premise, proved) if case is not None]
    patient = replace(limits, seconds=limits.seconds or PATIENCE)
    return {r.property.id: r for r in results(cases, systems, engine, patient, jobs)} if cases else {}
