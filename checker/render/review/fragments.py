"""Fragments of a page that are unpacked when a reader opens them: compressed, they take little room."""

import json
import zlib
from base64 import b64encode
from collections.abc import Iterable, Iterator, Sequence
from itertools import zip_longest

from markupsafe import Markup

from rovercheck.checker.render.page import Part, data

KIND = "packed"
"""The class of the block that holds them; ``review.js`` unpacks what it names."""
TOGETHER = 48
"""Entries in one parcel: similar fragments side by side compress four times better than alone."""


class PackedFragments:
    """Fragments by name, and the styles and scripts they need."""

    def __init__(self) -> None:
        self._entries: list[tuple[str, tuple[str, ...]]] = []
        self._styles: dict[str, None] = {}
        self._scripts: dict[str, None] = {}

    def add(self, name: str, parts: Iterable[Part]) -> None:
        """Keep parts under a name."""
        shown = list(parts)
        self._entries.append((name, tuple(str(part.body) for part in shown)))
        for part in shown:
            self._styles |= dict.fromkeys(part.styles)
            self._scripts |= dict.fromkeys(part.scripts)

    def parts(self) -> list[Part]:
        """The fragments as one part; none if there are no fragments."""
        if not self._entries:
            return []
        body = data(list(self._parcels()), KIND)
        return [Part(Markup(body), tuple(self._styles), tuple(self._scripts))]

    def _parcels(self) -> Iterator[dict[str, object]]:
        for start in range(0, len(self._entries), TOGETHER):
            entries = self._entries[start : start + TOGETHER]
            yield {"names": [name for name, _ in entries], "parts": deflated(json.dumps(columns(entries)))}


def columns(entries: Sequence[tuple[str, tuple[str, ...]]]) -> list[list[str]]:
    """All first fragments, all second ones and so on; an entry that has none has an empty text."""
    return [list(column) for column in zip_longest(*(bodies for _, bodies in entries), fillvalue="")]


def deflated(text: str) -> str:
    """A text as raw DEFLATE (RFC 1951) in base64, which browsers unpack by themselves."""
    packer = zlib.compressobj(9, wbits=-zlib.MAX_WBITS)
    return b64encode(packer.compress(text.encode()) + packer.flush()).decode()
