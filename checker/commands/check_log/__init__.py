"""The verb ``check-log``: logs checked against the properties and the charts."""

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
    reading_logs,
    seeking_causes,
)

if TYPE_CHECKING:
    from rovercheck.checker.process.pool import Cluster


@dataclass(frozen=True)
class LogOptions:
    """How a log is read, and how much is told of it."""

    map_file: Path | None = None
    system: str | None = None
    as_json: bool = False
    verbose: bool = False
    known: Path | None = None
    write_known: Path | None = None
    jobs: int | None = None
    scheduler: "Cluster | None" = None
    causes: bool = False
    seconds: float = 300.0


@click.command(short_help="Check logs recorded on a board.")
@reading_logs
@click.option("--json", "as_json", is_flag=True, help="The results as JSON.")
@click.option("--verbose", "-v", is_flag=True, help="Every property, also those that are never triggered.")
@click.option(
    "--jobs",
    type=click.IntRange(min=1),
    metavar="N",
    help="Logs of a folder at a time; by default one per processor.",
)
@comparing_elsewhere
@click.option(
    "--causes", is_flag=True, help="Look for the nearest change of the charts that explains each deviation."
)
@seeking_causes
@reporting
@knowing
@changing
@modelling
@quietly
@gathered(LogOptions, "options")
def check_log(place: Path, options: LogOptions, files: CampaignFiles, charts: VariantOptions) -> Exit:
    """Check a log, or all logs of a folder: every property as a monitor, and as a run of the charts."""
    from rovercheck.checker.commands.check_log.run import check_log as run

    return run(place, options, charts.variant(), files, charts)
