"""The verb ``init``: a model to begin with."""

from pathlib import Path

import click

from rovercheck.checker.commands.shared.codes import Exit


@click.command(short_help="Write a small model of your own to begin with.")
@click.argument("folder", type=click.Path(path_type=Path), metavar="FOLDER")
def init(folder: Path) -> Exit:
    """Write into FOLDER: heater.py (a chart and its properties), baseline.toml, README.md, a CI workflow."""
    from rovercheck.checker.commands.init.run import init as run

    return run(folder)
