"""The verb ``check``: properties against the expected verdicts."""

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from rovercheck.checker.cache.places import STORE
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.options import (
    GIB,
    SearchOptions,
    SelectionOptions,
    VariantOptions,
    elsewhere,
    gathered,
    modelling,
    searching,
    selecting,
    varying,
)
from rovercheck.checker.commands.shared.silence import say_more
from rovercheck.checker.engines import LOADED

if TYPE_CHECKING:
    from rovercheck.checker.commands.check.chain_status import Chains
    from rovercheck.checker.commands.check.further import CheckExtras
    from rovercheck.checker.commands.check.premises import PremiseSearch
    from rovercheck.checker.commands.check.run import ResultDelivery
    from rovercheck.checker.commands.check.unchanged import ToldStore
    from rovercheck.checker.commands.shared.told import ToldVerdict
    from rovercheck.checker.model.variant import Variant
    from rovercheck.checker.process.pool import Cluster
    from rovercheck.checker.verify.searches import SearchSettings
    from rovercheck.properties.forms import Property


@dataclass(frozen=True)
class CheckOptions:
    """How strictly properties are checked, and where the verdicts go."""

    strict: bool
    no_premises: bool
    record_premises: bool
    record_invariants: bool
    as_json: bool
    quiet: bool
    verbose: bool
    jobs: int | None
    scheduler: "Cluster | None"
    memory: float
    all_engines: bool
    certify: bool
    certificates: Path | None
    junit: Path | None
    sarif: Path | None
    annotations: str | None
    recheck: bool
    changed: str | None
    watch: bool

    @property
    def writes(self) -> bool:
        """Whether more is wanted than what is printed."""
        written = self.junit, self.sarif, self.annotations, self.record_premises, self.record_invariants
        return any(written)

    def possible(self) -> None:
        """Raises ``UsageError`` for options that exclude each other."""
        if self.watch and (self.as_json or self.writes or self.certificates):
            raise UsageError("--watch tells what changes and writes no file; leave the other options out.")
        if self.no_premises and (self.strict or self.record_premises):
            other = "--strict" if self.strict else "--record-premises"
            raise UsageError(f"--no-premises leaves out what {other} needs; write one of them.")


@click.command(short_help="Check properties, and compare with the expected verdicts.")
@selecting
@click.option(
    "--strict",
    is_flag=True,
    help="Treat as errors: proofs that are or may be vacuous, proofs that kill no known mutant, and findings "
    "whose acceptance has expired.",
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
    "--verbose",
    "-v",
    is_flag=True,
    callback=say_more,
    help="A line for every verdict, also on a terminal, and what the engines do.",
)
@click.option(
    "--jobs",
    type=click.IntRange(min=1),
    metavar="N",
    help="Searches at a time; by default one per processor.",
)
@elsewhere
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
    "--recheck",
    is_flag=True,
    help="Believe no verdict that is kept: replay its run, or check its certificate.",
)
@click.option(
    "--changed",
    is_flag=False,
    flag_value="HEAD",
    metavar="[REV]",
    help="Only what depends on what has changed since a git revision; by default the last commit.",
)
@click.option("--watch", is_flag=True, help="Check again whenever a file is saved, and tell what changes.")
@click.option(
    "--annotations",
    type=click.Choice(["github"]),
    help="Annotate the lines of a pull request.",
)
@modelling
@varying
@searching
@gathered(CheckOptions, "options")
def check(
    selection: SelectionOptions, options: CheckOptions, charts: VariantOptions, search: SearchOptions
) -> Exit:
    """Check properties and compare the verdicts with the baseline."""
    options.possible()
    if options.watch:
        from rovercheck.checker.commands.check.watch import watch

        return watch(_without_watch(), charts.model)
    kept = _kept(options, charts, search)
    if kept is not None and (code := _unchanged(kept, selection, options)) is not None:
        return code
    from rovercheck.checker.process.isolate import prepared

    with prepared(*LOADED):
        from rovercheck.checker.commands.check.findings import Guide, causes
        from rovercheck.checker.commands.check.run import CheckOutput, CheckRequest
        from rovercheck.checker.commands.check.run import check as run
        from rovercheck.checker.commands.check.text import brief
        from rovercheck.checker.commands.shared.variant import askable
        from rovercheck.checker.verify.finding_order import order_of

        variant = charts.variant()
        if selection.whole:
            _ = [*variant.unchanged().values()]  # a fault of any system is told, also of one not asked about
        properties = selection.properties(variant)
        if options.changed is not None:
            properties = _changed(properties, options.changed, variant)
            if not properties:
                return Exit.AS_EXPECTED
        chains = (
            _chains(variant)
            if not options.changed and selection.whole and (selection.full or variant.name)
            else None
        )
        if chains is not None:
            more = *properties, *variant.promised(), *chains.links.values()
            properties = list({p.id: p for p in more}.values())
        chosen = len(properties)
        if variant.name:
            properties = askable(variant, properties)
        settings = _settings(search, options, variant)
        order = order_of(variant.model, variant.systems())
        guide = Guide(variant.options, selection.again, causes(variant))
        deliver = _delivering(options, variant)
        asked = None if selection.whole else {p.id for p in properties}
        further = _further(options, variant, settings, chains, asked)
        code = run(
            CheckRequest(
                properties,
                variant.systems(),
                settings,
                variant.name,
                variant.expected,
                further,
                options.strict,
                _keeping(kept, variant),
                order,
            ),
            CheckOutput(
                options.as_json, options.quiet, guide, brief(len(properties), options.verbose), deliver
            ),
        )
        left_out = variant.changes is not None and len(properties) < chosen
        return Exit.INCONCLUSIVE if left_out and code == Exit.AS_EXPECTED else code


