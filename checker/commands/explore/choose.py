"""The commands of ``rovercheck explore`` that choose inputs and frozen values."""

from rovercheck.checker.commands.explore.explorer import Commands, Explorer
from rovercheck.checker.commands.explore.words import pairs, split
from rovercheck.checker.explore.by_hand.value_syntax import RefusedInput


def _set(explorer: Explorer, rest: str) -> None:
    explorer.session.set(pairs(rest))


def _free(explorer: Explorer, rest: str) -> None:
    session = explorer.session
    session.let_run(split(rest))
    explorer.say(f"Free: {', '.join(sorted(session.free)) or 'none; write free NAME, or random'}")


def _random(explorer: Explorer, rest: str) -> None:
    if rest and not rest.isdecimal():
        raise RefusedInput(f"{rest!r} is no seed; write a whole number, or none for 0.")
    session = explorer.session
    session.let_run(session.simulation.inputs, int(rest or "0"))
    explorer.say(f"All inputs run free, seed {session.seed}; set NAME=VALUE holds one again, and hold all.")


def _hold(explorer: Explorer, rest: str) -> None:
    explorer.session.hold()


def _fixed(explorer: Explorer, rest: str) -> None:
    for name, written in pairs(rest):
        explorer.session.fix(name, written)


COMMANDS: Commands = {
    "set": ("set NAME=VALUE ...", _set, "let inputs stand at these values, from the next tick on"),
    "free": ("free NAME ...", _free, "draw these inputs at random, as the assumptions allow"),
    "random": ("random [SEED]", _random, "draw all inputs at random; the same seed, the same run"),
    "hold": ("hold", _hold, "let all inputs stand as they are"),
    "fixed": ("fixed NAME=VALUE", _fixed, "choose a frozen value, before the first tick"),
}
