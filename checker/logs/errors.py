"""What is wrong with a log or a map, in one message that names the place."""


class LogError(Exception):
    """A log, a map or a cell that has no meaning here; the message says where, why, and what to write."""


def at(line: int, message: str) -> LogError:
    """The error with the line of the file, counted from 1."""
    return LogError(f"line {line}: {message}")


SHORT = 64
"""Characters of a text from a log that are shown."""


def shortened(text: str) -> str:
    """The text, or its beginning with an ellipsis."""
    return text if len(text) <= SHORT else f"{text[: SHORT - 1]}…"
