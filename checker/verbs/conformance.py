"""Verbs about implementations: run them, compare them and their logs with the charts, test them."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from checker.commands.codes import Exit
from checker.commands.options import SECONDS, quietly, writing
from checker.engine import LOADED


def _changing(command: Callable[..., Exit]) -> Callable[..., Exit]:
    """The options that change the charts compared with; assumptions about the environment play no part."""
    options: list[Callable[[Any], Any]] = [
        click.option(
            "--reading",
            "chosen",
            multiple=True,
            metavar="ID=CHOICE",
            help="Read a sentence otherwise: S43=AND.",
        ),
        click.option("--repair", metavar="NAME", help="With a proposed repair; see list repairs."),
    ]
    for option in reversed(options):
        command = option(command)
    return command


@click.command(short_help="Run both boards in a scenario, and draw the run.")
@click.argument("scenario", type=click.Path(path_type=Path))
@click.option("--log", type=click.Path(path_type=Path), metavar="DIR", help="Write every step there, as CSV.")
@click.option("--no-plot", is_flag=True, help="Draw nothing.")
@writing
@quietly
def simulate(scenario: Path, log: Path | None, no_plot: bool, output: Path | None) -> Exit:
    """Run both boards in the scenario of a TOML file; exit code 1 if it goes other than expected."""
    from checker.commands.simulating import simulate as run

    return run(scenario, output, log, not no_plot)


@click.command(short_help="Check logs recorded on a board.")
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
@_changing
@quietly
def conform(
    place: Path,
    map_file: Path | None,
    system: str | None,
    as_json: bool,
    verbose: bool,
    chosen: tuple[str, ...],
    repair: str | None,
) -> Exit:
    """Check a log, or all logs of a folder: every property as a monitor, and as a run of the charts."""
    from checker.commands.conforming import conform as run

    return run(place, map_file, system, as_json, verbose, chosen, repair)


@click.command(short_help="Compare a supervisor with the charts, step by step.")
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
@click.option(
    "--mismatches",
    type=click.IntRange(min=0),
    default=5,
    show_default=True,
    metavar="N",
    help="Distinct mismatches told with inputs and a test; the others in a line each.",
)
@click.option(
    "--failures",
    type=click.IntRange(min=1),
    default=3,
    show_default=True,
    metavar="N",
    help="Runs it may fail to survive before no more are tried.",
)
@click.option("--json", "as_json", is_flag=True, help="The results as JSON.")
@click.option(
    "--output",
    "-o",
    type=click.Path(file_okay=False, path_type=Path),
    metavar="DIR",
    help="Write a test for each of these mismatches there, not here.",
)
@_changing
@quietly
def crosscheck(
    system: str | None,
    impl: str | None,
    profile: str,
    examples: int | None,
    seed: int | None,
    tests: Path | None,
    mismatches: int,
    failures: int,
    as_json: bool,
    output: Path | None,
    chosen: tuple[str, ...],
    repair: str | None,
) -> Exit:
    """Run a supervisor and the charts side by side; exit code 1 where they differ."""
    from checker.commands.crosschecking import Asked
    from checker.commands.crosschecking import crosscheck as run
    from checker.conform.cross import Allowance

    allowed = Allowance(mismatches, failures)
    asked = Asked(system, impl, profile, examples, seed, tests, allowed, chosen, repair)
    return run(asked, output, as_json)


@click.command(short_help="Write tests that cover the charts, with expected outputs.")
@click.option(
    "--system", "names", multiple=True, metavar="BOARD|CHART", help="Only these; both boards if none."
)
@click.option(
    "--cover",
    "kinds",
    multiple=True,
    type=click.Choice(["arrows", "boundaries", "pairs"]),
    help="What the tests must reach; more than one may be given.  [default: arrows; all with --keep]",
)
@click.option(
    "--format",
    type=click.Choice(["csv", "pytest", "c"]),
    default="csv",
    show_default=True,
    help="CSV files, a pytest file or a C program.",
)
@click.option("--kept", is_flag=True, help="Write the tests that come with rovercheck, without a search.")
@click.option(
    "--keep",
    type=click.Path(file_okay=False, path_type=Path),
    metavar="FOLDER",
    help="Go on from the tests kept there, and keep all there instead.",
)
@click.option(
    "--timeout",
    type=SECONDS,
    default=20.0,
    show_default=True,
    metavar="SEC",
    help="Seconds for each search by engines.",
)
@click.option(
    "--ticks",
    type=click.IntRange(min=0),
    default=40_000,
    show_default=True,
    metavar="N",
    help="Ticks of random runs.",
)
@click.option("--seed", type=click.IntRange(min=0), default=0, metavar="N", help="Of the random runs.")
@click.option(
    "--jobs", type=click.IntRange(min=1), metavar="N", help="Searches at a time; one per processor."
)
@click.option("--json", "as_json", is_flag=True, help="Every goal and what is known of it, as JSON.")
@click.option(
    "--output",
    "-o",
    type=click.Path(file_okay=False, path_type=Path),
    default=Path("covering"),
    show_default=True,
    metavar="DIR",
    help="The folder to write into.",
)
@quietly
def testgen(
    names: tuple[str, ...],
    kinds: tuple[str, ...],
    format: str,
    kept: bool,
    keep: Path | None,
    timeout: float,
    ticks: int,
    seed: int,
    jobs: int | None,
    as_json: bool,
    output: Path,
) -> Exit:
    """Write short input sequences that cover the charts, with the outputs that the charts require.

    Exit code 0 if every goal is reached by a test or proved out of reach, 2 if some are not known to be
    either.  Ctrl-C writes what was found so far.
    """
    from checker.isolate import prepared

    with prepared(*LOADED):
        from checker.commands.generating import Asked
        from checker.commands.generating import testgen as run
        from checker.conform.cover.coverage import Effort
        from checker.conform.cover.goals import Kind

        wanted = tuple(map(Kind, kinds)) or (tuple(Kind) if keep else (Kind.ARROWS,))
        asked = Asked(names, wanted, format, Effort(timeout, ticks, jobs, seed), kept, keep)
        return run(asked, output, as_json)
