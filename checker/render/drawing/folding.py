"""Long lists of actions in a few lines: a shift register in one, and of what is left the first."""

import re
from collections.abc import Iterator, Sequence

MOST = 10
"""Lines of a list that is shown whole, but for shift registers."""
STAGES = 4
"""Assignments in a row, each of what the next one overwrites, that are taken together."""
COPY = re.compile(r"( *)([\w.]+) := ([\w.]+)$")


def shortened(lines: Sequence[str]) -> tuple[str, ...]:
    """The lines of a list of actions that are shown of it at first; the same if that is all of them."""
    found = list(_shifts(lines))
    found = found if len(found) <= MOST else [*found[: MOST - 1], "…"]
    return tuple(lines) if found == list(lines) else (*found, f"▸ all {len(lines)} lines")


def _shifts(lines: Sequence[str]) -> Iterator[str]:
    """``b := a``, preceded by ``c := b`` and so on, as one line."""
    at = 0
    while at < len(lines):
        copies = [COPY.match(lines[at])]
        while copies[-1] and at + len(copies) < len(lines):
            after = COPY.match(lines[at + len(copies)])
            if after is None or after[1] != copies[-1][1] or after[2] != copies[-1][3]:
                break
            copies.append(after)
        first, last = copies[0], copies[-1]
        if first and last and len(copies) >= STAGES:
            yield f"{first[1]}shift {last[3]} → {last[2]} → … → {first[2]}"
            at += len(copies)
        else:
            yield lines[at]
            at += 1
