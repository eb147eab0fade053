"""The commands of ``rovercheck explore`` that move: on, back, and on to where something happens."""

from rovercheck.checker.commands.explore.explorer import Commands, Explorer
from rovercheck.checker.commands.explore.text import changes, show
from rovercheck.checker.commands.explore.words import count
from rovercheck.checker.explore.by_hand.session import MOST_TICKS
from rovercheck.checker.explore.by_hand.value_syntax import RefusedInput
from rovercheck.spec_model.lang.expr import Expr


def _step(explorer: Explorer, rest: str) -> None:
    explorer.moved(explorer.session.advance(count(rest, 1)))


def _until(explorer: Explorer, rest: str) -> None:
    if not rest:
        raise RefusedInput(f"Write a condition. {explorer.session.names.help}")
    formula = explorer.session.condition(rest)
    ran = explorer.session.advance(MOST_TICKS, formula)
    explorer.moved(ran)
    if not ran.met and not ran.stopped:
        explorer.say(
            f"Not true within {MOST_TICKS:,} ticks with these inputs; that it never is, is not shown."
        )


def _break(explorer: Explorer, rest: str) -> None:
    breaks: list[tuple[str, Expr]] = explorer.session.breaks
    if rest:
        breaks.append((rest, explorer.session.condition(rest)))
    for number, (text, _) in enumerate(breaks, start=1):
        explorer.say(f"break {number}: {text}")
    if not breaks:
        explorer.say("There are no breaks.")


def _clear(explorer: Explorer, rest: str) -> None:
    explorer.session.breaks.clear()
    explorer.session.watched.clear()


def _back(explorer: Explorer, rest: str) -> None:
    explorer.session.goto(max(0, explorer.session.simulation.at - count(rest, 1)))
    show(explorer.console, explorer.session)


def _forward(explorer: Explorer, rest: str) -> None:
    sim = explorer.session.simulation
    first, last = sim.at + 1, min(len(sim), sim.at + count(rest, 1))
    if first > last:
        raise RefusedInput("This is the last tick executed; write step to go on.")
    explorer.session.goto(last)
    changes(explorer.console, explorer.session, first)


def _goto(explorer: Explorer, rest: str) -> None:
    if not rest.isdecimal():
        raise RefusedInput("Write the number of a tick: goto 7")
    explorer.session.goto(int(rest))
    show(explorer.console, explorer.session)


COMMANDS: Commands = {
    "step": ("step [N]", _step, "execute a tick, or N, with the inputs as they stand"),
    "run": ("run N", _step, "the same: N ticks, or up to a break"),
    "until": ("until CONDITION", _until, "execute ticks until the condition is true"),
    "break": ("break [CONDITION]", _break, "stop wherever the condition becomes true; list the breaks"),
    "clear": ("clear", _clear, "forget all breaks and what is watched"),
    "back": ("back [N]", _back, "look at an earlier tick; step then begins a new branch"),
    "forward": ("forward [N]", _forward, "look at a later tick that was executed"),
    "goto": ("goto TICK", _goto, "look at this tick"),
}
