"""XML of a stranger as plain elements with their lines: no entities, no doctype, nothing that is fetched."""

import codecs
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from xml.parsers.expat import ExpatError, ParserCreate, errors

from rovercheck.spec_model.lang.errors import ModelError

MOST_DEPTH = 200
"""Elements in each other; states nest to a tenth of it in the deepest charts known."""
MOST_ELEMENTS = 1_000_000
"""Elements of all parts of a package that are read."""

SIMULINK = "Save the model again in Simulink."
MULTIBYTE = frozenset({
    "shift_jis", "cp932", "euc_jp", "gb2312", "gbk", "gb18030", "big5", "big5hkscs", "euc_kr", "cp949",
    "johab",
})  # fmt: skip
"""Encodings of several bytes for a letter, which the parser of XML does not know."""
FARTHEST = 1e9
"""From a point of a drawing to its origin; what is farther is no point."""
_NUMBER = re.compile(r"-?\d{1,300}(?:\.\d{1,300})?(?:[eE][-+]?\d{1,3})?")
_DECLARED = re.compile(rb"""<\?xml[^>]{0,200}?\bencoding\s*=\s*["']([A-Za-z][\w.-]{0,40})["']""")


@dataclass(slots=True)
class XmlElement:
    """An element with the line of its part that it begins in; ``text`` is what stands in it directly."""

    tag: str
    attributes: dict[str, str]
    line: int
    children: list["XmlElement"] = field(default_factory=list)
    text: str = ""

    def child(self, *tags: str) -> "XmlElement | None":
        """The first child with one of some tags."""
        return next((one for one in self.children if one.tag in tags), None)

    def all(self, *tags: str) -> Iterator["XmlElement"]:
        """The children with one of some tags, in their order."""
        return (one for one in self.children if one.tag in tags)

    def property_of(self, name: str, default: str = "") -> str:
        """The value of ``<P Name="name">``; an absent one is as its default."""
        found = self.property_element(name)
        return default if found is None else found.text

    def property_element(self, *names: str) -> "XmlElement | None":
        """The element ``<P Name="name">`` of the first of some names that is there."""
        for name in names:
            for one in self.children:
                if one.tag == "P" and one.attributes.get("Name") == name:
                    return one
        return None

    def properties(self) -> dict[str, str]:
        """The values of all its ``<P>``, by name."""
        return {one.attributes.get("Name", ""): one.text for one in self.all("P")}

    def below(self, *path: str) -> "XmlElement | None":
        """The element that a path of tags leads to."""
        found: XmlElement | None = self
        for tag in path:
            found = None if found is None else found.child(tag)
        return found

    def every(self) -> Iterator["XmlElement"]:
        """This element and all in it, in the order of the text."""
        waiting = [self]
        while waiting:
            one = waiting.pop()
            yield one
            waiting += reversed(one.children)


class _Builder:
    def __init__(self, place: str, most: int, encoding: str | None, again: str) -> None:
        self.place, self.most, self.number, self.again = place, most, 0, again
        self.top = XmlElement("", {}, 0)
        self.open = [self.top]
        self.texts: list[list[str]] = [[]]
        self.parser = ParserCreate(encoding)
        self.parser.buffer_text = True
        self.parser.StartElementHandler = self.start
        self.parser.EndElementHandler = self.end
        self.parser.CharacterDataHandler = self.characters
        self.parser.StartDoctypeDeclHandler = self.doctype

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        self.number += 1
        if len(self.open) > MOST_DEPTH or self.number > self.most:
            raise ModelError(
                f"{self.place}, line {self.parser.CurrentLineNumber}: no more than {MOST_DEPTH} elements in "
                f"each other are read, and {MOST_ELEMENTS:,} in one package. No model that is drawn has so "
                "many."
            )
        made = XmlElement(tag, attributes, self.parser.CurrentLineNumber)
        self.open[-1].children.append(made)
        self.open.append(made)
        self.texts.append([])

    def characters(self, text: str) -> None:
        self.texts[-1].append(text)

    def end(self, _: str) -> None:
        self.open.pop().text = "".join(self.texts.pop())

    def doctype(self, *_: object) -> None:
        again = "Simulink writes none: save the model again." if self.again == SIMULINK else self.again
        raise ModelError(
            f"{self.place}, line {self.parser.CurrentLineNumber}: a <!DOCTYPE> may define entities, and is "
            f"not read. {again}"
        )


def parsed(
    data: bytes, place: str, most: int = MOST_ELEMENTS, again: str = SIMULINK
) -> tuple[XmlElement, int]:
    """The root element of a text, which stands at ``place``, and how many elements there are.

    Raises ``ModelError``, also for more elements than ``most``; ``again`` says how to write the file anew.
    """
    data, encoding = _in_utf_8(data, place, again)
    builder = _Builder(place, most, encoding, again)
    try:
        builder.parser.Parse(data, True)
    except ExpatError as error:
        raise ModelError(
            f"{place}, line {error.lineno}: it is no XML: {errors.messages.get(error.code, error)}. {again}"
        ) from error
    except (LookupError, ValueError) as error:  # an encoding that does not exist, or is none of text
        raise ModelError(f"{place}: it is no XML: {error}. {again}") from error
    return builder.top.children[0], builder.number


def _in_utf_8(data: bytes, place: str, again: str) -> tuple[bytes, str | None]:
    """The text in an encoding that the parser knows, and which that is if the text says another one.

    Simulink of East Asian systems once declared encodings of several bytes for a letter.
    """
    found = _DECLARED.match(data)
    if found is None:
        return data, None
    name = found[1].decode("ascii")
    try:
        codec = codecs.lookup(name)
        if codec.name not in MULTIBYTE:
            return data, None
        return codec.decode(data)[0].encode("utf-8"), "utf-8"
    except (LookupError, ValueError) as error:
        raise ModelError(f"{place}: it is no XML: {error}. {again}") from error


def numbers(text: str, many: int) -> tuple[float, ...]:
    """The first numbers of a drawing, exactly so many; 0 where they are missing, or are none."""
    found = [float(one[0]) for one, _ in zip(_NUMBER.finditer(text), range(many), strict=False)]
    return tuple(n if abs(n) < FARTHEST else 0.0 for n in (*found, *[0.0] * (many - len(found))))


__all__ = ["XmlElement", "numbers", "parsed"]
