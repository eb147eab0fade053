"""The verb ``simulate``: both boards in a scenario."""

from pathlib import Path

import click

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import quietly, writing


@click.command(short_help="Run both boards in a scenario, and draw the run.")
@click.argument("scenario", type=click.Path(path_type=Path))
@click.option("--log", type=click.Path(path_type=Path), metavar="DIR", help="Write every step there, as CSV.")
@click.option("--no-plot", is_flag=True, help="Draw nothing.")
@writing
@quietly
def simulate(scenario: Path, log: Path | None, no_plot: bool, output: Path | None) -> Exit:
    """Run both boards in the scenario of a TOML file; exit code 1 if it goes other than expected."""
    from rovercheck.checker.commands.simulate.run import simulate as run

    return run(scenario, output, log, not no_plot)
