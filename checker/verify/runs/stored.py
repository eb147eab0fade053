"""Runs that are kept: traces again, once the lowered system and the interpreter of charts agree on them."""

from collections.abc import Mapping
from dataclasses import replace

from rovercheck.checker.results.verdict import StoredRun, Unknown, Violated
from rovercheck.checker.store.verdict_json import Definite
from rovercheck.checker.store.verdicts import StoredVerdict
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.runs.replay import ReplayError, replay
from rovercheck.properties.forms import Property, Reachable, Unbounded
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System


def replayed(kept: StoredVerdict, prop: Property, systems: Mapping[str, System]) -> Definite | None:
    """The verdict that is kept, its run replayed; None where the run does not show it.

    A run without end is not replayed but looked for again, and so is one that shows more than a run can.
    """
    because = kept.verdict.because
    if not isinstance(because, StoredRun):
        return None if _wants_run(kept, prop) else kept.verdict
    if isinstance(prop.form, Unbounded) or kept.system not in systems or not _wants_run(kept, prop):
        return None
    question = reduce(lowered(systems[kept.system]), [replace(prop, on=kept.system)])
    try:
        trace = replay(question.system, question.goals[0], because.run)
    except (ReplayError, ModelError, KeyError):
        return None
    return replace(kept.verdict, because=replace(trace, shortest=because.shortest))


def again(result: Result, systems: Mapping[str, System]) -> Result:
    """The result with its run replayed, where that can be done."""
    if isinstance(result.verdict, Unknown):
        return result
    verdict = replayed(StoredVerdict(result.verdict, result.system), result.property, systems)
    return result if verdict is None else replace(result, verdict=verdict)


def _wants_run(kept: StoredVerdict, prop: Property) -> bool:
    """Whether such a verdict on such a property rests on a run: a counterexample, or a witness."""
    return isinstance(kept.verdict, Violated) != isinstance(prop.form, Reachable)
