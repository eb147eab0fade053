"""``rovercheck certify``: verdicts derived again from certificates, each checked by other means."""

import re
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

from checker.certify.certificate import Certificate, meaningful
from checker.certify.check import Effort, check, rebuilt
from checker.certify.file import Origin, Written, read
from checker.certify.obligations import obligations
from checker.certify.outcome import Accepted, Outcome, Rejected, Undecided
from checker.certify.reader import Reader
from checker.certify.terms import Malformed
from checker.certify.tick import executed
from checker.commands.codes import Exit, UsageError
from checker.commands.output import out, write
from checker.commands.select import pick
from checker.commands.variant import Variant, pick_variant
from checker.decide import Task, decide
from checker.engine import Limits, Timers, quiet
from checker.result import Result
from checker.verdict import Unknown
from properties.forms import Property
from spec_model.lang.errors import ModelError
from spec_model.lang.system import TransitionSystem

WORKERS = 2
SIGNS = {Accepted: "✓", Rejected: "✗", Undecided: "?"}
_SHOWN = 300


@dataclass(frozen=True)
class Told:
    """What is said of one property of a file."""

    id: str
    outcome: Outcome


@dataclass
class Checking:
    """Checks the certificates of one file; with a folder, writes their obligations there first."""

    stem: str
    effort: Effort
    folder: Path | None
    asked: list[Certificate] = field(default_factory=list)

    def __call__(self, one: Certificate, system: TransitionSystem) -> Outcome:
        if self.folder is not None:
            self._write(self.folder, one, system)
        return check(one, system, self.effort)

    def _write(self, folder: Path, one: Certificate, system: TransitionSystem) -> None:
        self.asked.append(one)
        question = rebuilt(one, executed(system))
        if isinstance(question, Rejected):
            return
        try:
            meaningful(one.invariant, question)
        except Malformed:
            return
        folder.mkdir(parents=True, exist_ok=True)
        for obligation in obligations(question, one.invariant):
            name = re.sub(r"[^\w.-]+", "-", f"{self.stem}-{len(self.asked)}-{obligation.name}")
            write(obligation.script, folder / f"{name}.smt2")


def certify(paths: Sequence[Path], effort: Effort, smt2: Path | None, verbose: bool) -> Exit:
    """One line for each property of the files.  Raises ``UsageError`` for what holds no certificates."""
    written = [(path, _read(path)) for path in files(paths)]
    found: list[Told] = []
    with ThreadPoolExecutor(WORKERS) as pool:
        for told in pool.map(lambda one: told_of(one[0], one[1], effort, smt2), written):
            for one in told:
                out.print(line(one, verbose), markup=False)
            found += told
    return summary(found, len(written))


def files(paths: Sequence[Path]) -> Iterator[Path]:
    """The files named, and all of a folder."""
    for path in paths:
        if not path.is_dir():
            yield path
            continue
        inside = sorted(p for p in path.iterdir() if p.name.endswith((".json", ".json.gz")))
        if not inside:
            raise UsageError(
                f"{path} holds no certificates; rovercheck check --certificates {path} writes some."
            )
        yield from inside


def _read(path: Path) -> Written:
    try:
        return read(path)
    except Malformed as error:
        raise UsageError(f"{path} is no file of certificates: {error}.") from error
    except OSError as error:
        raise UsageError(f"Cannot read {path}: {error.strerror}.") from error


def told_of(path: Path, written: Written, effort: Effort, smt2: Path | None) -> list[Told]:
    """What the certificates of a file show of each property that they are to prove."""
    reader = Reader(written.certificates, Checking(path.name.partition(".json")[0], effort, smt2))
    try:
        results = _decided(written.origin, reader)
    except (UsageError, ModelError, ValueError) as error:
        return [Told(id, Rejected("origin", str(error))) for id in written.origin.proved]
    return [Told(id, _outcome(results[id], reader)) for id in written.origin.proved]


def _decided(origin: Origin, reader: Reader) -> Mapping[str, Result]:
    """The results for all properties of the search, decided again by a reader of certificates."""
    variant = _variant(origin)
    systems, known = variant.systems(), variant.properties()
    properties: tuple[Property, ...] = tuple(pick("property", id, known) for id in origin.properties)
    if any(p.on != origin.system for p in properties):
        raise UsageError(f"{origin.properties[0]} is not about {origin.system}")
    task = Task(pick("system", origin.system, systems), properties)
    limits = Limits(timers=Timers(origin.timers))
    return {r.property.id: r for r in decide(task, systems, reader, limits, quiet)}


def _variant(origin: Origin) -> Variant:
    readings = [f"{id}={choice}" for id, choice in origin.readings.items()]
    return pick_variant(readings, origin.repair or None, origin.without)


def _outcome(one: Result, reader: Reader) -> Outcome:
    """Accepted if the verdict follows; otherwise what is wrong with a certificate of the file."""
    if not isinstance(one.verdict, Unknown):
        if one.verdict.engine != reader.NAME:
            return Undecided(f"{one.verdict.engine} decides it, without a certificate")
        ways = {o.how: None for o in reader.outcomes.values() if isinstance(o, Accepted)}
        return Accepted("; ".join(ways))
    for kind in (Rejected, Undecided):
        for outcome in reader.outcomes.values():
            if isinstance(outcome, kind):
                return outcome
    return Undecided(one.verdict.reason)


def line(told: Told, verbose: bool) -> str:
    """Sign, id, outcome and why."""
    match told.outcome:
        case Accepted(how):
            word, why = "accepted", how
        case Rejected(obligation, shown):
            word, why = "rejected", f"{obligation}: {shown}"
        case Undecided(reason):
            word, why = "undecided", reason
    cut = why if verbose or len(why) <= _SHOWN else f"{why[:_SHOWN]} … (all of it: -v)"
    return f"{SIGNS[type(told.outcome)]} {told.id:<21} {word:<9} {cut}"


def summary(found: Sequence[Told], count: int) -> Exit:
    """Counts, and the exit code."""
    kinds = [type(one.outcome) for one in found]
    words = {Accepted: "accepted", Rejected: "rejected", Undecided: "undecided"}
    counts = ", ".join(f"{kinds.count(k)} {word}" for k, word in words.items() if k in kinds)
    told = counts or "nothing is proved in them"
    out.print(f"\n{len(found)} properties in {count} files: {told}.", markup=False)
    if Rejected in kinds:
        return Exit.CHANGED
    return Exit.INCONCLUSIVE if Undecided in kinds else Exit.AS_EXPECTED if found else Exit.NOTHING
