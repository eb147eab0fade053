"""What is wrong with a text of a chart, and where in it."""

import re

__all__ = ["GrammarError", "line_and_column"]

_LINE_END = re.compile(r"\r\n?|\n")


def line_and_column(text: str, at: int) -> tuple[int, int]:
    """The line and the column of an offset into a text, both counted from 1."""
    ends = [end.end() for end in _LINE_END.finditer(text, 0, at)]
    return len(ends) + 1, at - (ends[-1] if ends else 0) + 1


class GrammarError(Exception):
    """A text that cannot be read: what was written, why it has no meaning, and what to write instead.

    ``line`` and ``column`` count from 1; ``at`` is the same place as an offset into ``text``.
    """

    def __init__(self, message: str, text: str, at: int) -> None:
        self.message = message
        self.text = text
        self.at = min(at, len(text))
        self.line, self.column = line_and_column(text, self.at)
        super().__init__(f"line {self.line}, column {self.column}: {message}")

    def __reduce__(self) -> tuple[type["GrammarError"], tuple[str, str, int]]:
        """A copy from another process is made as the error was."""
        return GrammarError, (self.message, self.text, self.at)
