"""The verb ``import``: what is drawn in a file of Simulink."""

from pathlib import Path

import click

from rovercheck.checker.commands.shared.codes import Exit

EXAMPLES = """\b
Examples:
  rovercheck import supervisor.slx
  rovercheck import supervisor.slx --beside parameters.m --beside types.sldd
  rovercheck import supervisor.slx --json
"""

FILE = click.Path(path_type=Path)


@click.command("import", short_help="Say what is drawn in a file of Simulink.", epilog=EXAMPLES)
@click.argument("model", type=FILE, metavar="MODEL.slx")
@click.option(
    "--beside", type=FILE, multiple=True, metavar="FILE",
    help="A data dictionary (.sldd), a class of an enumeration or a script of values (.m) that the model "
    "uses.  The dictionary that the model names, and classes in its folder, are found.",
)  # fmt: skip
@click.option("--json", "as_json", is_flag=True, help="All that was read, as JSON.")
def import_(model: Path, beside: tuple[Path, ...], as_json: bool) -> Exit:
    """Say what is drawn in a file of Simulink: charts, blocks, types, events, timers; without MATLAB.

    Nothing in the file is executed.  Exit code 2 if something in it has no meaning here.
    """
    from rovercheck.checker.commands.import_.run import import_model

    return import_model(model, beside, as_json)
