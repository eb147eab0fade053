"""What a reviewer may want on top of verdicts: what forces a counterexample."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from rovercheck.checker.commands.shared.output import err
from rovercheck.checker.commands.shared.progress import Watch
from rovercheck.checker.engines import Progress
from rovercheck.checker.explain.explanation import NotLookedFor, explained_once
from rovercheck.checker.explain.unrolled_run import OutOfTime
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Violated
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.system import System

if TYPE_CHECKING:
    from rovercheck.checker.store.verdicts import VerdictStore


@dataclass(frozen=True)
class CauseSearch:
    """Where causes are kept that are not looked for again, and for how many seconds each other is.

    None: as long as it takes.  Seconds are of computing, which a busy machine does not shorten.  With
    ``kept_only`` no other is looked for; ``left`` are then the findings without.
    """

    store: "VerdictStore | None" = None
    seconds: float | None = None
    kept_only: bool = False
    left: list[str] = field(default_factory=list)


PATIENT = CauseSearch()
"""A limit of time would make a page depend on the machine."""


def with_reasons(
    found: Sequence[CheckedProperty], systems: Mapping[str, System], search: CauseSearch = PATIENT
) -> list[CheckedProperty]:
    """The same verdicts, each counterexample with the inputs that force its end; as it is where they are not
    found in time."""
    broken = [c for c in found if _run(c) is not None]
    with Watch(err, len(broken), of="findings") as watch:
        return [_with_reason(c, systems, search, watch) for c in found]


def _run(compared: CheckedProperty) -> Trace | None:
    """The counterexample, if there is one."""
    verdict = compared.verdict
    return verdict.because if isinstance(verdict, Violated) and isinstance(verdict.because, Trace) else None


def _with_reason(
    compared: CheckedProperty, systems: Mapping[str, System], search: CauseSearch, watch: Watch
) -> CheckedProperty:
    run, prop = _run(compared), compared.result.property
    if run is None:
        return compared
    task = f"{prop.id}: what forces it"
    forced = _forced(run, prop, systems[run.system.name], search, lambda line: watch.say(task, line))
    watch.finished(task)
    verdict = Violated(forced, compared.verdict.engine)
    return replace(compared, result=replace(compared.result, verdict=verdict))


def _forced(run: Trace, prop: Property, system: System, search: CauseSearch, progress: Progress) -> Trace:
    """The run with what forces its end, as far as that is found in time."""
    try:
        return explained_once(
            run, prop, system, search.store, progress, search.seconds, kept_only=search.kept_only
        )
    except OutOfTime:
        return run
    except NotLookedFor:
        search.left.append(prop.id)
        return run
