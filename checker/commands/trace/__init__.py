"""The verb ``trace``: the run that a verdict rests on, in every form."""

from dataclasses import dataclass
from pathlib import Path

import click

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import (
    SearchOptions,
    VariantOptions,
    gathered,
    modelling,
    quietly,
    searching,
    varying,
    writing,
)


@dataclass(frozen=True)
class TraceOptions:
    """What the run is to show, and in which form."""

    id: str | None
    state: str | None
    transition: str | None
    system: str | None
    format: str
    everything: bool
    explain: bool | None
    witnesses: int
    by: str
    output: Path | None


@click.command(short_help="Show a counterexample or a witness, tick by tick.")
@click.argument("id", required=False)
@click.option("--state", metavar="CHART.STATE", help="Instead of a property: a run into a state of a chart.")
@click.option(
    "--transition", metavar="'CHART: A -> B'", help="Instead of a property: a run through a transition."
)
@click.option("--system", metavar="NAME", help="With --state or --transition: on this system.")
@click.option(
    "--format",
    default="table",
    show_default=True,
    metavar="FORMAT",
    help="How: table, markdown, html, svg, vcd, json and more; see rovercheck list formats.",
)
@click.option("--all", "everything", is_flag=True, help="Also what the property does not depend on.")
@click.option(
    "--explain/--no-explain",
    default=None,
    help="Which inputs determine the violation; by default for ten seconds at most.",
)
@click.option(
    "--witnesses",
    type=click.IntRange(min=1),
    default=1,
    metavar="N",
    help="So many runs, each with other transitions than those before, or for another reason.",
)
@click.option(
    "--by",
    type=click.Choice(["transitions", "reason"]),
    default="transitions",
    show_default=True,
    help="With --witnesses: in what runs differ, the transitions they take or the inputs they need.",
)
@modelling
@varying
@searching
@writing
@quietly
@gathered(TraceOptions, "options")
def trace(options: TraceOptions, charts: VariantOptions, search: SearchOptions) -> Exit:
    """Show the counterexample of a violated property, or the witness of a reachable one.

    \b
    Examples:
      rovercheck trace PB1-15 --witnesses 3
      rovercheck trace --state Relay.B2_actuating
      rovercheck trace --transition 'Relay: B1_actuating -> B2_actuating'
    """
    from rovercheck.checker.commands.shared.select import pick_engine
    from rovercheck.checker.commands.trace.examples import trace_request
    from rovercheck.checker.commands.trace.explain import ExplanationOptions
    from rovercheck.checker.commands.trace.run import TraceDisplay
    from rovercheck.checker.commands.trace.run import trace as run

    variant = charts.variant()
    wanted = trace_request(variant, options.id, options.state, options.transition, options.system)
    engine = pick_engine(search.engine)
    store = search.store(engine)
    showing = TraceDisplay(
        options.format,
        options.everything,
        options.output,
        ExplanationOptions.chosen(options.explain, store),
        options.witnesses,
        options.by,
    )
    return run(wanted, engine, search.limits(), showing, store)
