"""What a reviewer may want on top of verdicts: what forces a counterexample."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from rovercheck.checker.commands.shared.output import err
from rovercheck.checker.commands.shared.progress import Watch
from rovercheck.checker.explain.explanation import explained
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Violated
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.spec_model.lang.system import System


def with_reasons(found: Sequence[CheckedProperty], systems: Mapping[str, System]) -> list[CheckedProperty]:
    """The same verdicts, each counterexample with the inputs that force its end.

    It takes as long as it takes: a limit of time would make the page depend on the machine.
    """
    broken = [c for c in found if _run(c) is not None]
    with Watch(err, len(broken), of="findings") as watch:
        return [_with_reason(c, systems, watch) for c in found]


def _run(compared: CheckedProperty) -> Trace | None:
    """The counterexample, if there is one."""
    verdict = compared.verdict
    return verdict.because if isinstance(verdict, Violated) and isinstance(verdict.because, Trace) else None


def _with_reason(compared: CheckedProperty, systems: Mapping[str, System], watch: Watch) -> CheckedProperty:
    run, prop = _run(compared), compared.result.property
    if run is None:
        return compared
    task = f"{prop.id}: what forces it"
    forced = explained(run, prop, systems[run.system.name], lambda line: watch.say(task, line))
    watch.finished(task)
    verdict = Violated(forced, compared.verdict.engine)
    return replace(compared, result=replace(compared.result, verdict=verdict))
