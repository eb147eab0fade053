"""``rovercheck certify``: verdicts derived again from certificates, each checked by other means."""

from collections import Counter
from collections.abc import Generator, Iterator, Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from shlex import quote

from rovercheck.checker.certify.check import CheckEffort
from rovercheck.checker.certify.file import CertificateFile, Unwritable, read
from rovercheck.checker.certify.outcome import Accepted, Rejected, Undecided
from rovercheck.checker.certify.terms import Malformed
from rovercheck.checker.commands.certify.derive import DerivedVerdict, VerdictDerivation
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import counted, out, wrapped
from rovercheck.checker.commands.shared.progress import ProgressLine
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.engines import Limits
from rovercheck.checker.io.printable import json_text
from rovercheck.checker.model.load import load
from rovercheck.checker.process.pool import Order, Pool

WORKERS = 2
WHY = 34
"""The column in which the reason of an outcome begins."""
SIGNS = {Accepted: "✓", Rejected: "✗", Undecided: "?"}
WORDS = {Accepted: "accepted", Rejected: "rejected", Undecided: "undecided"}
_SHOWN = 300


def certify(
    paths: Sequence[Path],
    effort: CheckEffort,
    smt2: Path | None,
    verbose: bool,
    model: Path | None = None,
    as_json: bool = False,
) -> Exit:
    """One line for each property of the files, in no particular order of the files; or all of it as JSON.

    They are about the rover, or the model at a path.  Each file is checked in a child process, which may
    die of it.  Raises ``UsageError`` for what holds no certificates, and for a folder that cannot be
    written, ``ModelError`` for a model without meaning.
    """
    if model is not None:
        load(model)
    written = [(path, _read(path)) for path in files(paths)]
    if smt2 is not None:
        _folder(smt2)
    found: list[DerivedVerdict] = []
    deriving = VerdictDerivation(effort, smt2, model)
    with ProgressLine() as progress, closing(_report(written, deriving, progress)) as heard:
        for told in heard:
            if not as_json:
                out.print(wrapped(line(told, verbose, several=len(written) > 1), WHY), markup=False)
            found.append(told)
    if as_json:
        from rovercheck.checker.commands.certify.document import document

        print(json_text(document(found, len(written), code(found))))
    else:
        summary(found, len(written))
    return code(found)


def files(paths: Sequence[Path]) -> Iterator[Path]:
    """The files named, and all of a folder."""
    for path in paths:
        if not path.is_dir():
            yield path
            continue
        inside = sorted(p for p in _inside(path) if p.name.endswith((".json", ".json.gz")))
        if not inside:
            writes = whole(f"rovercheck check --certificates {quote(str(path))}")
            raise UsageError(f"{whole(path)} holds no certificates; {writes} writes some.")
        yield from inside


def _inside(folder: Path) -> list[Path]:
    try:
        return list(folder.iterdir())
    except OSError as error:
        raise UsageError(f"Cannot read {whole(folder)}: {error.strerror}.") from error


def _read(path: Path) -> CertificateFile:
    try:
        return read(path)
    except Malformed as error:
        raise UsageError(f"{whole(path)} is no file of certificates: {shown(str(error))}.") from error
    except OSError as error:
        raise UsageError(f"Cannot read {whole(path)}: {error.strerror}.") from error


def _folder(place: Path) -> None:
    try:
        place.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"Cannot write {whole(place)}: {error.strerror}. Choose another --smt2.") from error


def _report(
    written: Sequence[tuple[Path, CertificateFile]], deriving: VerdictDerivation, progress: ProgressLine
) -> Generator[DerivedVerdict, None, None]:
    """What is said of each property that some file is to prove, as it is found."""
    left = [dict.fromkeys(found.origin.proved) for _, found in written]
    stems = Counter[str]()
    orders = []
    for path, found in written:
        stem = path.name.partition(".json")[0]
        stems[stem] += 1
        orders.append(Order((f"{stem}-{stems[stem]}" if stems[stem] > 1 else stem, found)))
    done = 0
    pool = Pool(WORKERS, _itself, (deriving,), Limits().memory)
    with closing(pool.run(orders)) as events:
        for event in events:
            file = str(written[event.number][0])
            match event.message:
                case Unwritable() as error:
                    raise UsageError(str(error))
                case DerivedVerdict() as told:
                    del left[event.number][told.id]
                    yield replace(told, file=file)
            if event.done:
                done += 1
                progress.show(f"{done} of {counted(len(written), 'file', 'files')} checked")
                reason = event.failure or "the check ended without a word on it"
                yield from (DerivedVerdict(id, Undecided(reason), file=file) for id in left[event.number])


def _itself(deriving: VerdictDerivation) -> VerdictDerivation:
    return deriving


def line(told: DerivedVerdict, verbose: bool, several: bool = False) -> str:
    """Sign, id, outcome and why; of ``several`` files also in which one what is not accepted stands."""
    match told.outcome:
        case Accepted(how):
            why = f"{told.verdict}: {how}"
        case Rejected(obligation, counterexample):
            why = f"{obligation}: {counterexample}"
        case Undecided(reason):
            why = reason
    word = WORDS[type(told.outcome)]
    if several and not isinstance(told.outcome, Accepted):
        why = f"{told.file}: {why}"
    cut = why if verbose or len(why) <= _SHOWN else f"{why[:_SHOWN]} … (all of it: -v)"
    return f"{SIGNS[type(told.outcome)]} {shown(f'{told.id:<21} {word:<9} {cut}')}"


def shown(text: str) -> str:
    """What a file says, in one line: no character in it moves the cursor or begins a new line."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


def code(found: Sequence[DerivedVerdict]) -> Exit:
    """What is rejected counts first, then what is not decided."""
    kinds = [type(one.outcome) for one in found]
    if Rejected in kinds:
        return Exit.FAILED
    return Exit.INCONCLUSIVE if Undecided in kinds else Exit.AS_EXPECTED if found else Exit.NOTHING


def summary(found: Sequence[DerivedVerdict], count: int) -> None:
    """Counts."""
    kinds = [type(one.outcome) for one in found]
    counts = ", ".join(f"{kinds.count(k)} {word}" for k, word in WORDS.items() if k in kinds)
    told = counts or "nothing is proved in them"
    size = f"{counted(len(found), 'property', 'properties')} in {counted(count, 'file', 'files')}"
    out.print(f"\n{size}: {told}.", markup=False)
