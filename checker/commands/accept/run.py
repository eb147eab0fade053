"""``rovercheck accept``: decisions on findings, written into the baseline of the model."""

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from datetime import date
from pathlib import Path

from rovercheck.checker.commands.accept import AcceptOptions
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import err, out, write
from rovercheck.checker.commands.shared.select import pick
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.model import Model, shown
from rovercheck.checker.model.baseline_edit import edited, file_of
from rovercheck.checker.model.load import load
from rovercheck.checker.model.rover import rover
from rovercheck.checker.model.texts import HIDDEN
from rovercheck.properties.expected import Acceptance, VerdictWord, on_record


@dataclass(frozen=True)
class Decision:
    """What is decided about a finding: an acceptance, or None where it is open again."""

    id: str
    acceptance: Acceptance | None


def accept(options: AcceptOptions, path: Path | None = None, today: date | None = None) -> Exit:
    """Write the decisions into the baseline, all of them or none.

    Exit code 2 if a finding that is not on record is not decided in time.  Raises ``UsageError`` or
    ``ModelError``, then nothing is written.
    """
    day = today or date.today()
    decisions = list(_decisions(options, day))
    model = rover() if path is None else load(path)
    _possible(decisions, model)
    known = model.on_record
    new = [one.id for one in decisions if one.id not in known or known[one.id].verdict == "proved"]
    verdicts = _decided(new, model)
    if undecided := [id for id, word in verdicts.items() if word == "unknown"]:
        err.print(
            f"Not decided: {', '.join(undecided)}. Nothing is written: there is no finding to accept. "
            "See rovercheck check with a longer --timeout.",
            markup=False,
        )
        return Exit.INCONCLUSIVE
    if proved := [id for id, word in verdicts.items() if word == "proved"]:
        raise UsageError(f"{_several(proved)} proved: there is nothing to accept.")
    file = file_of(model)
    text = edited(file, {one.id: one.acceptance for one in decisions}, verdicts, day)
    on_record(tomllib.loads(text), model.properties, shown(file), model.hazards)
    write(text, file)
    for one in decisions:
        said = f"accepted {one.acceptance.term}".rstrip() if one.acceptance else "open again"
        out.print(f"{one.id} is {said}: {whole(shown(file))}", markup=False)
    return Exit.AS_EXPECTED


def _decisions(options: AcceptOptions, today: date) -> Iterator[Decision]:
    """What the command line, or the file that it names, decides.  Raises ``UsageError``."""
    given = [options.because, options.until, options.owner, options.withdraw or None, options.ids or None]
    if options.source is not None:
        if any(one is not None for one in given):
            raise UsageError("--from brings ids, reasons and all; leave out what else is written.")
        yield from _from_file(options.source, today)
        return
    if not options.ids:
        raise UsageError("Nothing is named: write an ID with --because, or --from with a file of decisions.")
    if options.withdraw:
        if any(one is not None for one in given[:3]):
            raise UsageError("--withdraw takes no --because, --until or --owner; leave them out.")
        yield from (Decision(id, None) for id in dict.fromkeys(options.ids))
        return
    one = _acceptance(options.because or "", options.owner or "", options.until, today)
    yield from (Decision(id, one) for id in dict.fromkeys(options.ids))


def _from_file(file: Path, today: date) -> Iterator[Decision]:
    from rovercheck.checker.commands.accept.document import read

    seen = set[str]()
    for row in read(file):
        id = row["id"]
        if id in seen:
            raise UsageError(f"{whole(file)} decides {id} twice; delete one.")
        seen.add(id)
        if row["decision"] == "open":
            yield Decision(id, None)
            continue
        until = date.fromisoformat(row["until"]) if row.get("until") else None
        try:
            yield Decision(id, _acceptance(row.get("because", ""), row.get("owner", ""), until, today))
        except UsageError as error:
            raise UsageError(f"{whole(file)}, {id}: {error}") from error


def _acceptance(because: str, owner: str, until: date | None, today: date) -> Acceptance:
    reason, name = (" ".join(text.split()) for text in (because, owner))
    if not reason:
        raise UsageError("There is no reason: write --because with a sentence that says why it is accepted.")
    for text in (reason, name):
        if HIDDEN.search(text):
            raise UsageError(f"{text!r} has signs that cannot be shown. Write it without them.")
    if until is not None and until < today:
        raise UsageError(f"{until} is over; name a day from {today} on, or none.")
    return Acceptance(reason, name, today, until)


def _possible(decisions: Sequence[Decision], model: Model) -> None:
    """Raises ``UsageError`` for what is no property, or not accepted where that is taken back."""
    for one in decisions:
        pick("property", one.id, model.stated())
        if one.acceptance is None and model.expected(one.id).accepted is None:
            raise UsageError(f"{one.id} is not accepted: there is nothing to take back.")


def _decided(ids: Sequence[str], model: Model) -> Mapping[str, VerdictWord]:
    """The verdicts on properties that no entry speaks of, searched for now."""
    if not ids:
        return {}
    from rovercheck.checker.commands.shared.verdicts import results
    from rovercheck.checker.model.kept_invariants import invariants_of
    from rovercheck.checker.verify.searches import SearchSettings

    wanted = [model.properties[id] for id in ids]
    search = SearchSettings(invariants=invariants_of(model))
    with closing(results(wanted, model.systems, search)) as found:
        return {one.property.id: one.verdict.word for one in found}


def _several(ids: Sequence[str]) -> str:
    return f"{', '.join(ids)} {'is' if len(ids) == 1 else 'are'}"
