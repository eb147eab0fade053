"""The commands of ``rovercheck explore`` about what can come: possible next steps, a run to a condition."""

from collections.abc import Sequence
from contextlib import closing
from typing import TYPE_CHECKING

from rich.table import Table
from rich.text import Text

from rovercheck.checker.commands.explore.explorer import Commands, Explorer
from rovercheck.checker.commands.explore.text import listed
from rovercheck.checker.commands.explore.words import split
from rovercheck.checker.commands.shared.output import counted
from rovercheck.checker.commands.shared.tables import laid
from rovercheck.checker.engines import Limits
from rovercheck.checker.explore.by_hand.value_syntax import RefusedInput
from rovercheck.checker.results.trace import Trace

if TYPE_CHECKING:  # it loads a solver
    from rovercheck.checker.explore.by_hand.next_steps import NextSteps, PossibleStep


def _next(explorer: Explorer, rest: str) -> None:
    session = explorer.session
    words = split(rest)
    steps = session.next_steps()
    if not words or words == ["all"]:
        _list(explorer, steps, everything=bool(words))
        return
    chosen = [_numbered(steps, word) for word in words]
    explorer.moved(session.take(session.both(chosen) if chosen[1:] else chosen[0], chosen))


def _numbered(steps: "NextSteps", word: str) -> "PossibleStep":
    count = len(steps.steps)
    if not count:
        raise RefusedInput(
            "There is nothing to choose: the next tick is the same with all inputs; write step."
        )
    if not word.isdecimal() or not 1 <= int(word) <= count:
        raise RefusedInput(
            f"There is no next step {word}; write next 1 to next {count}, or next for the list."
        )
    return steps.steps[int(word) - 1]


def _list(explorer: Explorer, steps: "NextSteps", *, everything: bool) -> None:
    sim = explorer.session.simulation
    trace = sim.trace(max(sim.at, 1))
    for problem in (*steps.problems, *steps.bounded):
        explorer.say(problem, "yellow")
    shown = [one for one in enumerate(steps.steps, start=1) if everything or one[1].moves]
    shown = shown or list(enumerate(steps.steps, start=1))
    table = Table.grid(padding=(0, 1))
    table.add_column(justify="right", no_wrap=True, width=4)
    table.add_column(ratio=1)
    for number, step in shown:
        table.add_row(str(number), Text(step.title, style="bold" if step.moves else ""))
        for line, style in _lines(trace, step):
            table.add_row("", Text(f"  {line}", style=style))
    laid(explorer.console, table)
    if not steps.steps and not steps.problems:
        explorer.say("Whatever the inputs are, the next tick takes the same transitions; write step.")
    elif left := len(steps.steps) - len(shown):
        explorer.say(f"{counted(left, 'step', 'steps')} more that keep every state: next all", "dim")
    if len({step.of for step in steps.steps}) > 1:
        explorer.say("Each is what one chart can do; next 1 2 takes what two of them do together.", "dim")


def _lines(trace: Trace, step: "PossibleStep") -> Sequence[tuple[str, str]]:
    """What there is to say below a step: guards, inputs, what else happens."""
    labels = [t.label for t in step.transitions if t.label]
    given = {n: step.inputs.get(n, step.frozen.get(n, 0)) for n in step.changed}
    by = f"by {listed(trace, given)}" if given else "with the inputs as they stand"
    also = [f"also {t.chart}: {t.source or 'default'} → {t.target}" for t in step.also]
    return [*((label, "dim") for label in labels), (by, "cyan"), *((line, "green") for line in also)]


def _reach(explorer: Explorer, rest: str) -> None:
    from rovercheck.checker.explore.reach import (
        SECONDS,
        NeverReached,
        NotDecided,
        ReachAnswer,
        RunFound,
        reach,
    )

    session, sim = explorer.session, explorer.session.simulation
    if not rest:
        raise RefusedInput(f"Write a condition. {session.names.help}")
    formula = session.condition(rest)
    search = reach(sim.system, sim.state(), formula, Limits(seconds=SECONDS), first=not sim.at)
    answer: ReachAnswer | str | None = None
    with explorer.console.status("searching ...") as status, closing(search):
        for answer in search:
            if isinstance(answer, str):
                status.update(answer)
    if isinstance(answer, RunFound):
        explorer.moved(session.follow(answer.run.frozen, answer.run.inputs))
        ticks = counted(len(answer.run), "tick", "ticks")
        shortest = "none is shorter" if answer.shortest else "there may be a shorter one"
        explorer.say(f"Reached in {ticks} by a run that {answer.engine} found; {shortest}.", "bold")
    elif isinstance(answer, NeverReached):
        explorer.say(f"Never, from here: {answer.how} ({answer.engine}).", "bold")
    else:
        assert isinstance(answer, NotDecided), "a search ends with an answer"
        explorer.say(f"Not decided: {answer.reason}", "yellow")


COMMANDS: Commands = {
    "next": ("next [N ...|all]", _next, "what each chart can do in the next tick, by which inputs; take it"),
    "reach": ("reach CONDITION", _reach, "have an engine search a run from here to the condition"),
}
