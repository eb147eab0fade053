"""The verb ``check``: properties against the expected verdicts."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from checker.commands.shared.codes import Exit, UsageError
from checker.commands.shared.options import (
    GIB,
    SearchOptions,
    VariantOptions,
    gathered,
    modelling,
    searching,
    varying,
)
from checker.engines import ALL, AUTO, LOADED, Limits

if TYPE_CHECKING:
    from checker.commands.check.chain_status import Chains
    from checker.commands.check.further import CheckExtras
    from checker.commands.check.premises import PremiseSearch
    from checker.commands.shared.variant import Variant


@dataclass(frozen=True)
class CheckOptions:
    """Which properties are asked for, how strictly, and where the verdicts go."""

    ids: tuple[str, ...]
    about: tuple[str, ...]
    full: bool
    strict: bool
    no_premises: bool
    record_premises: bool
    record_invariants: bool
    as_json: bool
    quiet: bool
    jobs: int | None
    memory: float
    all_engines: bool
    certify: bool
    certificates: Path | None
    junit: Path | None
    sarif: Path | None
    annotations: str | None


@click.command(short_help="Check properties, and compare with the expected verdicts.")
@click.argument("ids", nargs=-1, metavar="[ID]...")
@click.option(
    "--system", "about", multiple=True, metavar="NAME", help="Only properties about this system, or these."
)
@click.option("--full", is_flag=True, help="Also the properties that take long.")
@click.option(
    "--strict",
    is_flag=True,
    help="Treat as errors: proofs that are or may be vacuous, and proofs that kill no known mutant.",
)
@click.option("--no-premises", is_flag=True, help="Do not check whether the premises of proofs occur.")
@click.option(
    "--record-premises",
    is_flag=True,
    help="Search longer for the premises of proofs, and record runs in which they occur.",
)
@click.option(
    "--record-invariants",
    is_flag=True,
    help="Record the invariants of proofs: the next check tries them first.",
)
@click.option("--json", "as_json", is_flag=True, help="Verdicts as JSON.")
@click.option("--quiet", "-q", is_flag=True, help="Only what is not as expected, and no progress.")
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
    help="Memory of each search, in GiB.",
)
@click.option("--all-engines", is_flag=True, help="Run every engine and compare the verdicts.")
@click.option("--certify", is_flag=True, help="Check every proof again, without the engine that found it.")
@click.option(
    "--certificates",
    type=click.Path(file_okay=False, path_type=Path),
    metavar="DIR",
    help="Write the proofs into this folder.",
)
@click.option(
    "--junit",
    type=click.Path(dir_okay=False, path_type=Path),
    metavar="FILE",
    help="Write the verdicts as JUnit XML, for Jenkins, GitLab and others.",
)
@click.option(
    "--sarif",
    type=click.Path(dir_okay=False, path_type=Path),
    metavar="FILE",
    help="Write the findings as SARIF 2.1.0, for code scanning and editors.",
)
@click.option(
    "--annotations",
    type=click.Choice(["github"]),
    help="Annotate the lines of a pull request.",
)
@modelling
@varying
@searching
@gathered(CheckOptions, "options")
def check(options: CheckOptions, charts: VariantOptions, search: SearchOptions) -> Exit:
    """Check properties and compare the verdicts with the baseline."""
    from checker.process.isolate import prepared

    with prepared(*LOADED):
        from checker.commands.check.certificates import writable
        from checker.commands.check.findings import Guide, causes
        from checker.commands.check.run import check as run
        from checker.commands.check.run import undelivered
        from checker.commands.shared.select import again, pick_engine, pick_properties
        from checker.model.kept_invariants import invariants_of

        variant = charts.variant()
        properties = pick_properties(
            options.ids, options.about, variant.properties(), options.full, variant.unchanged()
        )
        if variant.name and not options.ids:
            properties = list(filter(variant.concerns(), properties))
        every = not options.ids and not options.about
        chains = _chains(variant) if every and (options.full or variant.name) else None
        if chains is not None:
            properties = list(
                {p.id: p for p in (*properties, *variant.promised(), *chains.links.values())}.values()
            )
        if variant.name:
            properties = variant.askable(properties)
        if options.no_premises and (options.strict or options.record_premises):
            other = "--strict" if options.strict else "--record-premises"
            raise UsageError(f"--no-premises leaves out what {other} needs; write one of them.")
        limits = search.limits(options.memory)
        asked = _engine_choice(pick_engine(search.engine), options.all_engines)
        if options.certificates:
            writable(options.certificates)
        certifying = (
            variant.certifying(options.certificates, options.certify)
            if options.certify or options.certificates
            else None
        )
        systems = variant.systems()
        deliver = undelivered
        if options.junit or options.sarif or options.annotations:
            from checker.commands.check.ci import Reports

            charted = _again(variant.model.options, charts.chosen, charts.repair, charts.dropped)
            reports = Reports(
                systems,
                options.junit,
                options.sarif,
                options.annotations or "",
                variant.name,
                charted,
                options.as_json,
            )
            reports.possible()
            deliver = reports.write
        further = _further(
            variant,
            None
            if options.no_premises
            else _premises(variant, asked, limits, options.jobs, options.quiet, options.record_premises),
            chains,
        )
        if options.record_invariants:
            from checker.commands.check.invariants import InvariantRecorder

            further = replace(further, keep=InvariantRecorder(variant.model, variant.name))
        return run(
            properties,
            systems,
            asked,
            limits,
            options.as_json,
            variant.name,
            variant.expected,
            options.jobs,
            certifying,
            Guide(
                variant.options,
                again(options.ids, options.about, options.full),
                variant.model.by_gravity,
                causes(variant),
            ),
            deliver,
            options.quiet,
            further,
            options.strict,
            invariants_of(variant.model),
        )


def _chains(variant: "Variant") -> "Chains | None":
    """The chains of the rover's promises, checked for holes; a model of a user's own has none."""
    if variant.own is not None:
        return None
    from checker.commands.check.chain_status import Chains

    return Chains(variant)


def _further(variant: "Variant", premises: "PremiseSearch | None", chains: "Chains | None") -> "CheckExtras":
    """What is asked of the verdicts; faults are kept of the charts as they are."""
    from checker.commands.check.further import CheckExtras, noticing

    further = CheckExtras(noticing=None if variant.name else noticing(variant.model))
    if premises is not None:
        further = replace(further, on_result=premises.on_result, cases=premises)
    return further if chains is None else replace(further, chains=chains.standings)


def _premises(
    variant: "Variant", engine: str, limits: Limits, jobs: int | None, quiet: bool, keep: bool
) -> "PremiseSearch":
    """Checks whether the premises of proofs occur, and records the runs if wanted."""
    from checker.commands.check.premises import PremiseSearch, recordable
    from checker.model.kept_runs import file_of, read

    model = variant.model
    if keep:
        recordable(model, variant.name)
    return PremiseSearch(model, variant.systems(), read(file_of(model)), engine, limits, jobs, quiet, keep)


def _again(options: str, chosen: tuple[str, ...], repair: str | None, dropped: tuple[str, ...]) -> str:
    """The options that let another command speak of the same charts."""
    readings, without = [f"--reading {c}" for c in chosen], [f"--without {d}" for d in dropped]
    return " ".join(filter(None, [options, *readings, f"--repair {repair}" if repair else "", *without]))


def _engine_choice(engine: str, every: bool) -> str:
    """The engines to ask.  Raises ``UsageError`` when one is named and every engine wanted."""
    if every and engine not in (AUTO, ALL):
        raise UsageError(f"--engine {engine} asks one engine and --all-engines every one; write one of them.")
    return ALL if every else engine
