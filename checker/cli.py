"""The command line: every verb, and the one place where errors become exit codes."""

import gc
import os
import signal
import sys
from contextlib import suppress
from pathlib import Path

import click

from checker.commands.codes import Exit, UsageError
from checker.commands.options import GIB, SECONDS, searching, varying, writing
from checker.commands.output import err
from checker.decide import ALL, AUTO, Disagreement
from checker.engine import Limits, Timers
from checker.isolate import collect_seldom, prepared
from checker.runs.replay import ReplayError
from spec_model.lang.errors import ModelError, did_you_mean

CODES = (
    "Exit codes: 0 all as expected; 1 a violation, or an expected violation that is gone; "
    "2 inconclusive; 3 internal error, engines disagree or a proof is rejected; 4 usage or model error; "
    "5 nothing to check; 130 interrupted."
)
ROOM = "Make room for it, or write elsewhere, and run the command again."
LISTS = ("properties", "systems", "charts", "requirements", "readings", "repairs", "assumptions", "engines")


class Verbs(click.Group):
    """A group that offers the nearest verb."""

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        if self.get_command(ctx, args[0]) is None:
            ctx.fail(f"No such command {args[0]!r}. {did_you_mean(args[0], self.commands)}")
        return super().resolve_command(ctx, args)


@click.group(cls=Verbs, epilog=CODES, context_settings={"help_option_names": ["-h", "--help"]})
def app() -> None:
    """Check the rover's supervisors: charts, properties, verdicts with evidence."""


@app.command()
@click.argument("ids", nargs=-1, metavar="[ID]...")
@click.option("--system", metavar="NAME", help="Only properties about this system.")
@click.option("--full", is_flag=True, help="Also the properties that take long.")
@click.option("--json", "as_json", is_flag=True, help="Verdicts as JSON.")
@click.option(
    "--jobs",
    type=click.IntRange(min=1),
    metavar="N",
    help="Searches at a time; by default one per processor.",
)
@click.option(
    "--memory",
    type=GIB,
    default=8.0,
    show_default=True,
    metavar="GIB",
    help="What each search may take.",
)
@click.option("--all-engines", is_flag=True, help="Ask every engine and compare the answers.")
@click.option("--certify", is_flag=True, help="Check every proof again, without the engine that found it.")
@click.option(
    "--certificates",
    type=click.Path(file_okay=False, path_type=Path),
    metavar="DIR",
    help="Write the proofs into this folder.",
)
@varying
@searching
def check(
    ids: tuple[str, ...],
    system: str | None,
    full: bool,
    as_json: bool,
    jobs: int | None,
    memory: float,
    all_engines: bool,
    certify: bool,
    certificates: Path | None,
    chosen: tuple[str, ...],
    repair: str | None,
    dropped: tuple[str, ...],
    engine: str,
    depth: int | None,
    timeout: float | None,
    timers: str,
) -> Exit:
    """Check properties and compare the verdicts with the baseline."""
    with prepared("checker.searches"):
        from checker.commands.check import check as run
        from checker.commands.select import pick_engine, pick_properties
        from checker.commands.variant import pick_variant

        variant = pick_variant(chosen, repair, dropped)
        properties = pick_properties(ids, system, variant.properties(), full)
        if variant.name and not ids:
            properties = list(filter(variant.concerns(), properties))
        if variant.name:
            properties = variant.askable(properties)
        limits = Limits(depth, timeout, int(memory * 2**30), timers=Timers(timers))
        asked = _asked(pick_engine(engine), all_engines)
        certifying = variant.certifying(certificates, certify) if certify or certificates else None
        return run(
            properties,
            variant.systems(),
            asked,
            limits,
            as_json,
            variant.name,
            variant.expected,
            jobs,
            certifying,
        )


def _asked(engine: str, every: bool) -> str:
    """The engines to ask.  Raises ``UsageError`` when one is named and every engine wanted."""
    if every and engine not in (AUTO, ALL):
        raise UsageError(f"--engine {engine} asks one engine and --all-engines every one; write one of them.")
    return ALL if every else engine


@app.command(short_help="Check certificates of proofs again.")
@click.argument("paths", nargs=-1, required=True, metavar="FILE|DIR...", type=click.Path(path_type=Path))
@click.option(
    "--solver",
    type=click.Choice(["bitwuzla", "enumeration", "both"]),
    default="both",
    show_default=True,
    help="Who checks; both: enumeration as well where few ticks are to be tried.",
)
@click.option("--smt2", type=click.Path(path_type=Path), metavar="DIR", help="Write the obligations there.")
@click.option("--timeout", type=SECONDS, metavar="SEC", help="Seconds per certificate.")
@click.option("--verbose", "-v", is_flag=True, help="The whole valuation that refutes a certificate.")
def certify(
    paths: tuple[Path, ...], solver: str, smt2: Path | None, timeout: float | None, verbose: bool
) -> Exit:
    """Check the certificates of proofs again, by other means than found them."""
    from checker.certify.check import By, Effort
    from checker.commands.certifying import certify as run

    return run(paths, Effort(By(solver), timeout), smt2, verbose)


