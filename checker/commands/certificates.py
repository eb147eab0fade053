"""What came of checking proofs again, in words: one for a verdict, a few lines for all of them."""

from collections.abc import Sequence

from checker.certify.outcome import Accepted, Outcome, Rejected, Undecided
from checker.commands.output import err, out
from checker.result import Result


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
        f"INTERNAL: the proof of {result.property.id} by {result.verdict.engine} is WRONG: its certificate "
        f"does not meet the obligation {rejected.obligation!r} ({rejected.shown}). Do not rely on this "
        "verdict; please report it with the command."
    )
