"""The verb ``check``: properties against the verdicts on record."""

from pathlib import Path

import click

from checker.commands.codes import Exit, UsageError
from checker.commands.options import GIB, searching, varying
from checker.decide import ALL, AUTO
from checker.engine import Limits, Timers
from checker.isolate import prepared


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
