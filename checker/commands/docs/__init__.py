"""The verb ``docs``: the pages of the documentation, as they are installed."""

import click

from rovercheck.checker.commands.shared.codes import Exit

EXAMPLES = """\b
Examples:
  rovercheck docs
  rovercheck docs tutorial
  rovercheck docs ci --path
  rovercheck docs ci --open
"""


@click.command(short_help="Show the documentation.", epilog=EXAMPLES)
@click.argument("page", required=False, metavar="[PAGE]")
@click.option("--open", "opened", is_flag=True, help="In the browser, from the site that `make docs` builds.")
@click.option("--path", "place", is_flag=True, help="Only where the file is, or the folder of all pages.")
def docs(page: str | None, opened: bool, place: bool) -> Exit:
    """List the pages of the documentation, or show PAGE: laid out on a terminal, as Markdown elsewhere."""
    from rovercheck.checker.commands.docs.run import docs as run

    return run(page, opened, place)