@app.command("list", short_help="List properties, systems, engines and so on.")
@click.argument("what", type=click.Choice(LISTS), metavar="WHAT")
@click.argument("ids", nargs=-1, metavar="[ID]...")
@click.option("--english", is_flag=True, help="What is checked of each property, in words.")
def list_(what: str, ids: tuple[str, ...], english: bool) -> Exit:
    """List WHAT: properties, systems, charts, requirements, readings, repairs, assumptions or engines."""
    from checker.commands.listing import listing

    return listing(what, ids, english)


@app.command(short_help="Show which properties cover each requirement.")
@click.option("--check", "decide", is_flag=True, help="Decide the verdicts now, instead of the baseline's.")
@click.option("--json", "as_json", is_flag=True, help="The matrix as JSON.")
def requirements(decide: bool, as_json: bool) -> Exit:
    """Show which properties cover each requirement; exit code 1 if none does and no reason is given."""
    from checker.commands.requirements import requirements as run

    return run(decide, as_json)


@app.command(short_help="Show a counterexample or a witness, tick by tick.")
@click.argument("id")
@click.option(
    "--format", default="table", show_default=True, metavar="FORMAT", help="table, markdown, json or vcd."
)
@click.option("--all", "everything", is_flag=True, help="Also what the property does not depend on.")
@varying
@searching
@writing
def trace(
    id: str,
    format: str,
    everything: bool,
    chosen: tuple[str, ...],
    repair: str | None,
    dropped: tuple[str, ...],
    engine: str,
    depth: int | None,
    timeout: float | None,
    timers: str,
    output: Path | None,
) -> Exit:
    """Show the counterexample of a violated property, or the witness of a reachable one."""
    from checker.commands.select import pick, pick_engine
    from checker.commands.tracing import trace as run
    from checker.commands.variant import pick_variant

    variant = pick_variant(chosen, repair, dropped)
    prop = pick("property", id, variant.properties())
    limits = Limits(depth, timeout, timers=Timers(timers))
    return run(prop, variant.systems(), pick_engine(engine), limits, format, everything, output)


@app.command(short_help="Draw a chart, or the reachable states of a system.")
@click.argument("name")
@click.option("--project", metavar="VAR,VAR", help="Variables of the state graph of a system.")
@click.option(
    "--format", default="svg", show_default=True, metavar="FORMAT", help="svg, dot, mermaid, graphml or json."
)
@varying
@writing
def graph(
    name: str,
    project: str | None,
    format: str,
    chosen: tuple[str, ...],
    repair: str | None,
    dropped: tuple[str, ...],
    output: Path | None,
) -> Exit:
    """Draw a chart, or the reachable graph of a system projected on some variables."""
    from checker.commands.graphing import graph as run
    from checker.commands.variant import pick_variant

    return run(name, project, format, pick_variant(chosen, repair, dropped).systems(), output)


@app.command(short_help="Write properties for other model checkers.")
@click.argument("ids", nargs=-1, metavar="PROPERTY...")
@click.option(
    "--system", metavar="NAME", help="Only properties about this system; all of them if none is named."
)
@click.option(
    "--format",
    default="aiger",
    show_default=True,
    metavar="FORMAT",
    help="aiger, aag, btor2, smv or promela.",
)
@varying
@writing
def export(
    ids: tuple[str, ...],
    system: str | None,
    format: str,
    chosen: tuple[str, ...],
    repair: str | None,
    dropped: tuple[str, ...],
    output: Path | None,
) -> Exit:
    """Write properties for other model checkers: a file, or a folder of them."""
    from checker.commands.exporting import export as run
    from checker.commands.variant import pick_variant

    return run(ids, system, format, pick_variant(chosen, repair, dropped), output)


@app.command(short_help="Run both boards in a scenario, and draw the run.")
@click.argument("scenario", type=click.Path(path_type=Path))
@click.option("--log", type=click.Path(path_type=Path), metavar="DIR", help="Write every step there, as CSV.")
@click.option("--no-plot", is_flag=True, help="Draw nothing.")
@writing
def simulate(scenario: Path, log: Path | None, no_plot: bool, output: Path | None) -> Exit:
    """Run both boards in the scenario of a TOML file; exit code 1 if it goes other than expected."""
    from checker.commands.simulating import simulate as run

    return run(scenario, output, log, not no_plot)


@app.command(short_help="Check logs recorded on a board.")
@click.argument("place", type=click.Path(exists=True, path_type=Path), metavar="LOG|DIR")
@click.option(
    "--map",
    "map_file",
    type=click.Path(path_type=Path),
    metavar="MAP.toml",
    help="What the columns are (docs/conform.md).",
)
@click.option("--system", metavar="NAME", help="The board: board1 or board2; by default the columns tell.")
@click.option("--json", "as_json", is_flag=True, help="The results as JSON.")
@click.option("--verbose", "-v", is_flag=True, help="Every property, also those that say nothing.")
def conform(place: Path, map_file: Path | None, system: str | None, as_json: bool, verbose: bool) -> Exit:
    """Check a log, or all logs of a folder: every property as a monitor, and as a run of the charts."""
    from checker.commands.conforming import conform as run

    return run(place, map_file, system, as_json, verbose)


