"""XML of packages: elements with properties ``<P Name="...">``, each on a line of its own."""

from collections.abc import Mapping
from xml.etree.ElementTree import Element, SubElement, indent, tostring

Values = Mapping[str, object]
"""Properties by their names; ``None`` is not written."""


def put(holder: Element, values: Values) -> None:
    """Properties of an element."""
    for name, value in values.items():
        if value is not None:
            SubElement(holder, "P", Name=name).text = str(value)


def made(tag: str, attributes: Mapping[str, str] | None = None, values: Values | None = None) -> Element:
    """An element with its properties."""
    element = Element(tag, dict(attributes or {}))
    put(element, values or {})
    return element


def below(holder: Element, tag: str, values: Values | None = None, **attributes: str) -> Element:
    """A further child of an element, with its properties."""
    element = SubElement(holder, tag, attributes)
    put(element, values or {})
    return element


def xml_of(root: Element) -> bytes:
    """A part of a package."""
    indent(root)
    text: bytes = tostring(root, "utf-8", xml_declaration=True)
    return text


__all__ = ["Values", "below", "made", "put", "xml_of"]
