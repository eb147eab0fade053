"""The verb ``list``: what there is."""

from pathlib import Path

import click

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import modelling

LISTS = (
    "properties",
    "systems",
    "charts",
    "requirements",
    "interpretations",
    "repairs",
    "assumptions",
    "engines",
    "formats",
)


@click.command("list", short_help="List properties, systems, engines and so on.")
@click.argument("what", type=click.Choice(LISTS), metavar="WHAT")
@click.argument("ids", nargs=-1, metavar="[ID]...")
@click.option("--english", is_flag=True, help="What is checked of each property, in words.")
@click.option("--json", "as_json", is_flag=True, help="The list as JSON (checker/schemas/list-1.json).")
@modelling
def list_(what: str, ids: tuple[str, ...], english: bool, as_json: bool, model: Path | None) -> Exit:
    """List properties, systems, charts, requirements, interpretations, repairs, assumptions, engines or
    formats."""
    from rovercheck.checker.commands.list.run import listing

    return listing(what, ids, english, model, as_json)
