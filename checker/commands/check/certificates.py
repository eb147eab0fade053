"""What came of checking proofs again, in words: one for a verdict, a few lines for all of them."""

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryFile
from typing import TYPE_CHECKING

from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.commands.shared.output import err, out
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.commands.shared.told import ToldVerdict

if TYPE_CHECKING:
    from rovercheck.checker.certify.outcome import Outcome


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


def certified(found: Mapping[str, str] | None) -> str:
    """What to add to the line of a verdict."""
    match found:
        case {"outcome": "accepted"}:
            return ", certified"
        case {"outcome": "rejected", "obligation": obligation}:
            return f", CERTIFICATE REJECTED ({obligation})"
        case {"outcome": "undecided", "reason": reason}:
            return f", not certified: {reason}"
    return ""


def outcome(found: "Outcome | None") -> dict[str, str] | None:
    """The same for machines; None where nothing was to be certified."""
    from rovercheck.checker.certify.outcome import Accepted, Rejected, Undecided

    match found:
        case None:
            return None
        case Accepted(how):
            return {"outcome": "accepted", "how": how}
        case Rejected(obligation, shown):
            return {"outcome": "rejected", "obligation": obligation, "shown": shown}
        case Undecided(reason):
            return {"outcome": "undecided", "reason": reason}


def certificates(found: Sequence[ToldVerdict]) -> None:
    """How many proofs were certified; each that was rejected, loudly."""
    outcomes = [one.certificate["outcome"] for one in found if one.certificate is not None]
    accepted, undecided = outcomes.count("accepted"), outcomes.count("undecided")
    if accepted or undecided:
        left = f", {undecided} not certified" if undecided else ""
        out.print(f"{accepted} proof{'s' * (accepted != 1)} certified{left}.", markup=False)
    for one in found:
        if one.certificate is not None and one.certificate["outcome"] == "rejected":
            err.print(_alarm(one, one.certificate), markup=False)


def _alarm(one: ToldVerdict, rejected: Mapping[str, str]) -> str:
    return (
        f"Internal error: the proof of {one.id} by {one.engine} is WRONG: its "
        f"certificate does not meet the obligation {rejected['obligation']!r} ({rejected['shown']}). "
        "Do not rely on this verdict; please report it with the command."
    )
