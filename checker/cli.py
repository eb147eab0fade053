"""The command line: the verbs in ``checker.commands``, and the one place where errors become exit codes."""

import gc
import importlib
import os
import pkgutil
import sys
from collections.abc import Iterator, MutableMapping
from contextlib import suppress
from pathlib import Path

import click

from rovercheck.checker import commands
from rovercheck.checker.commands.shared.aliases import current
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.completion import completed
from rovercheck.checker.commands.shared.failure import alarm, code_of, error_message, no_room
from rovercheck.checker.commands.shared.help_examples import helped
from rovercheck.checker.process.faults import Fault, listening
from rovercheck.checker.process.garbage import collect_seldom
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean

CODES = (
    "Exit codes: 0 all as expected; 1 a violation, or an expected violation that is gone; "
    "2 inconclusive, or no room for the output; 3 internal error, engines disagree or a proof is rejected; "
    "4 usage or model error; 5 nothing to check; 130 interrupted."
)

EPILOG = f"""\b
Begin:
  rovercheck init heater        a small model of your own
  rovercheck check --help       what a verb does, with examples
  rovercheck doctor             whether everything works here

{CODES}"""


class Verbs(click.Group):
    """A group that takes old words for new ones, and offers the nearest verb."""

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        args, renamed = current(args)
        if renamed and not ctx.resilient_parsing:
            _note(renamed)
        if self.get_command(ctx, args[0]) is None:
            ctx.fail(f"No such command {args[0]!r}. {did_you_mean(args[0], self.commands)}")
        return super().resolve_command(ctx, args)


class VerbTable(MutableMapping[str, click.Command]):
    """The verbs by name: each a module of the folder ``commands``, loaded when the verb is asked for."""

    def __init__(self) -> None:
        found = (entry.name for entry in pkgutil.iter_modules(commands.__path__))
        self._modules = {name.rstrip("_").replace("_", "-"): name for name in found if name != "shared"}
        self._loaded: dict[str, click.Command] = {}

    def __getitem__(self, name: str) -> click.Command:
        if name not in self._loaded:
            module = importlib.import_module(f"{commands.__name__}.{self._modules[name]}")
            [verb] = [thing for thing in vars(module).values() if isinstance(thing, click.Command)]
            self._loaded[name] = helped(completed(verb))
        return self._loaded[name]

    def __setitem__(self, name: str, verb: click.Command) -> None:
        self._modules.setdefault(name, name)
        self._loaded[name] = verb

    def __delitem__(self, name: str) -> None:
        del self._modules[name]
        self._loaded.pop(name, None)

    def __iter__(self) -> Iterator[str]:
        return iter(self._modules)

    def __len__(self) -> int:
        return len(self._modules)


@click.group(
    cls=Verbs, commands=VerbTable(), epilog=EPILOG, context_settings={"help_option_names": ["-h", "--help"]}
)
@click.version_option(None, "-V", "--version", package_name="rovercheck", message="%(prog)s %(version)s")
def app() -> None:
    """Check the rover's supervisors: charts, properties, verdicts with evidence."""


helped(app)


def main() -> None:
    """Run the command line; every error becomes one message and a documented exit code."""
    collect_seldom()
    code = run(sys.argv[1:])
    gc.freeze()  # or Python would look through all formulas once more before it ends
    sys.exit(int(code))


def run(arguments: list[str]) -> Exit:
    """The exit code of a command line; messages go to standard error."""
    met: list[Fault] = []
    with listening(met.append):
        code = _run(arguments)
    for text in dict.fromkeys(map(alarm, met)):
        _end(text, Exit.INTERNAL)
    return Exit.INTERNAL if met and code is not Exit.INTERRUPTED else code


def _run(arguments: list[str]) -> Exit:
    try:
        code: object = app.main(arguments, prog_name="rovercheck", standalone_mode=False, obj=arguments)
        if sys.stdout is not None:
            sys.stdout.flush()
        return code if isinstance(code, Exit) else Exit.AS_EXPECTED
    except click.ClickException as error:
        return _end(error.format_message(), Exit.USAGE)
    except (UsageError, ModelError) as error:
        return _end(str(error), Exit.INCONCLUSIVE if no_room(error) else Exit.USAGE)
    except (KeyboardInterrupt, click.Abort):
        return _end("Interrupted; nothing was written.", Exit.INTERRUPTED)
    except (BrokenPipeError, SystemExit):  # click makes some of the first into the second
        # Nobody has seen all verdicts: this is no pass, and no violation either.
        _write_no_more()
        return Exit.INTERRUPTED
    except OSError as error:
        _write_no_more()
        return _end(error_message(error), Exit.INCONCLUSIVE)
    except MemoryError as error:
        return _end(error_message(error), Exit.INCONCLUSIVE)
    except Exception as error:
        return _end(_internal(error, arguments), code_of(error))


def _internal(error: Exception, arguments: list[str]) -> str:
    """What is said of an internal error; what shows that an engine is wrong is kept."""
    from rovercheck.checker.verify.portfolio import Disagreement

    if not isinstance(error, Disagreement):
        return error_message(error)
    from rovercheck.checker.commands.shared.disagreement import again, bundle

    try:
        kept = f"All of it is in {bundle(error, again(error, arguments), Path())}; please report it."
    except UsageError as problem:
        kept = str(problem)
    return f"{error_message(error)} {kept}"


def _end(message: str, code: Exit) -> Exit:
    _note(message)
    return code


def _note(message: str) -> None:
    from rovercheck.checker.commands.shared.output import err

    with suppress(OSError):  # the exit code says what matters
        err.print(message, markup=False)


def _write_no_more() -> None:
    """Let go of what is still to be written, which Python would try once more at its end."""
    with suppress(AttributeError, OSError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