@app.command(short_help="Compare a supervisor with the charts, step by step.")
@click.option("--system", metavar="NAME", help="The board: board1 or board2; by default both.")
@click.option("--impl", metavar="KIND:WHAT", help="Its supervisor; by default that of the project.")
@click.option(
    "--profile", type=click.Choice(["ci", "nightly"]), default="ci", show_default=True, help="How long."
)
@click.option("--examples", type=click.IntRange(min=0), metavar="N", help="Random runs on each board.")
@click.option("--seed", type=click.IntRange(min=0), metavar="S", help="Draw the runs of this number.")
@click.option(
    "--tests", type=click.Path(path_type=Path), metavar="DIR", help="Also the tests there, as CSV or JSON."
)
@click.option("--json", "as_json", is_flag=True, help="The results as JSON.")
@click.option(
    "--output",
    "-o",
    type=click.Path(file_okay=False, path_type=Path),
    metavar="DIR",
    help="Write a test for each mismatch there, not here.",
)
def crosscheck(
    system: str | None,
    impl: str | None,
    profile: str,
    examples: int | None,
    seed: int | None,
    tests: Path | None,
    as_json: bool,
    output: Path | None,
) -> Exit:
    """Run a supervisor and the charts side by side; exit code 1 where they differ."""
    from checker.commands.crosschecking import Asked
    from checker.commands.crosschecking import crosscheck as run

    return run(Asked(system, impl, profile, examples, seed, tests), output, as_json)


@app.command(short_help="Write the evidence: verdicts, diagrams, findings.")
@click.option("--stale", is_flag=True, help="Write nothing; say what is out of date (exit code 1).")
@writing
def reports(stale: bool, output: Path | None) -> Exit:
    """Write the evidence: verdict table, diagrams, a page per counterexample."""
    from checker.commands.reporting import reports as run

    return run(output or Path("reports"), stale)


def main() -> None:
    """Run the command line; every error becomes one message and a documented exit code."""
    collect_seldom()
    _stop_as_on_ctrl_c()
    code = run(sys.argv[1:])
    gc.freeze()  # or Python would look through all formulas once more before it ends
    sys.exit(int(code))


def _stop_as_on_ctrl_c() -> None:
    """When told to end, or left by the terminal, say what was found and leave no search behind."""
    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) is signal.SIG_DFL:  # not under nohup
            signal.signal(number, signal.default_int_handler)


def run(arguments: list[str]) -> Exit:
    """The exit code of a command line; messages go to standard error."""
    try:
        code: object = app.main(arguments, prog_name="rovercheck", standalone_mode=False)
        if sys.stdout is not None:
            sys.stdout.flush()
        return code if isinstance(code, Exit) else Exit.AS_EXPECTED
    except click.ClickException as error:
        return _say(error.format_message(), Exit.USAGE)
    except (UsageError, ModelError) as error:
        return _say(str(error), Exit.USAGE)
    except ReplayError as error:
        return _say(f"INTERNAL: {error}", Exit.INTERNAL)
    except Disagreement as error:
        return _disagreeing(error, arguments)
    except (KeyboardInterrupt, click.Abort):
        return _say("Interrupted; nothing was written.", Exit.INTERRUPTED)
    except (BrokenPipeError, SystemExit):  # click makes some of the first into the second
        # Nobody has seen all verdicts: this is no pass, and no violation either.
        _write_no_more()
        return Exit.INTERRUPTED
    except OSError as error:
        _write_no_more()
        return _say(f"The operating system refuses: {error}. {ROOM}", Exit.INCONCLUSIVE)
    except MemoryError:
        return _say("Out of memory. Check fewer properties at once, or one --system.", Exit.INCONCLUSIVE)
    except Exception as error:
        return _say(f"INTERNAL: {type(error).__name__}: {error}. {_where(error)}", Exit.INTERNAL)


def _disagreeing(error: Disagreement, arguments: list[str]) -> Exit:
    """Keep what shows that an engine is wrong."""
    from checker.commands.disagreeing import again, bundle

    try:
        kept = f"All of it is in {bundle(error, again(error, arguments), Path())}; please report it."
    except UsageError as problem:
        kept = str(problem)
    return _say(f"INTERNAL: {error} At least one engine is wrong. {kept}", Exit.INTERNAL)


def _where(error: Exception) -> str:
    """Where an error of ours arose, for the report of it."""
    last = error.__traceback__
    while last is not None and last.tb_next is not None:
        last = last.tb_next
    place = "" if last is None else f" ({last.tb_frame.f_globals.get('__name__')}, line {last.tb_lineno})"
    return f"This is a bug of rovercheck{place}; please report it with the command and the model."


def _say(message: str, code: Exit) -> Exit:
    with suppress(OSError):  # the code says it too
        err.print(message, markup=False)
    return code


def _write_no_more() -> None:
    """Let go of what is still to be written, which Python would try once more at its end."""
    with suppress(AttributeError, OSError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
