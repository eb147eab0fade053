"""Changes that make something wrong, and on which others are put that make it right again.

Where two causes make the same rows wrong, none of them explains a deviation alone.
"""

from collections.abc import Callable, Sequence

from rovercheck.checker.diagnosis.cover import CoveringChange, Unexplaining

NEAREST = 3
"""Changes that explain the same of which it is tried whether they do so on top of others."""
MOST_PARTLY = 60
"""Changes that make something wrong that are looked at, the nearest of those met."""

Bridge = Callable[[Unexplaining], CoveringChange | None]
"""What a change does, if it makes nothing wrong earlier than before."""


def ahead(
    partly: Sequence[Unexplaining], good: Sequence[CoveringChange], bridge: Bridge
) -> CoveringChange | None:
    """A change that makes something wrong, and explains more than others, and all that one of these does.

    These, which are ``good``, make nothing wrong, but explain a few cases by chance where this one and
    another cause mask each other.
    """
    nearest = sorted(partly, key=lambda one: one.rank)[:NEAREST]
    most = max((len(one.explains) for one in good), default=0)
    found = [
        made
        for made in map(bridge, nearest)
        if made is not None
        and len(made.explains) > most
        and any(one.explains < made.explains for one in good)
    ]
    return max(found, key=lambda made: (len(made.explains), made.cases), default=None)


def bridges(partly: Sequence[Unexplaining], bridge: Bridge, late: Callable[[], bool]) -> list[CoveringChange]:
    """Changes on which others may be put, those first that make most right and little wrong.

    One that makes more wrong counts if it explains some deviation wholly: another one may mask it.
    """
    found: list[CoveringChange] = []
    for one in sorted(partly, key=lambda one: one.rank)[:MOST_PARTLY]:
        if late():
            break
        if (made := bridge(one)) and (made.cases > 0 or made.explains):
            found.append(made)
    return sorted(found, key=lambda one: -one.cases)


__all__ = ["NEAREST", "ahead", "bridges"]
