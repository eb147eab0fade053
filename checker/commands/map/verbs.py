"""The verbs below ``map``, apart from those that are found beside it."""

from pathlib import Path

import click

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import modelling

EPILOG = """\b
Examples:
  rovercheck map init examples/board1_c --system board1 -o map.toml
  rovercheck map init firmware --model heater.py
"""


@click.group("map", short_help="Propose the mapping file of a firmware in C.")
def map_() -> None:
    """The file that says where a firmware in C holds the signals of a board (docs/firmware.md)."""


@map_.command("init", short_help="Propose a mapping file from the names in the sources.", epilog=EPILOG)
@click.argument("folder", type=click.Path(path_type=Path), metavar="FOLDER")
@click.option("--system", metavar="NAME", help="The board; by default that which the names fit best.")
@click.option(
    "--output",
    "-o",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Where it is written; by default map.toml in FOLDER.",
)
@click.option("--force", is_flag=True, help="Write over a file that is there.")
@modelling
def init(folder: Path, system: str | None, output: Path | None, force: bool, model: Path | None) -> Exit:
    """Read the C sources in FOLDER and propose the file that connects them with a board.

    Which functions and variables look like which signals, with the reason beside each; what is guessed or
    missing is marked in the file, and said on standard error. Nothing is compiled for it but the file itself,
    to see that it fits. Exit code 0: written; 4: nothing to read, or a file that is there.
    """
    from rovercheck.checker.commands.map.run import map_init

    return map_init(folder, system, output, force, model)
