"""The verb ``report``: one page with all verdicts and their evidence, for reviewers."""

from dataclasses import dataclass
from pathlib import Path
from shlex import join

import click
from click.core import ParameterSource

from checker.commands.shared.codes import Exit
from checker.commands.shared.options import (
    GIB,
    SearchOptions,
    VariantOptions,
    gathered,
    modelling,
    quietly,
    searching,
    varying,
)
from checker.engines import LOADED

FILE = "FILE"
"""What stands for the file in the command that the page shows."""


@dataclass(frozen=True)
class PageOptions:
    """Which properties the page is about, and what it shows of them."""

    ids: tuple[str, ...]
    about: tuple[str, ...]
    full: bool
    certify: bool
    no_repairs: bool
    premises: bool
    explain: bool
    date: str
    jobs: int | None
    memory: float


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
@click.option("--premises", is_flag=True, help="Also whether the premises of proofs occur.")
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
@gathered(PageOptions, "options")
def report(
    context: click.Context, options: PageOptions, output: Path, charts: VariantOptions, search: SearchOptions
) -> Exit:
    """Check properties and write one HTML page for reviewers, which needs no network."""
    from checker.process.isolate import prepared

    with prepared(*LOADED):
        from checker.commands.report.run import ReportOptions
        from checker.commands.report.run import report as run
        from checker.commands.shared.select import pick_engine, pick_properties

        variant = charts.variant()
        properties = pick_properties(
            options.ids, options.about, variant.properties(), options.full, variant.unchanged()
        )
        if variant.name and not options.ids:
            properties = list(filter(variant.concerns(), properties))
        if variant.name:
            properties = variant.askable(properties)
        whole = not (options.ids or options.about or variant.name)
        return run(
            variant,
            properties,
            ReportOptions(
                command(context),
                whole,
                not options.no_repairs,
                options.premises,
                options.explain,
                options.date,
            ),
            output,
            pick_engine(search.engine),
            search.limits(options.memory),
            options.jobs,
            variant.certifying(None, True) if options.certify else None,
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
