"""``rovercheck explore``: a system stepped through at a prompt, or by a script of the same commands."""

import shlex
import sys
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from pathlib import Path
from textwrap import fill

from checker.commands.codes import Exit, UsageError
from checker.commands.exploring_commands import Commands, Quit
from checker.commands.output import out
from checker.commands.select import pick
from checker.commands.variant import Variant
from checker.exploring.session import Session
from checker.exploring.simulation import Refused
from spec_model.lang.chart import Chart
from spec_model.lang.errors import ModelError
from spec_model.lang.system import System, in_order
from spec_model.rover import charts_of


def explore(name: str | None, variant: Variant, traced: str | None, script: Path | None) -> Exit:
    """Run a session.  Raises ``UsageError`` for a name that is none, and a bad command of a script."""
    by_name = variant.systems()
    if name is None and traced is None:
        return _offer(by_name)
    prop = pick("property", traced, variant.properties()) if traced else None
    system = by_name[prop.on] if name is None and prop else _system(name or "", by_name)
    commands = Commands(Session(system), variant, out)
    commands.introduce()
    if traced:
        _first(commands, f"trace {shlex.quote(traced)}")
    if script is not None:
        return _scripted(commands, _read(script))
    if sys.stdin is not None and sys.stdin.isatty():
        return _asked(commands)
    return _scripted(commands, sys.stdin or ())


def _system(name: str, by_name: Mapping[str, System]) -> System:
    """The system of that name, or a chart alone: all that it reads is then an input."""
    if name in by_name:
        return by_name[name]
    charts: Mapping[str, Chart] = charts_of(by_name)
    known: dict[str, Chart | None] = {**dict.fromkeys(by_name), **charts}
    found = pick("chart or system", name, known)
    assert found is not None, "systems were looked for before"
    return in_order(found.name, found, text=found.text, notes=("The chart alone: all it reads is an input.",))


def _offer(by_name: Mapping[str, System]) -> Exit:
    """What can be explored."""
    for title, names in (("Charts, each alone", charts_of(by_name)), ("Systems", by_name)):
        out.print(f"{title}:", style="bold")
        listed = fill(", ".join(names), min(out.width, 100), initial_indent="  ", subsequent_indent="  ")
        out.print(listed, markup=False)
    out.print("What each is: rovercheck list systems; rovercheck list charts. Begin: rovercheck explore NAME")
    return Exit.AS_EXPECTED


def _read(script: Path) -> list[str]:
    try:
        return script.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise UsageError(f"Cannot read {script}: {error}") from None


def _first(commands: Commands, line: str) -> None:
    try:
        commands.obey(line)
    except (Refused, ModelError) as error:
        raise UsageError(str(error)) from None


def _scripted(commands: Commands, lines: Iterable[str]) -> Exit:
    """Obey commands, each shown as if it had been typed, up to the first that has no meaning."""
    for number, line in enumerate(lines, start=1):
        out.print(f"{commands.prompt}{line.rstrip()}", markup=False)
        try:
            commands.obey(line)
        except Quit:
            break
        except (Refused, ModelError, UsageError) as error:
            raise UsageError(f"Line {number}, {line.strip()!r}: {error}") from None
    return Exit.AS_EXPECTED


def _asked(commands: Commands) -> Exit:
    """Obey commands from a terminal until there are no more."""
    _line_editing(commands.completions)
    while True:
        try:
            commands.obey(input(commands.prompt))
        except (EOFError, Quit):
            out.print()
            return Exit.AS_EXPECTED
        except KeyboardInterrupt:
            out.print("\nInterrupted; quit or Ctrl-D ends.")
        except (Refused, ModelError, UsageError) as error:
            commands.say(str(error), "red")


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