def _without_watch() -> list[str]:
    """The arguments of this command, without --watch."""
    given: list[str] = click.get_current_context().find_root().obj
    return [word for word in given[given.index("check") + 1 :] if word != "--watch"]


def _changed(properties: "Sequence[Property]", revision: str, variant: "Variant") -> "list[Property]":
    """Those of the properties that depend on what has changed since a revision; says how many."""
    from rovercheck.checker.commands.check.changed import changed_since
    from rovercheck.checker.commands.shared.output import counted, err

    if variant.name:
        raise UsageError(f"--changed compares the charts as specified, not {variant.name}; leave one out.")
    concerned = changed_since(revision, variant)
    found = [prop for prop in properties if prop.id in concerned]
    many = f"{len(found)} of {counted(len(properties), 'property', 'properties')}"
    verb = "depends" if len(found) == 1 else "depend"
    err.print(f"{many} {verb} on what has changed since {revision}.", markup=False)
    return found


def _kept(options: CheckOptions, charts: VariantOptions, search: SearchOptions) -> "ToldStore | None":
    """Where it is kept what is told of the rover as specified; None where something else is asked."""
    if charts != VariantOptions() or search.no_store or os.environ.get(STORE) == "":
        return None
    if (
        options.changed
        or options.no_premises
        or options.certify
        or options.certificates
        or options.all_engines
    ):
        return None
    from rovercheck.checker.commands.check.unchanged import ToldStore

    kept = ToldStore.now(search)
    if kept is not None and options.recheck:
        kept.forget()  # it is told anew by the next check, of what holds now
        return None
    return kept


def _unchanged(kept: "ToldStore", selection: SelectionOptions, options: CheckOptions) -> Exit | None:
    """Say again what was told of properties while no file has changed; None where that cannot be done."""
    if options.writes or (selection.whole and selection.full):
        return None
    model = kept.read()
    chosen = model.chosen(selection) if model is not None else None
    if model is None or chosen is None:
        return None
    from rovercheck.checker.commands.check.findings import Guide, causes_of_rover
    from rovercheck.checker.commands.check.text import CheckText, brief
    from rovercheck.checker.commands.shared.told import worst

    told = [replace(one, strict=options.strict) for one in chosen]
    text = CheckText(
        options.as_json,
        options.quiet,
        Guide("", selection.again, causes_of_rover()),
        brief(len(told), options.verbose),
    )
    for one in told:
        text.each(one)
    text.end(told, (), False)
    return worst([one.exit for one in told])


