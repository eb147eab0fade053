"""What came of checking proofs again, in words: one for a verdict, a few lines for all of them."""

import os
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryFile

from rovercheck.checker.certify.outcome import Accepted, Outcome, Rejected, Undecided
from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.commands.shared.output import err, out
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.verify.result import Result


def writable(folder: Path) -> None:
    """Raises ``UsageError`` if no certificates can be written there, before long work is done for them.

    A folder that is not there yet is made with the first of them: perhaps nothing is proved.
    """
    try:
        there = next(p for p in (folder.absolute(), *folder.absolute().parents) if os.path.lexists(p))
        with TemporaryFile(dir=there):
            pass
    except OSError as error:
        reason = f"Cannot write {whole(folder)}: {error.strerror}"
        raise UsageError(f"{reason}. Choose another --certificates.") from error


def certified(found: Outcome | None) -> str:
    """What to add to the line of a verdict."""
    match found:
        case None:
            return ""
        case Accepted():
            return ", certified"
        case Rejected(obligation):
            return f", CERTIFICATE REJECTED ({obligation})"
        case Undecided(reason):
            return f", not certified: {reason}"


def outcome(found: Outcome | None) -> dict[str, str] | None:
    """The same for machines; None where nothing was to be certified."""
    match found:
        case None:
            return None
        case Accepted(how):
            return {"outcome": "accepted", "how": how}
        case Rejected(obligation, shown):
            return {"outcome": "rejected", "obligation": obligation, "shown": shown}
        case Undecided(reason):
            return {"outcome": "undecided", "reason": reason}


def certificates(found: Sequence[Result]) -> None:
    """How many proofs were certified; each that was rejected, loudly."""
    outcomes = [r.certificate for r in found]
    accepted, undecided = (sum(isinstance(o, kind) for o in outcomes) for kind in (Accepted, Undecided))
    if accepted or undecided:
        left = f", {undecided} not certified" if undecided else ""
        out.print(f"{accepted} proof{'s' * (accepted != 1)} certified{left}.", markup=False)
    for one in found:
        if isinstance(one.certificate, Rejected):
            err.print(_alarm(one, one.certificate), markup=False)


def _alarm(result: Result, rejected: Rejected) -> str:
    return (
        f"Internal error: the proof of {result.property.id} by {result.verdict.engine} is WRONG: its "
        f"certificate does not meet the obligation {rejected.obligation!r} ({rejected.shown}). "
        "Do not rely on this verdict; please report it with the command."
    )
