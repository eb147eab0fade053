"""What a person is told of an error that is none of their own making."""

from errno import EDQUOT, EFBIG, ENOSPC

from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.process.faults import Fault, place
from rovercheck.spec_model.lang.errors import ModelError

ROOM = "Make room for it, or write elsewhere, and run the command again."
MEMORY = "Out of memory. Check fewer properties at once, or one --system."


def error_message(error: Exception) -> str:
    """One message for any error, as far as what it calls for is known; else it is an internal error."""
    match error:
        case ModelError():
            return str(error)
        case OSError():
            return f"The operating system refuses: {error}. {ROOM}"
        case MemoryError():
            return MEMORY
    from rovercheck.checker.process.cluster import ClusterError
    from rovercheck.checker.verify.portfolio import Disagreement
    from rovercheck.checker.verify.runs.replay import ReplayError
    from rovercheck.checker.verify.stored import StrangeRun

    match error:
        case ClusterError():
            return str(error)
        case ReplayError() | StrangeRun():
            return f"Internal error: {error}"
        case Disagreement():
            return f"Internal error: {error} At least one engine is wrong."
    return f"Internal error: {type(error).__name__}: {error}. {_report(place(error))}"


def alarm(fault: Fault) -> str:
    """What is said of an internal error that the others have worked on without."""
    return f"Internal error: {fault}. The verdicts of others stand. {_report('')}"


def code_of(error: BaseException) -> Exit:
    """The exit code that an error leads to."""
    match error:
        case KeyboardInterrupt() | SystemExit() | BrokenPipeError():
            return Exit.INTERRUPTED
        case ModelError() | UsageError():
            return Exit.INCONCLUSIVE if no_room(error) else Exit.USAGE
        case OSError() | MemoryError():
            return Exit.INCONCLUSIVE
    from rovercheck.checker.certify.file import Unwritable
    from rovercheck.checker.process.cluster import ClusterError

    return Exit.USAGE if isinstance(error, Unwritable | ClusterError) else Exit.INTERNAL


def no_room(error: BaseException) -> bool:
    """Whether it stands for a full disk or a used-up quota, which is no mistake on the command line."""
    cause = error.__cause__
    return isinstance(cause, OSError) and cause.errno in (ENOSPC, EDQUOT, EFBIG)


def _report(place: str) -> str:
    return f"This is a bug of rovercheck{place}; please report it with the command and the model."
