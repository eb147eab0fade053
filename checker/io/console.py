"""A console that prints texts as they are: nothing in them is markup, an emoji, or a command."""

from collections.abc import Iterable
from typing import Any

from rich.console import Console, ConsoleOptions, JustifyMethod, OverflowMethod, RenderableType
from rich.segment import Segment
from rich.style import Style
from rich.text import Text

from rovercheck.checker.io.printable import printable


class UnmarkedConsole(Console):
    """Whatever is printed may hold texts from outside: they are escaped, and nothing in them is interpreted.

    Rich reads ``[red]`` in a plain text as markup and ``:1234:`` as an emoji, in cells of tables too.
    Here styles are given as ``style=`` or with a ``Text``.
    """

    def render_str(
        self,
        text: str,
        *,
        style: str | Style = "",
        justify: JustifyMethod | None = None,
        overflow: OverflowMethod | None = None,
        emoji: bool | None = None,
        markup: bool | None = None,
        highlight: bool | None = None,
        highlighter: Any = None,
    ) -> Text:
        """A plain text as what is printed of it; what would interpret it is left out."""
        return Text(printable(text), style=style, justify=justify, overflow=overflow)

    def render(self, renderable: RenderableType, options: ConsoleOptions | None = None) -> Iterable[Segment]:
        """What is printed of anything: what reaches the terminal is escaped, whoever made it."""
        if isinstance(renderable, Text):
            renderable = _printable(renderable)
        for segment in super().render(renderable, options):
            if segment.control or segment.text == (shown := printable(segment.text)):
                yield segment
            else:
                yield Segment(shown, segment.style)


def _printable(text: Text) -> Text:
    """The text with what is not printable escaped, its styles where they were."""
    plain = text.plain
    if printable(plain) == plain:
        return text
    found = text.blank_copy()
    for part in text.divide([i for i in range(1, len(plain)) if _odd(plain[i]) or _odd(plain[i - 1])]):
        found.append_text(_replaced(part))
    return found


def _odd(char: str) -> bool:
    return printable(char) != char


def _replaced(part: Text) -> Text:
    if printable(part.plain) == part.plain:
        return part
    made = part.blank_copy(printable(part.plain))
    for span in part.spans:
        made.stylize(span.style, 0, len(made.plain))
    return made
