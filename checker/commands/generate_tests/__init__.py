"""The verb ``generate-tests``: tests that cover the charts."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import (
    SECONDS,
    VariantOptions,
    changing,
    elsewhere,
    gathered,
    modelling,
    quietly,
)
from rovercheck.checker.engines import LOADED

if TYPE_CHECKING:
    from rovercheck.checker.process.pool import Cluster


@dataclass(frozen=True)
class GenerationOptions:
    """What is to be covered, in which form, and what it may take."""

    names: tuple[str, ...]
    kinds: tuple[str, ...]
    format: str
    kept: bool
    keep: Path | None
    timeout: float
    ticks: int
    seed: int
    jobs: int | None
    scheduler: "Cluster | None"


@click.command(short_help="Write tests that cover the charts, with expected outputs.")
@click.option(
    "--system", "names", multiple=True, metavar="BOARD|CHART", help="Only these; all boards if none."
)
@click.option(
    "--cover",
    "kinds",
    multiple=True,
    type=click.Choice(["transitions", "boundaries", "conditions", "pairs"]),
    metavar="KIND",
    help="What the tests must reach: transitions, boundaries, conditions, pairs; more than one may be "
    "given.  [default: transitions; with --keep also boundaries and pairs]",
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
@elsewhere
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
@changing
@modelling
@quietly
@gathered(GenerationOptions, "options")
def generate_tests(options: GenerationOptions, as_json: bool, output: Path, charts: VariantOptions) -> Exit:
    """Write short input sequences that cover the charts, with the outputs that the charts require.

    Exit code 0 if every goal is reached by a test or proved out of reach, 2 if some are not known to be
    either.  Ctrl-C writes what was found so far.
    """
    from rovercheck.checker.process.isolate import prepared

    with prepared(*LOADED):
        from rovercheck.checker.commands.generate_tests.run import CoveringRequest
        from rovercheck.checker.commands.generate_tests.run import generate_tests as run
        from rovercheck.checker.system.instrument.goals import KEPT, GoalKind
        from rovercheck.checker.testgen.coverage import GenerationEffort

        wanted = tuple(GoalKind[kind.upper()] for kind in options.kinds) or (
            KEPT if options.keep else (GoalKind.TRANSITIONS,)
        )
        asked = CoveringRequest(
            options.names,
            wanted,
            options.format,
            GenerationEffort(options.timeout, options.ticks, options.scheduler or options.jobs, options.seed),
            options.kept,
            charts.variant(),
            options.keep,
        )
        return run(asked, output, as_json)