def _keeping(kept: "ToldStore | None", variant: "Variant") -> "Callable[[Sequence[ToldVerdict]], None]":
    """Keeps what was told of the rover."""
    from rovercheck.checker.commands.check.run import unkept

    if kept is None:
        return unkept
    from rovercheck.checker.commands.check.unchanged import ToldModel, ToldProperty, keepable
    from rovercheck.properties.catalogue import as_written

    def keep(found: "Sequence[ToldVerdict]") -> None:
        properties = {id: ToldProperty(p.on, p.costly) for id, p in as_written().items()}
        told = {one.id: replace(one, strict=False) for one in found if keepable(one)}
        kept.add(ToldModel(properties, list(variant.systems()), told))

    return keep


def _settings(search: SearchOptions, options: CheckOptions, variant: "Variant") -> "SearchSettings":
    """How the properties are decided, and what is done with proofs.

    Raises ``UsageError`` for an engine that there is not, or a folder that cannot be written.
    """
    from rovercheck.checker.commands.check.certificates import writable
    from rovercheck.checker.commands.shared.select import pick_engine
    from rovercheck.checker.commands.shared.variant import certifying as certify
    from rovercheck.checker.model.kept_invariants import invariants_of
    from rovercheck.checker.verify.searches import SearchSettings

    limits = search.limits(options.memory)
    engine = pick_engine(search.engine, every=options.all_engines)
    if options.certificates:
        writable(options.certificates)
    wanted = options.certify or options.certificates
    certifying = certify(variant, options.certificates, options.certify) if wanted else None
    return SearchSettings(
        engine,
        limits,
        options.scheduler or options.jobs,
        invariants_of(variant.model),
        certifying,
        None if options.record_invariants else search.store(engine, options.recheck),
        traces=bool(options.junit or options.sarif or options.annotations),
    )


def _delivering(options: CheckOptions, variant: "Variant") -> "ResultDelivery":
    """Writes the reports that are asked for.  Raises ``UsageError`` where one cannot be written."""
    from rovercheck.checker.commands.check.run import undelivered

    if not (options.junit or options.sarif or options.annotations):
        return undelivered
    from rovercheck.checker.commands.check.ci import reporting

    return reporting(options, variant)


def _chains(variant: "Variant") -> "Chains | None":
    """The chains of the rover's promises, checked for holes; a model of a user's own has none."""
    if variant.own is not None:
        return None
    from rovercheck.checker.commands.check.chain_status import Chains

    return Chains(variant)


def _further(
    options: CheckOptions,
    variant: "Variant",
    search: "SearchSettings",
    chains: "Chains | None",
    asked: set[str] | None,
) -> "CheckExtras":
    """What is asked of the verdicts; faults are kept of the charts as they are.

    Of what is kept only that is read which is about the properties ``asked`` for (None: all).
    """
    from rovercheck.checker.commands.check.further import CheckExtras, noticing

    further = CheckExtras(noticing=None if variant.name else noticing(variant.model, asked))
    if not options.no_premises:
        premises = _premises(options, variant, search, asked)
        further = replace(further, on_result=premises.on_result, cases=premises)
    if options.record_invariants:
        from rovercheck.checker.commands.check.invariants import InvariantRecorder

        further = replace(further, keep=InvariantRecorder(variant.model, variant.name))
    return further if chains is None else replace(further, chains=chains.standings)


def _premises(
    options: CheckOptions, variant: "Variant", search: "SearchSettings", asked: set[str] | None
) -> "PremiseSearch":
    """Checks whether the premises of proofs occur, and records the runs if wanted."""
    from rovercheck.checker.commands.check.premises import PremiseSearch, recordable
    from rovercheck.checker.model.kept_runs import file_of, read

    model, keep = variant.model, options.record_premises
    if keep:
        recordable(model, variant.name)
    return PremiseSearch(
        model, variant.systems(), read(file_of(model), only=asked), search, options.quiet, keep
    )
