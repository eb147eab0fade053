"""Truth tables as Stateflow writes them: cells column by column, the last row naming the actions."""

import re

from rovercheck.checker.drawn.records import DrawnTruthTable
from rovercheck.checker.simulink.xml import XmlElement
from rovercheck.spec_model.lang.errors import ModelError

_SIZE = re.compile(r"\s*(\d{1,6})\s*\*\s*(\d{1,6})\s*")


def truth_table(element: XmlElement, place: str) -> DrawnTruthTable | None:
    """The grid in an element ``truthTable``; None if it has none.  Raises ``ModelError``."""
    predicates, actions = (_columns(element, name, place) for name in ("predicateArray", "actionArray"))
    if len(predicates) < 2:
        return None
    conditions, *decisions = predicates[1:]
    return DrawnTruthTable(
        conditions=tuple(conditions[:-1]),
        decisions=tuple(tuple(one.strip() for one in column[:-1]) for column in decisions),
        chosen=tuple(column[-1].strip() for column in decisions),
        actions=tuple(actions[1]) if len(actions) > 1 else (),
    )


def _columns(element: XmlElement, name: str, place: str) -> list[list[str]]:
    """The columns of an array of cells; none if it is not there or empty."""
    array = next((one for one in element.all("Array") if one.attributes.get("PropName") == name), None)
    if array is None:
        return []
    cells = [one.text for one in array.all("Cell")]
    size = _SIZE.fullmatch(array.attributes.get("Dimension", ""))
    rows, columns = (int(size[1]), int(size[2])) if size else (0, 0)
    if size is None or rows * columns != len(cells):
        raise ModelError(
            f"{place}, line {array.line}: {name} has {len(cells)} cells, and its Dimension is "
            f"{array.attributes.get('Dimension', '')[:40]!r}. Save the model again in Simulink."
        )
    return [cells[rows * column : rows * (column + 1)] for column in range(columns if rows else 0)]


__all__ = ["truth_table"]
