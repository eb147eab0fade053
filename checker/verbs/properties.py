"""Verbs about properties: decide them, show why, hand them to others."""

from pathlib import Path

import click

from checker.commands.codes import Exit, UsageError
from checker.commands.options import GIB, SECONDS, searching, varying, writing
from checker.decide import ALL, AUTO
from checker.engine import Limits, Timers
from checker.isolate import prepared

LISTS = ("properties", "systems", "charts", "requirements", "readings", "repairs", "assumptions", "engines")


@click.command()
@click.argument("ids", nargs=-1, metavar="[ID]...")
@click.option("--system", metavar="NAME", help="Only properties about this system.")
@click.option("--full", is_flag=True, help="Also the properties that take long.")
@click.option("--json", "as_json", is_flag=True, help="Verdicts as JSON.")
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
@click.option("--all-engines", is_flag=True, help="Ask every engine and compare the answers.")
@click.option("--certify", is_flag=True, help="Check every proof again, without the engine that found it.")
@click.option(
    "--certificates",
    type=click.Path(file_okay=False, path_type=Path),
    metavar="DIR",
    help="Write the proofs into this folder.",
)
@varying
@searching
def check(
    ids: tuple[str, ...],
    system: str | None,
    full: bool,
    as_json: bool,
    jobs: int | None,
    memory: float,
    all_engines: bool,
    certify: bool,
    certificates: Path | None,
    chosen: tuple[str, ...],
    repair: str | None,
    dropped: tuple[str, ...],
    engine: str,
    depth: int | None,
    timeout: float | None,
    timers: str,
) -> Exit:
    """Check properties and compare the verdicts with the baseline."""
    with prepared("checker.searches"):
        from checker.commands.check import check as run
        from checker.commands.select import pick_engine, pick_properties
        from checker.commands.variant import pick_variant

        variant = pick_variant(chosen, repair, dropped)
        properties = pick_properties(ids, system, variant.properties(), full)
        if variant.name and not ids:
            properties = list(filter(variant.concerns(), properties))
        if variant.name:
            properties = variant.askable(properties)
        limits = Limits(depth, timeout, int(memory * 2**30), timers=Timers(timers))
        asked = _asked(pick_engine(engine), all_engines)
        certifying = variant.certifying(certificates, certify) if certify or certificates else None
        return run(
            properties,
            variant.systems(),
            asked,
            limits,
            as_json,
            variant.name,
            variant.expected,
            jobs,
            certifying,
        )


def _asked(engine: str, every: bool) -> str:
    """The engines to ask.  Raises ``UsageError`` when one is named and every engine wanted."""
    if every and engine not in (AUTO, ALL):
        raise UsageError(f"--engine {engine} asks one engine and --all-engines every one; write one of them.")
    return ALL if every else engine


@click.command(short_help="Check certificates of proofs again.")
@click.argument("paths", nargs=-1, required=True, metavar="FILE|DIR...", type=click.Path(path_type=Path))
@click.option(
    "--solver",
    type=click.Choice(["bitwuzla", "enumeration", "both"]),
    default="both",
    show_default=True,
    help="Who checks; both: enumeration as well where few ticks are to be tried.",
)
@click.option("--smt2", type=click.Path(path_type=Path), metavar="DIR", help="Write the obligations there.")
@click.option("--timeout", type=SECONDS, metavar="SEC", help="Seconds per certificate.")
@click.option("--verbose", "-v", is_flag=True, help="The whole valuation that refutes a certificate.")
def certify(
    paths: tuple[Path, ...], solver: str, smt2: Path | None, timeout: float | None, verbose: bool
) -> Exit:
    """Check the certificates of proofs again, by other means than found them."""
    from checker.certify.check import By, Effort
    from checker.commands.certifying import certify as run

    return run(paths, Effort(By(solver), timeout), smt2, verbose)


@click.command("list", short_help="List properties, systems, engines and so on.")
@click.argument("what", type=click.Choice(LISTS), metavar="WHAT")
@click.argument("ids", nargs=-1, metavar="[ID]...")
@click.option("--english", is_flag=True, help="What is checked of each property, in words.")
def list_(what: str, ids: tuple[str, ...], english: bool) -> Exit:
    """List WHAT: properties, systems, charts, requirements, readings, repairs, assumptions or engines."""
    from checker.commands.listing import listing

    return listing(what, ids, english)


@click.command(short_help="Show which properties cover each requirement.")
@click.option("--check", "decide", is_flag=True, help="Decide the verdicts now, instead of the baseline's.")
@click.option("--json", "as_json", is_flag=True, help="The matrix as JSON.")
def requirements(decide: bool, as_json: bool) -> Exit:
    """Show which properties cover each requirement; exit code 1 if none does and no reason is given."""
    from checker.commands.requirements import requirements as run

    return run(decide, as_json)


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


@click.command(short_help="Draw a chart, or the reachable states of a system.")
@click.argument("name")
@click.option("--project", metavar="VAR,VAR", help="Variables of the state graph of a system.")
@click.option(
    "--format", default="svg", show_default=True, metavar="FORMAT", help="svg, dot, mermaid, graphml or json."
)
@varying
@writing
def graph(
    name: str,
    project: str | None,
    format: str,
    chosen: tuple[str, ...],
    repair: str | None,
    dropped: tuple[str, ...],
    output: Path | None,
) -> Exit:
    """Draw a chart, or the reachable graph of a system projected on some variables."""
    from checker.commands.graphing import graph as run
    from checker.commands.variant import pick_variant

    return run(name, project, format, pick_variant(chosen, repair, dropped).systems(), output)


@click.command(short_help="Write properties for other model checkers.")
@click.argument("ids", nargs=-1, metavar="PROPERTY...")
@click.option(
    "--system", metavar="NAME", help="Only properties about this system; all of them if none is named."
)
@click.option(
    "--format",
    default="aiger",
    show_default=True,
    metavar="FORMAT",
    help="aiger, aag, btor2, smv or promela.",
)
@varying
@writing
def export(
    ids: tuple[str, ...],
    system: str | None,
    format: str,
    chosen: tuple[str, ...],
    repair: str | None,
    dropped: tuple[str, ...],
    output: Path | None,
) -> Exit:
    """Write properties for other model checkers: a file, or a folder of them."""
    from checker.commands.exporting import export as run
    from checker.commands.variant import pick_variant

    return run(ids, system, format, pick_variant(chosen, repair, dropped), output)


@click.command(short_help="Write the evidence: verdicts, diagrams, findings.")
@click.option("--stale", is_flag=True, help="Write nothing; say what is out of date (exit code 1).")
@writing
def reports(stale: bool, output: Path | None) -> Exit:
    """Write the evidence: verdict table, diagrams, a page per counterexample."""
    from checker.commands.reporting import reports as run

    return run(output or Path("reports"), stale)
