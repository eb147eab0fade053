"""The verb ``graph``: charts as drawn, and reachable states."""

from pathlib import Path

import click

from checker.commands.codes import Exit
from checker.commands.options import varying, writing


@click.command(short_help="Draw a chart, or the reachable states of a system.")
@click.argument("name")
@click.option("--project", metavar="VAR,VAR", help="Variables of the state graph of a system.")
@click.option(
    "--format", default="svg", show_default=True, metavar="FORMAT", help="svg, dot, mermaid, graphml or json."
)
@varying
@writing
def graph(
    name: str,
    project: str | None,
    format: str,
    chosen: tuple[str, ...],
    repair: str | None,
    dropped: tuple[str, ...],
    output: Path | None,
) -> Exit:
    """Draw a chart, or the reachable graph of a system projected on some variables."""
    from checker.commands.graphing import graph as run
    from checker.commands.variant import pick_variant

    return run(name, project, format, pick_variant(chosen, repair, dropped).systems(), output)
