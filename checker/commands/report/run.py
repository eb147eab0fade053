"""``rovercheck report``: everything a reviewer wants to see, in one HTML file that needs nothing else."""

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path

from checker.certify.file import Unwritable
from checker.commands.check.findings import Guide
from checker.commands.check.premises import LONG, PremiseCase, cases
from checker.commands.check.run import ComparedResult, results, summary, worst
from checker.commands.report.causes import with_reasons
from checker.commands.report.data import Extras, concerned, reviewed
from checker.commands.report.graphs import state_graphs
from checker.commands.report.rover import extras
from checker.commands.shared.codes import Exit, UsageError
from checker.commands.shared.output import counted, err, out, write
from checker.commands.shared.text_wrap import whole
from checker.commands.shared.variant import Variant
from checker.engines import AUTO, Limits
from checker.model import Model
from checker.model.kept_invariants import invariants_of
from checker.model.kept_runs import file_of, read
from checker.render.review import render
from checker.render.review.model import ReviewOrigin
from checker.verify.certificates import Certification
from properties.forms import Property

PACKAGES = ("rovercheck", "z3-solver", "bitwuzla", "llvmlite", "python-sat", "oxidd", "numpy", "networkx")
"""The tool, its solvers, and what else a verdict may rest on."""
NO_LIMITS = Limits()
MEANINGS = {
    Exit.AS_EXPECTED: "every verdict is as expected",
    Exit.FAILED: "a verdict is not as expected",
    Exit.INCONCLUSIVE: "a limit was reached",
    Exit.INTERNAL: "the proof of a verdict was rejected",
}


@dataclass(frozen=True)
class ReportOptions:
    """What the command line asks for.

    ``command`` is the line itself; ``whole`` says that no selection was made, ``date`` is shown as given.
    ``repairs`` and ``premises`` are decided too, and the causes of counterexamples are looked for, if wanted.
    """

    command: str
    whole: bool
    repairs: bool = True
    premises: bool = False
    explain: bool = False
    date: str = ""


def report(
    variant: Variant,
    properties: Sequence[Property],
    asked: ReportOptions,
    output: Path,
    engine: str = AUTO,
    limits: Limits = NO_LIMITS,
    jobs: int | None = None,
    certifying: Certification | None = None,
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
    known = read(file_of(variant.model)) if asked.premises else {}
    found: list[ComparedResult] = []
    try:
        for result in results(
            properties, model.systems, engine, limits, jobs, certifying, invariants=invariants_of(model)
        ):
            found.append(ComparedResult(result, variant.expected(result.property.id), variant.name))
        if asked.explain:
            found = with_reasons(found, model.systems)
        told = (
            cases(found, model.systems, known, engine, limits, jobs, patience=LONG) if asked.premises else {}
        )
        write(page(model, variant, found, asked, told), output)
    except Unwritable as error:
        raise UsageError(str(error)) from error
    except KeyboardInterrupt:
        err.print(f"Interrupted: {len(found)} of {len(properties)} properties decided; nothing was written.")
        return Exit.INTERRUPTED
    summary(found, Guide(variant.options))
    out.print(f"{whole(output)}: {counted(output.stat().st_size, 'byte', 'bytes')}.", markup=False)
    return worst(found)


def page(
    model: Model,
    variant: Variant,
    found: Sequence[ComparedResult],
    asked: ReportOptions,
    told: Mapping[str, PremiseCase] | None = None,
) -> str:
    """The page on verdicts that were found; ``told`` says of cases of proofs whether they occur, by id."""
    own = extras(variant, found, asked.repairs) if model.path is None else Extras()
    graphs, undrawn = state_graphs(found, concerned(found, model), model.options)
    own = replace(own, premises=told or {}, graphs=graphs, undrawn=undrawn)
    return render(reviewed(model, found, origin(model, variant, worst(found), asked), own, asked.whole))


def origin(model: Model, variant: Variant, code: Exit, asked: ReportOptions) -> ReviewOrigin:
    """How the page is made; nothing about the machine or the time, unless the user gave a date."""
    meaning = MEANINGS[code]
    return ReviewOrigin(
        asked.command, int(code), meaning, tuple(versions()), digests(model), asked.date, variant.name
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
    found = find_spec(package)
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
