"""The documented exit codes."""

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
