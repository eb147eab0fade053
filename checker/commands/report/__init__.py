"""The verb ``report``: one page with all verdicts and their evidence, for reviewers."""

import os
from dataclasses import dataclass, replace
from pathlib import Path
from shlex import join

import click
from click.core import ParameterSource

from rovercheck.checker.cache.places import STORE
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import (
    GIB,
    SearchOptions,
    SelectionOptions,
    VariantOptions,
    gathered,
    modelling,
    quietly,
    searching,
    selecting,
    varying,
)
from rovercheck.checker.engines import LOADED

FILE = "FILE"
"""What stands for the file in the command that the page shows."""
FILES = ("--output", "--pdf")


@dataclass(frozen=True)
class PageOptions:
    """What the page shows of properties, and how they are decided.

    ``premises`` and ``explain`` are None where a user wrote nothing: then each is looked for as long as
    ``check`` and ``trace`` do.  ``command`` is the command line itself; ``date``, ``document`` and
    ``reviewer`` are shown as given.  ``pdf`` is a file to print the page into.  ``some``: properties were
    selected.  ``at_once``: causes, repairs and graphs that are not kept are left out.
    """

    certify: bool = False
    no_repairs: bool = False
    premises: bool | None = None
    explain: bool | None = None
    date: str = ""
    document: str = ""
    reviewer: str = ""
    pdf: Path | None = None
    jobs: int | None = None
    memory: float = 8.0
    command: str = ""
    some: bool = False
    at_once: bool = False


@click.command(short_help="Write one page with all verdicts, for reviewers.")
@selecting
@click.option(
    "--output",
    "-o",
    type=click.Path(path_type=Path),
    required=True,
    metavar=FILE,
    help="The HTML file to write.",
)
@click.option(
    "--pdf",
    type=click.Path(path_type=Path),
    metavar=FILE,
    help="Print the page into this file too, with an installed Chromium.",
)
@click.option("--certify", is_flag=True, help="Check every proof again, without the engine that found it.")
@click.option(
    "--at-once",
    is_flag=True,
    help="Leave out causes, repairs and state graphs that nobody has looked for yet; the page says so.",
)
@click.option("--no-repairs", is_flag=True, help="Without deciding the proposed repairs.")
@click.option(
    "--premises/--no-premises",
    default=None,
    help="Search longer for whether the premises of proofs occur, or not at all.",
)
@click.option(
    "--explain/--no-explain",
    default=None,
    help="Look for the inputs that force each counterexample as long as it takes, or not at all.",
)
@click.option("--date", default="", metavar="TEXT", help="A date to show; by default there is none.")
@click.option("--document", default="", metavar="TEXT", help="The revision of the document, for the cover.")
@click.option("--reviewer", default="", metavar="NAME", help="Who reviews it, for the cover.")
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
    context: click.Context,
    selection: SelectionOptions,
    options: PageOptions,
    output: Path,
    charts: VariantOptions,
    search: SearchOptions,
) -> Exit:
    """Check properties and write one HTML page for reviewers, which needs no network."""
    from rovercheck.checker.process.isolate import prepared

    with prepared(*LOADED):
        from rovercheck.checker.commands.check.findings import Guide
        from rovercheck.checker.commands.report.kept_page import PageKeeper, delivered, possible

        possible(output, options.pdf)
        options = replace(options, command=command(context))
        keeper = None
        asked_anew = options.certify or search.no_store or os.environ.get(STORE) == ""
        if charts == VariantOptions() and not asked_anew and not options.at_once:
            keeper = PageKeeper.now(search, selection, options)
        kept = keeper.read() if keeper is not None else None
        if kept is not None:
            return delivered(kept, Guide(""), output, options.pdf)
        from rovercheck.checker.commands.report.run import report as run
        from rovercheck.checker.commands.shared.select import pick_engine
        from rovercheck.checker.commands.shared.variant import askable, certifying
        from rovercheck.checker.model.kept_invariants import invariants_of
        from rovercheck.checker.verify.searches import SearchSettings

        variant = charts.variant()
        properties = selection.properties(variant)
        if variant.name:
            properties = askable(variant, properties)
        engine = pick_engine(search.engine)
        settings = SearchSettings(
            engine,
            search.limits(options.memory),
            options.jobs,
            invariants_of(variant.model),
            certifying(variant, None, True) if options.certify else None,
            search.store(engine),
        )
        some = not selection.whole or bool(variant.name)
        return run(variant, properties, settings, replace(options, some=some), output, keeper)


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
    if isinstance(value, bool):
        return [name if value else max(param.secondary_opts, key=len)]
    values = value if isinstance(value, tuple) else (value,)
    return [
        word
        for one in values
        for word in (name, FILE if isinstance(one, Path) and name in FILES else str(one))
    ]
