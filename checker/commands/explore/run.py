"""``rovercheck explore``: a system stepped through at a prompt, or by a script of the same commands."""

import shlex
import signal
import sys
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from functools import partial
from pathlib import Path
from types import FrameType
from typing import NoReturn

from rich.table import Table
from rich.text import Text

from rovercheck.checker.commands.explore import choose as exploring_choosing
from rovercheck.checker.commands.explore import keep as exploring_keeping
from rovercheck.checker.commands.explore import look as exploring_looking
from rovercheck.checker.commands.explore import move as exploring_moving
from rovercheck.checker.commands.explore import next as exploring_ahead
from rovercheck.checker.commands.explore.explorer import Commands, Explorer
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import out
from rovercheck.checker.commands.shared.select import pick
from rovercheck.checker.commands.shared.tables import laid
from rovercheck.checker.commands.shared.text_wrap import filled, whole
from rovercheck.checker.explore.by_hand.session import Session
from rovercheck.checker.explore.by_hand.value_syntax import RefusedInput
from rovercheck.checker.model.variant import Variant
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean
from rovercheck.spec_model.lang.system import System, chart_alone, charts_of

# --- all commands of rovercheck explore, by name or its beginning, with a sentence of help each --------


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
    **exploring_ahead.COMMANDS,
    **exploring_choosing.COMMANDS,
    **exploring_looking.COMMANDS,
    **exploring_keeping.COMMANDS,
    "help": ("help [COMMAND]", _help, "this list"),
    "quit": ("quit", _quit, "end the session"),
}


def explore(name: str | None, variant: Variant, traced: str | None, script: Path | None) -> Exit:
    """Run a session.  Raises ``UsageError`` for a name that is none, and a bad command of a script."""
    by_name = variant.systems()
    if name is None and traced is None and len(by_name) == 1:
        [name] = by_name
    if name is None and traced is None:
        return _offer(by_name)
    prop = pick("property", traced, variant.properties()) if traced else None
    system = by_name[prop.on] if name is None and prop else _system(name or "", by_name)
    explorer = Explorer(Session(system), variant, out)
    explorer.introduce()
    if traced:
        _first(explorer, f"trace {shlex.quote(traced)}")
    if script is not None:
        return _scripted(explorer, _read(script))
    if sys.stdin is not None and sys.stdin.isatty():
        return _from_terminal(explorer)
    return _scripted(explorer, sys.stdin or ())


def _system(name: str, by_name: Mapping[str, System]) -> System:
    """The system of that name, or a chart alone: all that it reads is then an input."""
    if name in by_name:
        return by_name[name]
    charts: Mapping[str, Chart] = charts_of(by_name)
    known: dict[str, Chart | None] = {**dict.fromkeys(by_name), **charts}
    found = pick("chart or system", name, known)
    assert found is not None, "systems were looked for before"
    return chart_alone(found, by_name, notes=("The chart alone: all it reads is an input.",))


def _offer(by_name: Mapping[str, System]) -> Exit:
    """What can be explored."""
    for title, names in (("Charts, each alone", charts_of(by_name)), ("Systems", by_name)):
        out.print(f"{title}:", style="bold")
        listed = filled(", ".join(names), min(out.width, 100), "  ", "  ")
        out.print(listed, markup=False)
    systems, charts, begin = (
        whole(f"rovercheck {words}") for words in ("list systems", "list charts", "explore NAME")
    )
    out.print(f"What each is: {systems}; {charts}. Begin: {begin}")
    return Exit.AS_EXPECTED


def _read(script: Path) -> list[str]:
    try:
        return script.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise UsageError(f"Cannot read {whole(script)}: {error}") from None


def _first(explorer: Explorer, line: str) -> None:
    try:
        obey(explorer, line)
    except (RefusedInput, ModelError) as error:
        raise UsageError(str(error)) from None


def _scripted(explorer: Explorer, lines: Iterable[str]) -> Exit:
    """Obey commands, each shown as if it had been typed, up to the first that has no meaning."""
    for number, line in enumerate(lines, start=1):
        out.print(f"{explorer.prompt}{line.rstrip()}", markup=False)
        try:
            obey(explorer, line)
        except Quit:
            break
        except (RefusedInput, ModelError, UsageError) as error:
            raise UsageError(f"Line {number}, {line.strip()!r}: {error}") from None
    return Exit.AS_EXPECTED


def _from_terminal(explorer: Explorer) -> Exit:
    """Obey commands from a terminal until there are no more, or somebody wants the program to end."""
    _line_editing(partial(completions, explorer))
    _end_on_signal()
    while True:
        try:
            obey(explorer, input(explorer.prompt))
        except (EOFError, Quit):
            out.print()
            return Exit.AS_EXPECTED
        except KeyboardInterrupt:
            out.print("\nInterrupted; quit or Ctrl-D ends.")
        except (RefusedInput, ModelError, UsageError) as error:
            explorer.say(str(error), "red")


def _end_on_signal() -> None:
    """A request to end is no Ctrl-C here, which only clears the line."""
    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) is not signal.SIG_IGN:  # not under nohup
            signal.signal(number, _ended)


def _ended(number: int, _: FrameType | None) -> NoReturn:
    out.print()  # what follows, a shell's prompt perhaps, begins a line
    raise SystemExit


def _line_editing(completions: Callable[[str], list[str]]) -> None:
    """History and completion with the tabulator, where Python has readline."""
    with suppress(ImportError):
        import readline

        def complete(begun: str, count: int) -> str | None:
            found = completions(begun)
            return found[count] if count < len(found) else None

        readline.set_completer(complete)
        readline.set_completer_delims(" =\t\n")
        readline.parse_and_bind("tab: complete")
