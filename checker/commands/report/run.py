"""``rovercheck report``: everything a reviewer wants to see, in one HTML file that needs nothing else."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

from rovercheck.checker.certify.file import Unwritable
from rovercheck.checker.commands.check.findings import Guide
from rovercheck.checker.commands.check.premises import LONG, PATIENCE, cases, patient
from rovercheck.checker.commands.report import PageOptions
from rovercheck.checker.commands.report.causes import CauseSearch, with_reasons
from rovercheck.checker.commands.report.data import Extras, concerned, reviewed
from rovercheck.checker.commands.report.graphs import state_graphs
from rovercheck.checker.commands.report.kept_page import KeptPage, PageKeeper, delivered
from rovercheck.checker.commands.report.origin import origin
from rovercheck.checker.commands.report.rover import extras
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.dependencies import of_verdict
from rovercheck.checker.commands.shared.output import err
from rovercheck.checker.commands.shared.told import told
from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.commands.trace.explain import SECONDS
from rovercheck.checker.model import Model
from rovercheck.checker.model.kept_runs import file_of, read
from rovercheck.checker.model.variant import Variant
from rovercheck.checker.render.review import render
from rovercheck.checker.store.parts import UNKEPT, PartStore
from rovercheck.checker.verify.checked import CheckedProperty, PremiseCase, worst
from rovercheck.checker.verify.finding_order import order_of
from rovercheck.checker.verify.searches import SearchSettings
from rovercheck.properties.forms import Property
from rovercheck.spec_model.rover import left_to_read


def report(
    variant: Variant,
    properties: Sequence[Property],
    search: SearchSettings,
    options: PageOptions,
    output: Path,
    keeper: PageKeeper | None = None,
) -> Exit:
    """Decide the properties and write the page, all of it or nothing; a ``keeper`` keeps it.

    Raises ``UsageError`` where a file cannot be written or printed, and ``ModelError``, before anything is
    searched, where a chart was edited in a place that an alternative interpretation changes.
    """
    if not properties:
        err.print("Nothing to report on: the selection holds no property.")
        return Exit.NOTHING
    if variant.own is None:  # what verdicts depend on is found with these
        for name in sorted({prop.on for prop in properties}):
            left_to_read(name)
    model = replace(variant.model, systems=variant.systems())
    known = read(file_of(variant.model)) if options.premises is not False else {}
    found: list[CheckedProperty] = []
    try:
        for result in results(properties, model.systems, search):
            found.append(CheckedProperty(result, variant.expected(result.property.id), variant.name))
        without_cause = 0
        if options.explain is not False:
            seconds = None if options.explain else SECONDS
            causes = CauseSearch(search.store, seconds, kept_only=options.at_once)
            found = with_reasons(found, model.systems, causes)
            without_cause = len(causes.left)
        cases_known: Mapping[str, PremiseCase] = {}
        if options.premises is not False:
            asked = patient(search, LONG if options.premises else PATIENCE)
            cases_known = cases(found, model.systems, asked, known)
        html = page(model, variant, found, options, cases_known, PartStore(search.store), without_cause)
        made = KeptPage(html, [told(one, order_of(model)) for one in found], worst(found))
        if keeper is not None:
            keeper.write(made)
        return delivered(made, Guide(variant.options), output, options.pdf)
    except Unwritable as error:
        raise UsageError(str(error)) from error
    except KeyboardInterrupt:
        err.print(f"Interrupted: {len(found)} of {len(properties)} properties decided; nothing was written.")
        return Exit.INTERRUPTED


def page(
    model: Model,
    variant: Variant,
    found: Sequence[CheckedProperty],
    options: PageOptions,
    cases_known: Mapping[str, PremiseCase] | None = None,
    kept: PartStore = UNKEPT,
    without_cause: int = 0,
) -> str:
    """The page on verdicts that were found; ``cases_known``: which cases of proofs occur, by id.

    Parts of it that are ``kept`` are not made again; of so many findings nobody has looked for the cause.
    """
    own = (
        extras(variant, found, not options.no_repairs, kept, options.at_once)
        if model.path is None
        else Extras(depends=partial(of_verdict, variant=variant))
    )
    graphs, undrawn = state_graphs(
        found, concerned(found, model), model.options, kept, kept_only=options.at_once
    )
    own = replace(own, premises=cases_known or {}, graphs=graphs, undrawn=undrawn)
    made = replace(origin(model, variant, worst(found), options), without_cause=without_cause)
    return render(reviewed(model, found, made, own, not options.some))
