"""The verb ``explore``: a system stepped through by hand."""

from pathlib import Path

import click

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import VariantOptions, modelling, quietly, varying

EXAMPLES = """\b
Examples:
  rovercheck explore Relay
  rovercheck explore board1 --trace PB1-15
  rovercheck explore relay_links < session.txt
"""


@click.command(short_help="Step through a chart or a system at a prompt.", epilog=EXAMPLES)
@click.argument("name", required=False, metavar="[CHART|SYSTEM]")
@click.option("--trace", "traced", metavar="PROPERTY", help="Begin at the end of this property's run.")
@click.option(
    "--script",
    type=click.Path(exists=True, dir_okay=False, path_type=Path),
    metavar="FILE",
    help="Commands from a file instead of the terminal.",
)
@modelling
@varying
@quietly
def explore(name: str | None, traced: str | None, script: Path | None, charts: VariantOptions) -> Exit:
    """Step through a chart alone or a system: choose inputs or let them run, go back, ask why.

    Commands come from the terminal, a file or standard input; docs/explore.md shows a session.
    Exit code 4 at the first bad command of a script.
    """
    from rovercheck.checker.commands.explore.run import explore as run

    return run(name, charts.variant(), traced, script)
