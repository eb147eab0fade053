"""The verb ``accept``: a finding that somebody lives with, and why."""

from dataclasses import dataclass
from datetime import date
from pathlib import Path

import click

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import gathered, modelling, quietly


def _day(context: click.Context, parameter: click.Parameter, value: str | None) -> date | None:
    """A day as ISO 8601 writes it."""
    try:
        return None if value is None else date.fromisoformat(value)
    except ValueError as error:
        raise click.BadParameter(f"{value!r} is no day; write it as 2027-03-01.") from error


@dataclass(frozen=True)
class AcceptOptions:
    """What is decided about which findings; ``source`` is a file of decisions instead."""

    ids: tuple[str, ...] = ()
    because: str | None = None
    until: date | None = None
    owner: str | None = None
    withdraw: bool = False
    source: Path | None = None


@click.command(short_help="Accept a finding: who lives with it, why and until when.")
@click.argument("ids", nargs=-1, metavar="[ID]...")
@click.option("--because", metavar="TEXT", help="Why it is accepted.")
@click.option(
    "--until", callback=_day, metavar="DATE", help="The last day on which it is accepted, such as 2027-03-01."
)
@click.option("--owner", metavar="NAME", help="Who answers for it.")
@click.option("--withdraw", is_flag=True, help="Take back that it is accepted.")
@click.option(
    "--from",
    "source",
    type=click.Path(dir_okay=False, path_type=Path),
    metavar="FILE",
    help="Decisions as JSON, such as a review page exports.",
)
@modelling
@quietly
@gathered(AcceptOptions, "options")
def accept(options: AcceptOptions, model: Path | None) -> Exit:
    """Write into the baseline of the model that findings are accepted.

    A finding that is not on record is decided first.
    """
    from rovercheck.checker.commands.accept.run import accept as run

    return run(options, model)
