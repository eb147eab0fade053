"""What a person is told of an error that is none of their own making."""

from errno import EDQUOT, EFBIG, ENOSPC

from checker.portfolio import Disagreement
from checker.runs.replay import ReplayError
from spec_model.lang.errors import ModelError

ROOM = "Make room for it, or write elsewhere, and run the command again."
MEMORY = "Out of memory. Check fewer properties at once, or one --system."


def told(error: Exception) -> str:
    """One message for any error, as far as what it calls for is known; else it is a fault of ours."""
    match error:
        case ModelError():
            return str(error)
        case ReplayError():
            return f"INTERNAL: {error}"
        case Disagreement():
            return f"INTERNAL: {error} At least one engine is wrong."
        case OSError():
            return f"The operating system refuses: {error}. {ROOM}"
        case MemoryError():
            return MEMORY
    return f"INTERNAL: {type(error).__name__}: {error}. {_where(error)}"


def no_room(error: Exception) -> bool:
    """Whether it stands for a full disk or a used-up quota, which is no mistake on the command line."""
    cause = error.__cause__
    return isinstance(cause, OSError) and cause.errno in (ENOSPC, EDQUOT, EFBIG)


def _where(error: Exception) -> str:
    """Where an error of ours arose, for the report of it."""
    last = error.__traceback__
    while last is not None and last.tb_next is not None:
        last = last.tb_next
    place = "" if last is None else f" ({last.tb_frame.f_globals.get('__name__')}, line {last.tb_lineno})"
    return f"This is a bug of rovercheck{place}; please report it with the command and the model."
