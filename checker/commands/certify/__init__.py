"""The verb ``certify``: proofs checked again."""

from dataclasses import dataclass
from pathlib import Path

import click

from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.options import SECONDS, gathered, modelling, quietly


@dataclass(frozen=True)
class CertificationOptions:
    """How the proofs are checked, and how much is said."""

    solver: str
    smt2: Path | None
    timeout: float | None
    verbose: bool
    as_json: bool


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
@click.option("--verbose", "-v", is_flag=True, help="The whole state that refutes a certificate.")
@click.option(
    "--json", "as_json", is_flag=True, help="The outcomes as JSON (checker/schemas/certify-1.json)."
)
@modelling
@quietly
@gathered(CertificationOptions, "options")
def certify(paths: tuple[Path, ...], options: CertificationOptions, model: Path | None) -> Exit:
    """Check the certificates of proofs again, by other means than found them."""
    from rovercheck.checker.certify.check import CheckEffort, CheckMethod
    from rovercheck.checker.commands.certify.run import certify as run
    from rovercheck.checker.extras import CERTIFICATES

    method = CheckMethod(options.solver)
    if method is not CheckMethod.ENUMERATION and not CERTIFICATES.installed:
        raise UsageError(f"{CERTIFICATES.needed(f'--solver {method}')}. Or write --solver enumeration.")
    return run(
        paths,
        CheckEffort(method, options.timeout),
        options.smt2,
        options.verbose,
        model,
        options.as_json,
    )
