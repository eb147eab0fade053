"""``rovercheck report``: everything a reviewer wants to see, in one HTML file that needs nothing else."""

import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path

from rovercheck.checker.certify.file import Unwritable
from rovercheck.checker.commands.check.findings import Guide
from rovercheck.checker.commands.check.premises import LONG, cases, patient
from rovercheck.checker.commands.check.text import summary
from rovercheck.checker.commands.report import PageOptions
from rovercheck.checker.commands.report.causes import with_reasons
from rovercheck.checker.commands.report.data import Extras, concerned, reviewed
from rovercheck.checker.commands.report.graphs import state_graphs
from rovercheck.checker.commands.report.rover import extras
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.dependencies import of_verdict
from rovercheck.checker.commands.shared.output import counted, err, out, write
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.commands.shared.told import told
from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.model import Model
from rovercheck.checker.model.kept_runs import file_of, read
from rovercheck.checker.model.variant import Variant
from rovercheck.checker.render.review import render
from rovercheck.checker.render.review.model import ReviewOrigin
from rovercheck.checker.verify.checked import CheckedProperty, PremiseCase, worst
from rovercheck.checker.verify.searches import SearchSettings
from rovercheck.properties.forms import Property

PACKAGES = ("rovercheck", "z3-solver", "bitwuzla", "llvmlite", "python-sat", "oxidd", "numpy", "networkx")
"""The tool, its solvers, and what else a verdict may rest on."""
MEANINGS = {
    Exit.AS_EXPECTED: "every verdict is as expected",
    Exit.FAILED: "a verdict is not as expected",
    Exit.INCONCLUSIVE: "a limit was reached",
    Exit.INTERNAL: "the proof of a verdict was rejected",
}


def report(
    variant: Variant,
    properties: Sequence[Property],
    search: SearchSettings,
    options: PageOptions,
    output: Path,
) -> Exit:
    """Decide the properties and write the page, all of it or nothing.

    Raises ``UsageError`` where the file cannot be written, before anything is searched if that is certain.
    """
    if not properties:
        err.print("Nothing to report on: the selection holds no property.")
        return Exit.NOTHING
    if not output.parent.is_dir() or output.is_dir():
        raise UsageError(
            f"Cannot write {whole(output)}: it is no file in a folder that exists. Choose another --output."
        )
    model = replace(variant.model, systems=variant.systems())
    known = read(file_of(variant.model)) if options.premises else {}
    found: list[CheckedProperty] = []
    try:
        for result in results(properties, model.systems, search):
            found.append(CheckedProperty(result, variant.expected(result.property.id), variant.name))
        if options.explain:
            found = with_reasons(found, model.systems)
        shown = cases(found, model.systems, patient(search, LONG), known) if options.premises else {}
        write(page(model, variant, found, options, shown), output)
    except Unwritable as error:
        raise UsageError(str(error)) from error
    except KeyboardInterrupt:
        err.print(f"Interrupted: {len(found)} of {len(properties)} properties decided; nothing was written.")
        return Exit.INTERRUPTED
    summary([told(one, model.systems) for one in found], Guide(variant.options))
    out.print(f"{whole(output)}: {counted(output.stat().st_size, 'byte', 'bytes')}.", markup=False)
    return worst(found)


def page(
    model: Model,
    variant: Variant,
    found: Sequence[CheckedProperty],
    options: PageOptions,
    cases_known: Mapping[str, PremiseCase] | None = None,
) -> str:
    """The page on verdicts that were found; ``cases_known``: which cases of proofs occur, by id."""
    own = (
        extras(variant, found, not options.no_repairs)
        if model.path is None
        else Extras(depends=partial(of_verdict, variant=variant))
    )
    graphs, undrawn = state_graphs(found, concerned(found, model), model.options)
    own = replace(own, premises=cases_known or {}, graphs=graphs, undrawn=undrawn)
    return render(
        reviewed(model, found, origin(model, variant, worst(found), options), own, not options.some)
    )


def origin(model: Model, variant: Variant, code: Exit, options: PageOptions) -> ReviewOrigin:
    """How the page is made; nothing about the machine or the time, unless the user gave a date."""
    meaning = MEANINGS[code]
    return ReviewOrigin(
        options.command, int(code), meaning, tuple(versions()), digests(model), options.date, variant.name
    )


def versions() -> list[tuple[str, str]]:
    """The versions of Python and of each package that is installed."""
    found = [("Python", ".".join(map(str, sys.version_info[:3])))]
    for name in PACKAGES:
        try:
            found.append((name, version(name)))
        except PackageNotFoundError:
            found.append((name, "not installed"))
    return found


def digests(model: Model) -> tuple[tuple[str, str], ...]:
    """What was checked, as SHA-256 of its sources: each name and content, in the order of the names."""
    if model.path is not None:
        return ((str(model.name), digest(model.path)),)
    return tuple((name, digest(_folder(name))) for name in ("spec_model", "properties"))


def _folder(package: str) -> Path:
    found = find_spec(f"rovercheck.{package}")
    assert found is not None and found.submodule_search_locations
    return Path(next(iter(found.submodule_search_locations)))


def digest(place: Path) -> str:
    """SHA-256 of a file, or of all sources in a folder."""
    if place.is_file():
        return sha256(place.read_bytes()).hexdigest()
    whole = sha256()
    for file in sorted(f for f in place.rglob("*") if f.suffix in (".py", ".toml")):
        whole.update(f"{file.relative_to(place).as_posix()}\0".encode())
        whole.update(sha256(file.read_bytes()).digest())
    return whole.hexdigest()
