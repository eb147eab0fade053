"""What leads to an exit code: the code itself, and the error of a command line without meaning."""

from rovercheck.checker.results.exit_code import Exit


class UsageError(Exception):
    """Something the user wrote has no meaning here: exit code 4."""


__all__ = ["Exit", "UsageError"]
