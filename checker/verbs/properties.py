"""Verbs about properties: decide them, show why, hand them to others."""

from pathlib import Path

import click

from checker.commands.codes import Exit
from checker.commands.options import SECONDS, modelling, quietly, varying, writing

LISTS = ("properties", "systems", "charts", "requirements", "readings", "repairs", "assumptions", "engines")


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
@click.option(
    "--json", "as_json", is_flag=True, help="The outcomes as JSON (checker/schemas/certify-1.json)."
)
@modelling
@quietly
def certify(
    paths: tuple[Path, ...],
    solver: str,
    smt2: Path | None,
    timeout: float | None,
    verbose: bool,
    as_json: bool,
    model: Path | None,
) -> Exit:
    """Check the certificates of proofs again, by other means than found them."""
    from checker.certify.check import By, Effort
    from checker.commands.certifying import certify as run

    return run(paths, Effort(By(solver), timeout), smt2, verbose, model, as_json)


@click.command("list", short_help="List properties, systems, engines and so on.")
@click.argument("what", type=click.Choice(LISTS), metavar="WHAT")
@click.argument("ids", nargs=-1, metavar="[ID]...")
@click.option("--english", is_flag=True, help="What is checked of each property, in words.")
@click.option("--json", "as_json", is_flag=True, help="The list as JSON (checker/schemas/list-1.json).")
@modelling
def list_(what: str, ids: tuple[str, ...], english: bool, as_json: bool, model: Path | None) -> Exit:
    """List WHAT: properties, systems, charts, requirements, readings, repairs, assumptions or engines."""
    from checker.commands.listing import listing

    return listing(what, ids, english, model, as_json)


@click.command(short_help="Show which properties cover each requirement.")
@click.option("--check", "decide", is_flag=True, help="Decide the verdicts now, instead of the baseline's.")
@click.option("--json", "as_json", is_flag=True, help="The matrix as JSON.")
@modelling
@quietly
def requirements(decide: bool, as_json: bool, model: Path | None) -> Exit:
    """Show which properties cover each requirement; exit code 1 if none does and no reason is given."""
    from checker.commands.requirements import requirements as run

    return run(decide, as_json, model)


@click.command(short_help="Write properties for other model checkers.")
@click.argument("ids", nargs=-1, metavar="PROPERTY...")
@click.option(
    "--system", "about", multiple=True, metavar="NAME", help="All properties about this system, or these."
)
@click.option(
    "--format",
    default="aiger",
    show_default=True,
    metavar="FORMAT",
    help="aiger, aag, btor2, smv or promela.",
)
@modelling
@varying
@writing
@quietly
def export(
    ids: tuple[str, ...],
    about: tuple[str, ...],
    format: str,
    model: Path | None,
    chosen: tuple[str, ...],
    repair: str | None,
    dropped: tuple[str, ...],
    output: Path | None,
) -> Exit:
    """Write properties for other model checkers: a file, or a folder of them."""
    from checker.commands.exporting import export as run
    from checker.commands.variant import pick_variant

    return run(ids, about, format, pick_variant(chosen, repair, dropped, model), output)


@click.command(short_help="Write the evidence: verdicts, diagrams, findings.")
@click.option("--stale", is_flag=True, help="Write nothing; say what is out of date (exit code 1).")
@writing
@quietly
def reports(stale: bool, output: Path | None) -> Exit:
    """Write the evidence: verdict table, diagrams, a page per counterexample."""
    from checker.commands.reporting import reports as run

    return run(output or Path("reports"), stale)
