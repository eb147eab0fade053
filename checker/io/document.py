"""What the fields of JSON documents hold; a document is a ``TypedDict`` beside the function that makes it.

mypy compares what is made with the record, and ``python -m docs.reference`` derives the published schema in
``checker/schemas`` from it: descriptions are the docstrings below its fields.
"""

from typing import Annotated

from annotated_types import Ge, MinLen
from typing_extensions import TypedDict

from rovercheck.spec_model.lang.place import Place

Count = Annotated[int, Ge(0)]
Ordinal = Annotated[int, Ge(1)]
"""A tick, a step or a line, counted from 1."""
Text = Annotated[str, MinLen(1)]


class PlaceRow(TypedDict):
    """Where something is written."""

    file: str
    line: Ordinal


def place_row(place: Place | None) -> PlaceRow | None:
    """The place, if it is known."""
    return None if place is None else {"file": place.path, "line": place.line}
