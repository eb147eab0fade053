"""The verb ``diagnose``: the changes of the charts that explain how logs deviate."""

from dataclasses import dataclass
from pathlib import Path

import click

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import gathered, quietly, reading_logs, seeking_causes


@dataclass(frozen=True)
class DiagnoseOptions:
    """How logs are read, what they are compared with, and how long causes are looked for."""

    map_file: Path | None = None
    system: str | None = None
    variant: Path | None = None
    write: Path | None = None
    seconds: float = 300.0
    as_json: bool = False


@click.command(short_help="Find the causes of what logs do otherwise than the charts.")
@reading_logs
@click.option(
    "--variant", type=click.Path(path_type=Path), metavar="FILE", help="Charts with the changes of a variant."
)
@click.option(
    "--write", type=click.Path(path_type=Path), metavar="FILE", help="Write the causes as a variant."
)
@seeking_causes
@click.option("--json", "as_json", is_flag=True, help="The results as JSON.")
@quietly
@gathered(DiagnoseOptions, "options")
def diagnose(place: Path, options: DiagnoseOptions) -> Exit:
    """Find the nearest changes of the charts that explain all that logs do otherwise."""
    from rovercheck.checker.commands.diagnose.run import diagnose as run

    return run(place, options)
