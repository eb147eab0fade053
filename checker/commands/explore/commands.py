"""All commands of ``rovercheck explore``, by name or its beginning, with a sentence of help each."""

from rich.table import Table
from rich.text import Text

from checker.commands.explore import choose as exploring_choosing
from checker.commands.explore import keep as exploring_keeping
from checker.commands.explore import look as exploring_looking
from checker.commands.explore import move as exploring_moving
from checker.commands.explore.explorer import Commands, Explorer
from checker.commands.shared.tables import laid
from checker.explore.by_hand.written import RefusedInput
from spec_model.lang.errors import did_you_mean


class Quit(Exception):
    """The session is over."""


ALIASES = {"?": "help", "exit": "quit"}
"""What other programs call them."""


def obey(explorer: Explorer, line: str) -> None:
    """Do what a line says.  Raises ``RefusedInput`` for what is not possible, and ``Quit``."""
    word, _, rest = line.partition("#")[0].strip().partition(" ")
    if word:
        _, command, _ = COMMANDS[named(word)]
        command(explorer, rest.strip())


def completions(explorer: Explorer, begun: str) -> list[str]:
    """What a word that was begun may become."""
    sim = explorer.session.simulation
    known = (*COMMANDS, *sim.variables, *explorer.session.names.states)
    return [word for word in known if word.startswith(begun)]


def named(word: str) -> str:
    """The name of the command meant by it or the beginning of it.  Raises ``RefusedInput``."""
    word = ALIASES.get(word, word)
    found = [word] if word in COMMANDS else [name for name in COMMANDS if name.startswith(word)]
    if len(found) == 1:
        return found[0]
    if found:
        raise RefusedInput(f"{word!r} may be {' or '.join(found)}; write more of it.")
    raise RefusedInput(
        f"There is no command {word!r}. {did_you_mean(word, COMMANDS)} Write help for all of them."
    )


def _help(explorer: Explorer, rest: str) -> None:
    chosen = [named(rest)] if rest else list(COMMANDS)
    table = Table.grid(padding=(0, 2))
    table.add_column(no_wrap=True)
    table.add_column(ratio=1)
    for name in chosen:
        usage, _, meaning = COMMANDS[name]
        table.add_row(Text(usage, style="bold"), meaning)
    laid(explorer.console, table)
    if len(chosen) > 1:
        explorer.say(
            "The beginning of a command will do. Ctrl-C clears the line or ends a run, Ctrl-D quits."
        )


def _quit(explorer: Explorer, rest: str) -> None:
    raise Quit


COMMANDS: Commands = {
    **exploring_moving.COMMANDS,
    **exploring_choosing.COMMANDS,
    **exploring_looking.COMMANDS,
    **exploring_keeping.COMMANDS,
    "help": ("help [COMMAND]", _help, "this list"),
    "quit": ("quit", _quit, "end the session"),
}
