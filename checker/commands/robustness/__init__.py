"""The verb ``robustness``: an implementation under inputs that no model admits."""

from dataclasses import dataclass
from pathlib import Path

import click

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import gathered, modelling, quietly


@dataclass(frozen=True)
class RobustnessOptions:
    """What is tried on which implementation, and what must hold of it."""

    impl: str
    system: str | None = None
    rules: Path | None = None
    runs: int = 200
    seed: int = 1
    no_sanitizers: bool = False
    output: Path | None = None
    as_json: bool = False
    model: Path | None = None


@click.command(short_help="Give a supervisor what no model admits.")
@click.option("--impl", metavar="KIND:WHAT", required=True, help="The supervisor, as for compare.")
@click.option("--system", metavar="NAME", help="The board: board1 or board2.")
@click.option(
    "--rules", type=click.Path(path_type=Path), metavar="FILE", help="What must hold (docs/firmware.md)."
)
@click.option(
    "--runs", type=click.IntRange(min=0), default=200, show_default=True, metavar="N", help="Random runs."
)
@click.option(
    "--seed", type=click.IntRange(min=0), default=1, show_default=True, metavar="S", help="Of these."
)
@click.option("--no-sanitizers", is_flag=True, help="Compile C without them, even where there are some.")
@click.option(
    "--output",
    "-o",
    type=click.Path(file_okay=False, path_type=Path),
    metavar="DIR",
    help="Write a test for each finding there.",
)
@click.option("--json", "as_json", is_flag=True, help="What was found as JSON.")
@modelling
@quietly
@gathered(RobustnessOptions, "options")
def robustness(options: RobustnessOptions) -> Exit:
    """Run a supervisor with odd inputs: NaN, values out of range, clocks that jump, wrap and stand still.

    It must not crash or hang, and give numbers in range; a file of rules says more. Exit code 0: all of it
    held; 1: it did not; 2: no output was given that could be judged; 4: a mistake, or it does not start.
    """
    from rovercheck.checker.commands.robustness.run import robustness as run

    return run(options)
