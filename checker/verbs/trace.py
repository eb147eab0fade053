"""The verb ``trace``: the run that a verdict rests on, in every form."""

from pathlib import Path

import click

from checker.commands.codes import Exit
from checker.commands.options import searching, varying, writing
from checker.engine import Limits, Timers


@click.command(short_help="Show a counterexample or a witness, tick by tick.")
@click.argument("id")
@click.option(
    "--format", default="table", show_default=True, metavar="FORMAT", help="table, markdown, json or vcd."
)
@click.option("--all", "everything", is_flag=True, help="Also what the property does not depend on.")
@varying
@searching
@writing
def trace(
    id: str,
    format: str,
    everything: bool,
    chosen: tuple[str, ...],
    repair: str | None,
    dropped: tuple[str, ...],
    engine: str,
    depth: int | None,
    timeout: float | None,
    timers: str,
    output: Path | None,
) -> Exit:
    """Show the counterexample of a violated property, or the witness of a reachable one."""
    from checker.commands.select import pick, pick_engine
    from checker.commands.tracing import trace as run
    from checker.commands.variant import pick_variant

    variant = pick_variant(chosen, repair, dropped)
    prop = pick("property", id, variant.properties())
    limits = Limits(depth, timeout, timers=Timers(timers))
    return run(prop, variant.systems(), pick_engine(engine), limits, format, everything, output)
