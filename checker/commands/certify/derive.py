"""Verdicts of one file of certificates, derived again from the charts as they are now."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import count
from pathlib import Path

from rovercheck.checker.certify.certificate import Certificate, meaningful
from rovercheck.checker.certify.check import CheckEffort, check, rebuilt
from rovercheck.checker.certify.file import CertificateFile, CertificateOrigin, Unwritable
from rovercheck.checker.certify.obligations import obligations, too_long
from rovercheck.checker.certify.outcome import Accepted, Outcome, Rejected, Undecided
from rovercheck.checker.certify.reader import CertificateReader
from rovercheck.checker.certify.terms import Malformed
from rovercheck.checker.certify.tick import executed
from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.commands.shared.select import pick
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.commands.shared.variant import pick_variant
from rovercheck.checker.engines import Limits, Timers
from rovercheck.checker.io.files import replaced
from rovercheck.checker.model.variant import Variant
from rovercheck.checker.process.isolate import Send
from rovercheck.checker.results.verdict import Unknown
from rovercheck.checker.verify.decide import Task, decide
from rovercheck.checker.verify.result import Result
from rovercheck.properties.forms import Property, Unbounded
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System, TransitionSystem


@dataclass(frozen=True)
class DerivedVerdict:
    """What is said of one property of a file, and the verdict that was derived: ``proved of relay``."""

    id: str
    outcome: Outcome
    verdict: str = ""
    file: str = ""


@dataclass(frozen=True)
class VerdictDerivation:
    """Derives the verdicts of files, in a child process; with a folder, writes their obligations first.

    ``model`` is where the model is that they are about, None for the rover.
    """

    effort: CheckEffort
    folder: Path | None
    model: Path | None = None

    def __call__(self, send: Send, stem: str, written: CertificateFile) -> None:
        """Send a ``DerivedVerdict`` for each property that the file is to prove, or ``Unwritable``."""
        try:
            for one in derived_verdicts(
                written, CertificateCheck(stem, self.effort, self.folder), self.model
            ):
                send(one)
        except Unwritable as error:
            send(error)


@dataclass
class CertificateCheck:
    """Checks the certificates of one file; with a folder, writes their obligations there first."""

    stem: str
    effort: CheckEffort
    folder: Path | None
    numbers: Iterator[int] = field(default_factory=lambda: count(1))

    def __call__(self, one: Certificate, system: TransitionSystem) -> Outcome:
        if self.folder is not None:
            self._write(self.folder, one, system)
        return check(one, system, self.effort)

    def _write(self, folder: Path, one: Certificate, system: TransitionSystem) -> None:
        """Raises ``Unwritable``."""
        number, asked = next(self.numbers), rebuilt(one, executed(system))
        if isinstance(asked, Rejected):
            return
        try:
            meaningful(one.invariant, asked)
        except Malformed:
            return
        if too_long(asked, one.invariant):
            return
        for position, obligation in enumerate(obligations(asked, one.invariant), 1):
            name = re.sub(r"[^\w.-]+", "-", f"{self.stem}-{number}.{position}-{obligation.name}")
            target = folder / f"{name}.smt2"
            try:
                replaced(target, obligation.script.encode())
            except OSError as error:
                raise Unwritable(
                    f"Cannot write {whole(target)}: {error.strerror}. Choose another --smt2."
                ) from error


def derived_verdicts(
    written: CertificateFile, checking: CertificateCheck, model: Path | None = None
) -> list[DerivedVerdict]:
    """What the certificates of a file show of each property that it is to prove.

    ``model`` is the path of a model of the user's own.  Raises ``Unwritable``.
    """
    reader, origin = CertificateReader(written.certificates, checking), written.origin
    try:
        variant = _variant(origin, model)
        systems = variant.systems()
        results = _decided(origin, variant, systems, reader)
    except (UsageError, ModelError, ValueError) as error:
        return [DerivedVerdict(id, Rejected("origin", str(error))) for id in origin.proved]
    return [
        DerivedVerdict(id, _outcome(results[id], reader), _verdict(results[id], variant, systems))
        for id in origin.proved
    ]


def _decided(
    origin: CertificateOrigin, variant: Variant, systems: Mapping[str, System], reader: CertificateReader
) -> Mapping[str, Result]:
    """The results for all properties of the search, decided again by a reader of certificates."""
    known = variant.properties()
    properties: tuple[Property, ...] = tuple(
        variant.asked(pick("property", id, known)) for id in origin.properties
    )
    if any(p.on != origin.system for p in properties):
        raise UsageError(f"{origin.properties[0]} is not about {origin.system}")
    if len({isinstance(p.form, Unbounded) for p in properties}) > 1:
        raise UsageError("no search has both properties with a bound and properties without one")
    task = Task(pick("system", origin.system, systems), properties)
    limits = Limits(timers=Timers(origin.timers))
    return {r.property.id: r for r in decide(task, systems, reader, limits)}


def _variant(origin: CertificateOrigin, model: Path | None) -> Variant:
    interpretations = [f"{id}={choice}" for id, choice in origin.interpretations.items()]
    variant = pick_variant(interpretations, origin.repair or None, origin.without, model)
    if not origin.changes:
        return variant
    from rovercheck.checker.commands.shared.changes import changes_of
    from rovercheck.checker.diagnosis.variant import BoardVariant, VariantError, WrittenChange

    [board, *_], *rows = origin.changes
    try:
        written = BoardVariant(board, tuple(WrittenChange(*row) for row in rows))
        return replace(variant, changes=changes_of(Path("the certificate"), written, variant))
    except (VariantError, TypeError) as error:
        raise UsageError(f"its changes do not fit the charts: {error}") from error


def _outcome(one: Result, reader: CertificateReader) -> Outcome:
    """Accepted if the verdict follows; otherwise what is wrong with a certificate of the file."""
    if not isinstance(one.verdict, Unknown):
        if one.verdict.engine != reader.NAME:
            return Undecided(f"{one.verdict.engine} decides it, without a certificate")
        return Accepted(reader.ways)
    for kind in (Rejected, Undecided):
        for outcome in reader.outcomes.values():
            if isinstance(outcome, kind):
                return outcome
    return Undecided(one.verdict.reason)


def _verdict(one: Result, variant: Variant, systems: Mapping[str, System]) -> str:
    """The verdict and what it is about: the system, how it is changed, and whether it has too few runs."""
    system = systems.get(one.system, systems[one.property.on])
    word = f"{one.verdict.word} for a restricted model" if system.under else one.verdict.word
    return " ".join(part for part in (word, "of", one.system, variant.name) if part)
