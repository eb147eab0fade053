"""The verb ``reports``: the evidence as files."""

from pathlib import Path

import click

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import quietly, writing


@click.command(short_help="Write the evidence: verdicts, diagrams, findings.")
@click.option("--stale", is_flag=True, help="Write nothing; list what is out of date (exit code 1).")
@writing
@quietly
def reports(stale: bool, output: Path | None) -> Exit:
    """Write the evidence: verdict table, diagrams, a page per counterexample."""
    from rovercheck.checker.commands.reports.run import reports as run

    return run(output or Path("reports"), stale)
