"""What a user's choice of engine makes of a question: its answers, each as soon as it counts."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from time import monotonic

from rovercheck.checker.engines import ALL, AUTO, Engine, Limits, Progress, Prover, Stage, engines
from rovercheck.checker.process.faults import Failed, attempted
from rovercheck.checker.results.verdict import Answer, Open, Reached, Run, Unreachable
from rovercheck.checker.verify.portfolio.disagreement import together
from rovercheck.checker.verify.portfolio.order import CHECKS, ORDERS, RECORDED, SOON, Turn
from rovercheck.checker.verify.portfolio.question import (
    Callbacks,
    EngineAnswer,
    Found,
    PortfolioQuestion,
    conclusive,
    stays,
)
from rovercheck.checker.verify.portfolio.shape import shape
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.system import TransitionSystem

# --- recorded proofs, tried before anything is searched -----------------------------------------------


class RecordedInvariants:
    """An engine that tries the conjuncts of earlier proofs and searches for nothing."""

    SUMMARY = "the recorded invariants"

    def __init__(self, prover: Prover, candidates: Sequence[Expr]) -> None:
        self.NAME = prover.NAME
        self._prover, self._candidates = prover, candidates

    def check(
        self, system: TransitionSystem, goals: Sequence[Var], limits: Limits, progress: Progress
    ) -> Mapping[str, Answer]:
        """An answer for each goal, by name: open what the conjuncts do not exclude."""
        return self._prover.show(system, goals, limits, progress, self._candidates)


OUT_OF_MEMORY = "the memory limit is reached"

SHORTENED = 128
"""Ticks of the longest run for which a shorter one is looked for: unrolling further takes minutes."""


def in_turn(question: PortfolioQuestion, limits: Limits, callbacks: Callbacks) -> Iterator[Found]:
    """After each turn all that is found so far; the last one holds an answer for every goal.

    Raises ``Disagreement`` when a turn contradicts what an earlier one left to be confirmed.
    """
    known, turns = engines(), _Turns(question, limits, callbacks, limits.deadline())
    order: Sequence[Turn] = ORDERS[shape(question).kind]
    prover = known.get(RECORDED.engine)
    if question.candidates is not None and isinstance(prover, Prover):
        yield turns.take(RecordedInvariants(prover, question.candidates), RECORDED, question.goals)
        order = [turn for turn in order if turn is not SOON]
    for turn in order:
        goals = [g for g in question.open(turns.found) if _worth(turns.found.get(g.name))]
        if not goals or (turns.found and _over(question, turns.found, limits, turns.deadline)):
            break
        if turn.engine in known:
            yield turns.take(known[turn.engine], turn, goals)
    unsettled = question.unsettled(turns.found)
    if unsettled and _affordable(question, turns.deadline) and CHECKS.engine in known:
        yield turns.take(known[CHECKS.engine], CHECKS, unsettled)


@dataclass
class _Turns:
    """The turns of engines at one question, and what is found so far."""

    question: PortfolioQuestion
    limits: Limits
    callbacks: Callbacks
    deadline: float | None
    found: Found = field(default_factory=dict)

    def take(self, engine: Engine, turn: Turn, goals: Sequence[Var]) -> Found:
        """What is found so far, with what an engine says of some goals in its turn."""
        left = None if self.deadline is None else max(0.0, self.deadline - monotonic())
        self.callbacks.on_budget(left)
        answers = run_turn(engine, self.question, turn.within(self.limits, left), self.callbacks, goals)
        self.callbacks.on_budget(self.limits.seconds)  # for what is made of the answers
        for goal in goals:
            each = [*filter(None, [self.found.get(goal.name)]), answers[goal.name]]
            self.found = {**self.found, goal.name: together(self.question.system, goal, each)}
        return self.found


def _affordable(question: PortfolioQuestion, deadline: float | None) -> bool:
    """Whether it is soon found out that the model has no meaning, though a run has decided what was asked."""
    wide = shape(question).enumerable or not shape(PortfolioQuestion(question.system, ())).enumerable
    return not wide and (deadline is None or monotonic() < deadline)


def _worth(known: EngineAnswer | None) -> bool:
    """Whether a goal is worth another engine: a run that is known need only be made shorter."""
    return known is None or not isinstance(known[0], Reached) or len(known[0].run) <= SHORTENED


def _over(question: PortfolioQuestion, found: Found, limits: Limits, deadline: float | None) -> bool:
    """Whether no further engine is worth asking."""
    open_ = question.open(found)
    if not open_:
        return True
    looked = limits.depth is not None and all(_looked(found[g.name][0], limits.depth) for g in open_)
    # Whether other runs leave a domain does not matter to a run that is replayed.
    shown = question.wanted and all(_shortest(found[g.name][0]) for g in question.wanted)
    return looked or bool(shown) or (deadline is not None and monotonic() >= deadline)


def _shortest(answer: Answer) -> bool:
    return isinstance(answer, Reached) and answer.shortest


def _looked(answer: Answer, depth: int) -> bool:
    return isinstance(answer, Open) and answer.depth >= depth


def run_turn(
    engine: Engine, question: PortfolioQuestion, limits: Limits, callbacks: Callbacks, goals: Sequence[Var]
) -> dict[str, EngineAnswer]:
    """What one engine says of some goals; nothing, if it fails: the others have their turns all the same."""
    callbacks.progress(Stage(f"{engine.NAME}: searching"))

    def work() -> Mapping[str, Answer]:
        answers = engine.check(question.system, goals, limits, callbacks.progress)
        meant = _without_strays(question, answers) if question.checks else answers
        return {**{goal.name: meant[goal.name] for goal in goals}, **meant}

    meant: Mapping[str, Answer] | Failed
    try:
        meant = attempted(engine.NAME, question.system.name, work)
    except MemoryError:
        meant = Failed(OUT_OF_MEMORY)
    except OSError as error:
        meant = Failed(f"the operating system refuses: {error}")
    if isinstance(meant, Failed):
        meant = {goal.name: Open(meant.reason, 0) for goal in goals}
    return {name: EngineAnswer(answer, engine.NAME) for name, answer in meant.items()}


def _without_strays(question: PortfolioQuestion, answers: Mapping[str, Answer]) -> dict[str, Answer]:
    """The answers, where a run that leaves a domain shows that, and not what it comes to afterwards."""
    meant = dict(answers)
    runs = {goal: answer.run for goal, answer in answers.items() if isinstance(answer, Reached)}
    if runs:
        from rovercheck.checker.verify.runs.domains import stray  # with all that lowers a system
    for goal, run in runs.items():
        found = stray(question.system, run)
        if found is None or goal == found.check.name:
            continue
        meant[goal] = Open(f"the run that was found leaves a domain in tick {found.tick}", 0)
        if not isinstance(meant.get(found.check.name), Reached):
            short = Run(run.frozen, run.inputs[: found.tick])
            meant[found.check.name] = Reached(short, shortest=False)
    return meant


# --- every engine on the same question, and their answers compared -------------------------------------


def compared(question: PortfolioQuestion, limits: Limits, callbacks: Callbacks) -> Found:
    """The best answer to each goal, when all engines have been asked.  Raises ``Disagreement``."""
    by_engine = {}
    for name, engine in engines().items():
        callbacks.on_budget(limits.seconds)
        by_engine[name] = run_turn(engine, question, limits, callbacks, question.goals)
    callbacks.on_budget(limits.seconds)
    goals = {g.name: g for g in question.goals}
    merged: dict[str, EngineAnswer] = {}
    for name, goal in goals.items():
        merged[name] = together(question.system, goal, [found[name] for found in by_engine.values()])
    return merged


def answers(question: PortfolioQuestion, engine: str | Engine, limits: Limits, callbacks: Callbacks) -> Found:
    """An answer for each goal and each check of the system.  Raises ``Disagreement``."""
    found: dict[str, EngineAnswer] = {}
    for more in as_found(question, engine, limits, callbacks):
        found |= more
    return found


def as_found(
    question: PortfolioQuestion, engine: str | Engine, limits: Limits, callbacks: Callbacks
) -> Iterator[Found]:
    """The same answers, each once: runs as they are found, the rest when no more can change.

    That a goal is never reached counts only if the model never leaves a domain; that it does is reported at
    once.
    """
    given: set[str] = set()
    found: Found = {}
    for found in _rounds(question, engine, limits, callbacks):
        new = {n: a for n, a in found.items() if n not in given and _final(question, found, n)}
        given |= new.keys()
        yield from _reported(question, new, callbacks)
    rest = {n: _meant(question, found, n) for n in found if n not in given}
    yield from _reported(question, rest, callbacks)


def _reported(question: PortfolioQuestion, new: Found, callbacks: Callbacks) -> Iterator[Found]:
    if new:
        callbacks.on_answer(question, new)
        yield new


def _rounds(
    question: PortfolioQuestion, engine: str | Engine, limits: Limits, callbacks: Callbacks
) -> Iterator[Found]:
    if engine == AUTO:
        yield from in_turn(question, limits, callbacks)
    elif engine == ALL:
        yield compared(question, limits, callbacks)
    else:
        one = engines()[engine] if isinstance(engine, str) else engine
        callbacks.on_budget(limits.seconds)
        alone = run_turn(one, question, limits, callbacks, question.goals)
        callbacks.on_budget(limits.seconds)
        yield alone


def _final(question: PortfolioQuestion, found: Found, goal: str) -> bool:
    """Whether an answer counts whatever other engines say."""
    answer, _ = found[goal]
    if isinstance(answer, Reached) and goal in {check.name for check in question.checks}:
        return True
    return conclusive(answer) and (isinstance(answer, Reached) or stays(question, found))


def _meant(question: PortfolioQuestion, found: Found, goal: str) -> EngineAnswer:
    """The answer, open if it rests on the model staying in its domains and that is not known."""
    answer, by = found[goal]
    if isinstance(answer, Unreachable):
        for check in question.checks:
            staying = found[check.name][0]
            if isinstance(staying, Open) and goal != check.name:
                reason = f"not reached as long as values stay in their domains; {check.doc}? {staying.reason}"
                return EngineAnswer(Open(reason, staying.depth), by)
    return found[goal]
