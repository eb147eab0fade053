"""The verb ``requirements``: what covers each requirement."""

from pathlib import Path

import click

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import modelling, quietly


@click.command(short_help="Show which properties cover each requirement.")
@click.option("--check", "decide", is_flag=True, help="Decide the verdicts now, instead of the baseline's.")
@click.option("--json", "as_json", is_flag=True, help="The matrix as JSON.")
@modelling
@quietly
def requirements(decide: bool, as_json: bool, model: Path | None) -> Exit:
    """Show which properties cover each requirement; exit code 1 if none does and no reason is given."""
    from rovercheck.checker.commands.requirements.run import requirements as run

    return run(decide, as_json, model)
