"""What ``import`` says, a line at a time."""

from rovercheck.checker.commands.shared.output import out, text_width
from rovercheck.checker.commands.shared.text_wrap import filled


def say(text: str) -> None:
    """Print a line that may be long; what does not fit follows two blanks further in."""
    indent = " " * (len(text) - len(text.lstrip()))
    out.print(filled(" ".join(text.split()), text_width(), indent, f"{indent}  "), markup=False)


__all__ = ["say"]
