"""The verb ``export``: properties for other model checkers."""

from pathlib import Path

import click

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import VariantOptions, modelling, quietly, varying, writing

CHARTS = ("slx", "scxml")
"""The formats that charts are written in, and not properties."""


@click.command(short_help="Write properties for other model checkers.")
@click.argument("ids", nargs=-1, metavar="PROPERTY...")
@click.option(
    "--system", "about", multiple=True, metavar="NAME", help="All properties about this system, or these."
)
@click.option(
    "--format",
    default="aiger",
    show_default=True,
    metavar="FORMAT",
    help="aiger, aag, btor2, smv or promela, or the charts of a system: slx (Simulink) or scxml.",
)
@modelling
@varying
@writing
@quietly
def export(
    ids: tuple[str, ...], about: tuple[str, ...], format: str, charts: VariantOptions, output: Path | None
) -> Exit:
    """Write properties for other model checkers: a file, or a folder of them.

    With --format slx, write the charts of the system that --system names as a model of Simulink; with scxml,
    as a machine in SCXML.
    """
    if format in CHARTS:
        from rovercheck.checker.commands.export.charts import export_charts

        return export_charts(ids, about, format, charts.variant(), output)
    from rovercheck.checker.commands.export.run import export as run

    return run(ids, about, format, charts.variant(), output)
