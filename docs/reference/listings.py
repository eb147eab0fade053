"""The listings of a page: fenced and indented blocks, with their language, title and place."""

import re
from dataclasses import dataclass
from pathlib import Path

FENCE = re.compile(r"^(?P<fence>```+|~~~+)\s*(?P<language>[\w+-]*)\s*(?P<options>.*)$")
TITLE = re.compile(r'title="([^"]+?)( \(added\))?"')
ITEM = re.compile(r"\s*(?:[-*+]|\d+\.)\s")


@dataclass(frozen=True)
class Listing:
    """A block of a page: ``language`` is empty for an indented one, ``title`` the file that a reader writes.

    ``added``, so written behind the title: the reader adds it at the end of that file.
    """

    page: str
    line: int
    language: str
    title: str
    text: str
    added: bool = False

    @property
    def first(self) -> str:
        """Its first line, by which tables know it."""
        return self.text.split("\n", 1)[0].strip()

    def __str__(self) -> str:
        return f"{self.page}:{self.line}"


def listings(page: Path, name: str = "") -> list[Listing]:
    """The blocks of a Markdown file, in order.  ``name`` is what the page is called in messages."""
    lines = page.read_text(encoding="utf-8").splitlines()
    found, at = [], 0
    while at < len(lines):
        if fence := FENCE.match(lines[at]):
            end = next(i for i in range(at + 1, len(lines)) if lines[i].startswith(fence["fence"]))
            title, body = TITLE.search(fence["options"]), "\n".join(lines[at + 1 : end])
            file, added = (title[1], bool(title[2])) if title else ("", False)
            found.append(Listing(name, at + 1, fence["language"], file, body, added))
            at = end + 1
        elif _indented(lines, at):
            end = _end(lines, at)
            body = "\n".join(line[4:] for line in lines[at:end])
            found.append(Listing(name, at + 1, "", "", body))
            at = end
        else:
            at += 1
    return found


def _indented(lines: list[str], at: int) -> bool:
    """Whether a block begins here: four blanks after an empty line, and not the text of a list's item."""
    if not lines[at].startswith("    ") or not lines[at].strip() or (at and lines[at - 1].strip()):
        return False
    before = next((line for line in reversed(lines[:at]) if line.strip() and not line.startswith("    ")), "")
    return not ITEM.match(before)


def _end(lines: list[str], at: int) -> int:
    """The first line after an indented block, without the empty lines at its end."""
    end = at
    while end < len(lines) and (lines[end].startswith("    ") or not lines[end].strip()):
        end += 1
    while not lines[end - 1].strip():
        end -= 1
    return end


def applied(text: str, change: str) -> str:
    """A file after a change as a listing shows it: lines with ``-`` go, lines with ``+`` come.

    Raises ``ValueError`` unless the lines that it begins from are in the file exactly once.
    """
    lines = change.splitlines()
    before = "\n".join(line[1:] for line in lines if not line.startswith("+"))
    after = "\n".join(line[1:] for line in lines if not line.startswith("-"))
    if text.count(before) != 1:
        raise ValueError(f"the change does not fit the file, which has {text.count(before)} times:\n{before}")
    return text.replace(before, after)
