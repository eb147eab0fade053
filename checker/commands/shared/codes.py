"""The documented exit codes, and the errors that lead to them."""

from enum import IntEnum


class Exit(IntEnum):
    """Exit codes of ``rovercheck``."""

    AS_EXPECTED = 0
    FAILED = 1
    INCONCLUSIVE = 2
    INTERNAL = 3
    USAGE = 4
    NOTHING = 5
    INTERRUPTED = 130


class UsageError(Exception):
    """Something the user wrote has no meaning here: exit code 4."""
