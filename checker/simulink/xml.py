"""XML of a stranger as plain elements with their lines: no entities, no doctype, nothing that is fetched."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from xml.parsers.expat import ExpatError, ParserCreate, errors

from rovercheck.spec_model.lang.errors import ModelError

MOST_DEPTH = 200
"""Elements in each other; states nest to a tenth of it in the deepest charts known."""
MOST_ELEMENTS = 1_000_000


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
    def __init__(self, place: str) -> None:
        self.place, self.number = place, 0
        self.top = XmlElement("", {}, 0)
        self.open = [self.top]
        self.texts: list[list[str]] = [[]]
        self.parser = ParserCreate()
        self.parser.buffer_text = True
        self.parser.StartElementHandler = self.start
        self.parser.EndElementHandler = self.end
        self.parser.CharacterDataHandler = self.characters
        self.parser.StartDoctypeDeclHandler = self.doctype

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        self.number += 1
        if len(self.open) > MOST_DEPTH or self.number > MOST_ELEMENTS:
            raise ModelError(
                f"{self.place}, line {self.parser.CurrentLineNumber}: no more than {MOST_DEPTH} elements in "
                f"each other are read, and {MOST_ELEMENTS:,} in all. No model that is drawn has so many."
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
        raise ModelError(
            f"{self.place}, line {self.parser.CurrentLineNumber}: a <!DOCTYPE> may define entities, and is "
            "not read. Simulink writes none: save the model again."
        )


def parsed(data: bytes, place: str) -> XmlElement:
    """The root element of a text, which stands at ``place``.  Raises ``ModelError``."""
    builder = _Builder(place)
    try:
        builder.parser.Parse(data, True)
    except ExpatError as error:
        raise ModelError(
            f"{place}, line {error.lineno}: it is no XML: {errors.messages.get(error.code, error)}. Save the "
            "model again in Simulink."
        ) from error
    except (LookupError, ValueError) as error:  # an encoding that does not exist, or is none of text
        raise ModelError(f"{place}: it is no XML: {error}. Save the model again in Simulink.") from error
    return builder.top.children[0]


__all__ = ["XmlElement", "parsed"]
