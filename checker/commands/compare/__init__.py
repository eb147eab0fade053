"""The verb ``compare``: an implementation and the charts side by side."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click

from rovercheck.checker.commands.shared.campaign_files import CampaignFiles, reporting
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import (
    VariantOptions,
    changing,
    comparing_elsewhere,
    gathered,
    knowing,
    modelling,
    quietly,
    seeking_causes,
)
from rovercheck.checker.commands.shared.silence import say_more

if TYPE_CHECKING:
    from rovercheck.checker.process.pool import Cluster


@dataclass(frozen=True)
class ComparisonOptions:
    """What is compared, on how many runs, and how much is reported."""

    system: str | None
    impl: str | None
    profile: str
    examples: int | None
    seed: int | None
    tests: Path | None
    mismatches: int
    failures: int
    known: Path | None = None
    write_known: Path | None = None
    write_variant: Path | None = None
    causes: bool | None = None
    seconds: float = 300.0
    jobs: int = 1
    scheduler: "Cluster | None" = None


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
    help="Distinct deviations told with a small run and a test; the others without.",
)
@click.option(
    "--failures",
    type=click.IntRange(min=1),
    default=3,
    show_default=True,
    metavar="N",
    help="Runs it may fail to survive before no more are tried.",
)
@click.option(
    "--verbose",
    "-v",
    is_flag=True,
    expose_value=False,
    callback=say_more,
    help="Also all that a compiler warns of.",
)
@click.option(
    "--causes/--no-causes",
    default=None,
    help="Look for causes in every part that deviates, or in none; else where a part does in several ways.",
)
@seeking_causes
@click.option(
    "--write-variant",
    type=click.Path(dir_okay=False, path_type=Path),
    metavar="FILE",
    help="Write the causes as a variant, for --variant.",
)
@click.option(
    "--jobs",
    type=click.IntRange(min=1),
    default=1,
    show_default=True,
    metavar="N",
    help="Processes with an implementation each that try the random runs, 240 of them at a time.",
)
@comparing_elsewhere
@click.option("--json", "as_json", is_flag=True, help="The results as JSON.")
@click.option(
    "--output",
    "-o",
    type=click.Path(file_okay=False, path_type=Path),
    metavar="DIR",
    help="Write a test for each of these mismatches there, not here.",
)
@reporting
@knowing
@changing
@modelling
@quietly
@gathered(ComparisonOptions, "options")
def compare(
    options: ComparisonOptions,
    as_json: bool,
    output: Path | None,
    files: CampaignFiles,
    charts: VariantOptions,
) -> Exit:
    """Run a supervisor and the charts side by side; exit code 1 where they differ."""
    from rovercheck.checker.commands.compare.run import CrosscheckOptions
    from rovercheck.checker.commands.compare.run import compare as run
    from rovercheck.checker.compare import Allowance

    allowed = Allowance(options.mismatches, options.failures)
    asked = CrosscheckOptions(
        options.system,
        options.impl,
        options.profile,
        options.examples,
        options.seed,
        options.tests,
        allowed,
        charts,
        options.known,
        options.write_known,
        options.write_variant,
        options.seconds,
        options.causes,
        options.scheduler or options.jobs,
    )
    return run(asked, output, as_json, files)
