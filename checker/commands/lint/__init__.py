"""The verb ``lint``: what in charts can never happen, what decides nothing, and which numbers do not fit."""

from pathlib import Path

import click

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import modelling, quietly

EXAMPLES = """\b
Examples:
  rovercheck lint --system relay
  rovercheck lint --model examples/simulink/2_microwave/microwave.slx
"""


@click.command(short_help="Find what can never happen, and numbers that do not fit.", epilog=EXAMPLES)
@click.option("--system", "systems", multiple=True, metavar="NAME", help="Only this system; may be repeated.")
@click.option(
    "--seconds",
    type=click.FloatRange(0, min_open=True),
    help="For the searches of a system; by default 20 s for what may become of numbers, and for all where "
    "that is not decided.",
)
@click.option("--json", "as_json", is_flag=True, help="What was found, as JSON.")
@modelling
@quietly
def lint(systems: tuple[str, ...], seconds: float | None, as_json: bool, model: Path | None) -> Exit:
    """Find states of charts that are never active, transitions that are never taken, conditions that always
    hold where they are tested, without a property.

    Also told are data that leave their domains and steps without a meaning, as a division by 0; transitions
    of which only the order decides, states that are never left, and integers that stop at the ends of their
    types or wrap: these last may be meant. Exit code 1 if there is one of the others, 2 if something could
    not be decided.
    """
    from rovercheck.checker.commands.lint.run import lint as run

    return run(systems, seconds, as_json, model)
