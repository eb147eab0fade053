"""The verb ``report``: one page with all verdicts and their evidence, for reviewers."""

from pathlib import Path
from shlex import join

import click
from click.core import ParameterSource

from checker.commands.shared.codes import Exit
from checker.commands.shared.options import GIB, modelling, quietly, searching, varying
from checker.engines import LOADED, Limits, Timers

FILE = "FILE"
"""What stands for the file in the command that the page shows."""


@click.command(short_help="Write one page with all verdicts, for reviewers.")
@click.argument("ids", nargs=-1, metavar="[ID]...")
@click.option(
    "--output",
    "-o",
    type=click.Path(path_type=Path),
    required=True,
    metavar=FILE,
    help="The HTML file to write.",
)
@click.option(
    "--system", "about", multiple=True, metavar="NAME", help="Only properties about this system, or these."
)
@click.option("--full", is_flag=True, help="Also the properties that take long.")
@click.option("--certify", is_flag=True, help="Check every proof again, without the engine that found it.")
@click.option("--no-repairs", is_flag=True, help="Without deciding the proposed repairs.")
@click.option("--premises", is_flag=True, help="Also whether the case occurs that each proof speaks of.")
@click.option("--explain", is_flag=True, help="Also which inputs force the end of each counterexample.")
@click.option("--date", default="", metavar="TEXT", help="A date to show; by default there is none.")
@click.option(
    "--jobs",
    type=click.IntRange(min=1),
    metavar="N",
    help="Searches at a time; by default one per processor.",
)
@click.option(
    "--memory",
    type=GIB,
    default=8.0,
    show_default=True,
    metavar="GIB",
    help="What each search may take.",
)
@modelling
@varying
@searching
@quietly
@click.pass_context
def report(
    context: click.Context,
    ids: tuple[str, ...],
    output: Path,
    about: tuple[str, ...],
    full: bool,
    certify: bool,
    no_repairs: bool,
    premises: bool,
    explain: bool,
    date: str,
    jobs: int | None,
    memory: float,
    model: Path | None,
    chosen: tuple[str, ...],
    repair: str | None,
    dropped: tuple[str, ...],
    engine: str,
    depth: int | None,
    timeout: float | None,
    timers: str,
) -> Exit:
    """Check properties and write one HTML page for reviewers, which needs no network."""
    from checker.process.isolate import prepared

    with prepared(*LOADED):
        from checker.commands.report.run import ReportOptions
        from checker.commands.report.run import report as run
        from checker.commands.shared.select import pick_engine, pick_properties
        from checker.commands.shared.variant import pick_variant

        variant = pick_variant(chosen, repair, dropped, model)
        properties = pick_properties(ids, about, variant.properties(), full, variant.unchanged())
        if variant.name and not ids:
            properties = list(filter(variant.concerns(), properties))
        if variant.name:
            properties = variant.askable(properties)
        whole = not (ids or about or variant.name)
        return run(
            variant,
            properties,
            ReportOptions(command(context), whole, not no_repairs, premises, explain, date),
            output,
            pick_engine(engine),
            Limits(depth, timeout, int(memory * 2**30), timers=Timers(timers)),
            jobs,
            variant.certifying(None, True) if certify else None,
        )


def command(context: click.Context) -> str:
    """The command line that was given, the name of the output file left out."""
    words = ["rovercheck", "report"]
    for param in context.command.params:
        name = param.name or ""
        value = context.params.get(name)  # --quiet has none: it says nothing of the page
        if value is None:
            continue
        if isinstance(param, click.Argument):
            words += value
        elif context.get_parameter_source(name) is ParameterSource.COMMANDLINE:
            words += _option(param, value)
    return join(words)


def _option(param: click.Parameter, value: object) -> list[str]:
    name = max(param.opts, key=len)
    if value is True:
        return [name]
    values = value if isinstance(value, tuple) else (value,)
    return [word for one in values for word in (name, FILE if name == "--output" else str(one))]
