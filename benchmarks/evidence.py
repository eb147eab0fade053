"""Whether an answer stands without the engine that gave it: runs are replayed, proofs checked again."""

from collections.abc import Mapping

from rovercheck.checker.certify.certificate import certificates
from rovercheck.checker.certify.check import CheckEffort, check
from rovercheck.checker.certify.outcome import Accepted, Rejected
from rovercheck.checker.results.verdict import Answer, Open, Reached, Run, Unreachable
from rovercheck.spec_model.lang.evaluate import admissible, step
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem

REPLAYED, CERTIFIED = "replayed", "certified"
STANDS = frozenset({REPLAYED, CERTIFIED})


def evidence(
    system: TransitionSystem, goals: Mapping[str, Var], found: Mapping[str, tuple[Answer, str]], limit: float
) -> dict[str, str]:
    """For each goal ``replayed``, ``certified``, or why it is neither.  ``limit``: seconds for each proof."""
    proofs: dict[str, dict[str, Answer]] = {}
    words = {}
    for name, (answer, by) in found.items():
        match answer:
            case Reached(run):
                words[name] = REPLAYED if replayed(system, goals[name], run) else "the run does not reach it"
            case Unreachable():
                proofs.setdefault(by, {})[name] = answer
                words[name] = "no certificate"
            case Open():
                words[name] = "open"
    for engine, answers in proofs.items():
        for one in certificates(system, [goals[n] for n in answers], answers, engine):
            outcome = check(one, system, CheckEffort(seconds=limit))
            for name in one.claims:
                match outcome:
                    case Accepted():
                        words[name] = CERTIFIED
                    case Rejected(obligation, shown):
                        words[name] = f"REJECTED: {obligation}: {shown}"
                    case _:
                        words[name] = outcome.reason
    return words


def replayed(system: TransitionSystem, goal: Var, run: Run) -> bool:
    """Whether the reference semantics takes the run to the goal, and to it in its last tick only."""
    at, hits = {**system.init, **run.frozen}, []
    for inputs in run.inputs:
        if not admissible(system, at, inputs):
            return False
        at = step(system, at, inputs)
        hits.append(bool(at[goal.name]))
    return hits.count(True) == 1 and hits[-1]
