"""The verb ``diff``: verdicts of one revision beside those of another."""

from pathlib import Path

import click

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import modelling, quietly, writing


@click.command(short_help="Show which verdicts changed since a git revision.")
@click.argument("before", metavar="REV")
@click.argument("after", metavar="[REV]", required=False)
@click.option(
    "--format",
    "form",
    type=click.Choice(["text", "markdown", "json"]),
    default="text",
    show_default=True,
    help="For a terminal, for a pull request, or for programs.",
)
@click.option("--full", is_flag=True, help="Also the properties that take long.")
@modelling
@writing
@quietly
def diff(
    before: str, after: str | None, form: str, full: bool, model: Path | None, output: Path | None
) -> Exit:
    """Compare the verdicts of a git revision with those of the working tree, or of another revision.

    Exit code 1 if a verdict is worse, a property is gone, or a new one is violated.
    """
    from rovercheck.checker.commands.diff.run import DiffRequest
    from rovercheck.checker.commands.diff.run import diff as run

    return run(DiffRequest(before, after, full, model), form, output)
