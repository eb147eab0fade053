"""As much of XML Schema as the schema of JUnit reports needs: elements, attributes, what is within what."""

import re
from collections.abc import Iterator
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

XS = "{http://www.w3.org/2001/XMLSchema}"


class Schema:
    """The global elements and types of a schema, by name."""

    def __init__(self, text: str) -> None:
        self._root = ElementTree.fromstring(text)
        self._elements = {e.get("name"): e for e in self._root.findall(f"{XS}element")}
        self._types = {
            t.get("name"): t for t in self._root if t.tag in (f"{XS}complexType", f"{XS}simpleType")
        }

    def errors(self, element: Element) -> Iterator[str]:
        """What is wrong with an element and those within it."""
        kind = self._type(element.tag)
        if element.tag not in self._elements:
            yield f"{element.tag} is no element"
        if kind is None:
            yield from (f"{element.tag} holds {child.tag}" for child in element)
            return
        yield from self._attributes(element, kind)
        within = {e.get("ref") or e.get("name") for e in kind.iter(f"{XS}element")}
        yield from (f"{element.tag} holds {child.tag}" for child in element if child.tag not in within)
        for child in element:
            yield from self.errors(child)

    def _type(self, name: str) -> Element | None:
        """The complex type of an element; None where it holds text alone."""
        declared = self._elements.get(name)
        if declared is None:
            return None
        inside = declared.find(f"{XS}complexType")
        return inside if inside is not None else self._types.get(declared.get("type"))

    def _attributes(self, element: Element, kind: Element) -> Iterator[str]:
        declared = {a.get("name"): a for a in kind.findall(f"{XS}attribute")}
        yield from (f"{element.tag} has {name}" for name in element.attrib if name not in declared)
        for name, attribute in declared.items():
            value = element.get(str(name))
            if value is None:
                if attribute.get("use") == "required":
                    yield f"{element.tag} lacks {name}"
            elif (simple := self._types.get(attribute.get("type"))) is not None:
                [pattern] = [p.get("value", "") for p in simple.iter(f"{XS}pattern")]
                if not re.fullmatch(pattern, value):
                    yield f"{element.tag} has {name}={value}"
