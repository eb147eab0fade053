"""The verb ``graph``: charts as drawn, and reachable states."""

from dataclasses import dataclass
from pathlib import Path

import click

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import (
    GIB,
    SECONDS,
    VariantOptions,
    gathered,
    modelling,
    quietly,
    varying,
    writing,
)

EXAMPLES = """\b
Examples:
  rovercheck graph Relay -o relay.svg
  rovercheck graph relay
  rovercheck graph relay --project Relay -o relay-states.svg
  rovercheck graph relay --project Relay --trace PB1-15 --format html
"""


@dataclass(frozen=True)
class ViewOptions:
    """Through which variables the states are seen, what is marked, and what it may take."""

    project: str | None
    trace: str | None
    bad: str | None
    most: int
    summary: bool
    depth: int | None
    timeout: float
    memory: float


@click.command(short_help="Draw a chart, or the reachable states of a system.", epilog=EXAMPLES)
@click.argument("name")
@click.option("--project", metavar="VAR,VAR", help="Variables of the state graph of a system.")
@click.option("--trace", metavar="PROPERTY", help="Show the run of this property in the state graph.")
@click.option("--bad", metavar="PROPERTY", help="Mark where this property is broken (or reached).")
@click.option(
    "--format",
    metavar="FORMAT",
    help="svg, html, dot, mermaid or graphml; of a state graph also json. By default what the name of the "
    "output says, else svg.",
)
@click.option(
    "--max-nodes",
    "most",
    type=click.IntRange(min=1),
    default=150,
    show_default=True,
    metavar="N",
    help="Nodes that are still drawn; json, graphml and dot are written whatever the size.",
)
@click.option("--summary", is_flag=True, help="Only what the state graph shows, in words.")
@click.option("--depth", type=click.IntRange(min=1), metavar="N", help="Ticks to explore at most.")
@click.option(
    "--timeout", type=SECONDS, default=60.0, show_default=True, metavar="SEC", help="Seconds to explore."
)
@click.option(
    "--memory", type=GIB, default=2.0, show_default=True, metavar="GIB", help="Memory for what is explored."
)
@modelling
@varying
@writing
@quietly
@gathered(ViewOptions, "options")
def graph(
    name: str, options: ViewOptions, format: str | None, charts: VariantOptions, output: Path | None
) -> Exit:
    """Draw a chart, or the reachable graph of a system projected on some variables.

    Of a system alone, say which projections there are and how large they would be.
    """
    from rovercheck.checker.commands.graph.run import View
    from rovercheck.checker.commands.graph.run import graph as run
    from rovercheck.checker.engines import Limits

    limits = Limits(options.depth, options.timeout, int(options.memory * (1 << 30)))
    view = View(options.project, options.trace, options.bad, options.most, options.summary, limits)
    return run(name, view, format, charts.variant(), output)
