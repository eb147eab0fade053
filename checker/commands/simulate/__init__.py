"""The verb ``simulate``: both boards in a scenario."""

from pathlib import Path

import click

from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.options import (
    VariantOptions,
    changing,
    modelling,
    quietly,
    writing,
)


@click.command(short_help="Run both boards in a scenario, and draw the run.")
@click.argument("scenario", type=click.Path(path_type=Path))
@click.option("--log", type=click.Path(path_type=Path), metavar="DIR", help="Write every step there, as CSV.")
@click.option("--no-plot", is_flag=True, help="Draw nothing.")
@click.option("--system", metavar="NAME", help="Run this system on inputs from a CSV file instead.")
@changing
@modelling
@writing
@quietly
def simulate(
    scenario: Path,
    log: Path | None,
    no_plot: bool,
    system: str | None,
    output: Path | None,
    charts: VariantOptions,
) -> Exit:
    """Run both boards in the scenario of a TOML file; exit code 1 if it goes other than expected.

    With --system or --model: run charts on the inputs of a CSV file, a row for each step, and show the run.
    """
    if system is None and charts == VariantOptions():
        from rovercheck.checker.commands.simulate.run import simulate as run

        return run(scenario, output, log, not no_plot)
    if log is not None or no_plot:
        raise UsageError("--log and --no-plot go with a scenario of both boards; leave them out.")
    if system is None and charts.model is None:
        raise UsageError("In a scenario the supervisors run, and no charts; name those to run with --system.")
    from rovercheck.checker.commands.simulate.charts import simulate_charts

    return simulate_charts(scenario, charts.variant(), system, output)
