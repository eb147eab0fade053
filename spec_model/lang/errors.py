"""Errors of the chart language: what was written, why it has no meaning, what to write."""

from collections.abc import Iterable, Mapping
from difflib import SequenceMatcher, get_close_matches
from typing import Protocol, TypeVar


class ModelError(Exception):
    """A chart, system or property that has no meaning as written."""


def with_article(noun: object) -> str:
    """``an integer in min``, ``a boolean``, ``a Mode``."""
    return f"{'an' if str(noun)[:1].lower() in 'aeiou' else 'a'} {noun}"


BINDS = " Python reads `a & x > 0` as `(a & x) > 0`, and `~` and `|` alike: write `a & (x > 0)`."
"""What is most often meant where a number is joined to conditions, or a condition compared."""
BINDS_BEFORE = " Python reads `x > 0 & a` as `x > (0 & a)`, and `|` alike: write `(x > 0) & a`."
"""The same where the number comes first."""


T = TypeVar("T")
_LONGEST = 60


def several(owner: str, name: str, given: Iterable[T]) -> tuple[T, ...]:
    """The things of a list.  Raises ``ModelError`` for a text, one thing, nothing, a set or a mapping."""
    if isinstance(given, list | tuple):
        return tuple(given)
    shown = brief(given)
    match given:
        case str():
            why, write = "one text", f"[{shown}]"
        case None:
            why, write = "nothing", "[], or leave it out"
        case set() | frozenset() | Mapping():
            why, write = f"a {type(given).__name__}", f"[{', '.join(map(brief, sorted(given, key=str)))}]"
        case Iterable():
            return tuple(given)
        case _ if shown.endswith("..."):
            raise ModelError(
                f"{owner}: {name} is {with_article(type(given).__name__)}, no list; write {name}=[...]."
            )
        case _:
            why, write = "no list", f"[{shown}]"
    raise ModelError(f"{owner}: {name}={shown} is {why}; write {name}={write}.")


def brief(value: object) -> str:
    """A value as Python shows it, cut where it is long."""
    try:
        text = repr(value)
    except Exception:  # one of a user's own
        return with_article(type(value).__name__)
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}..."


class _Sorted(Protocol):
    @property
    def sort(self) -> object: ...


def apart(one: _Sorted, other: _Sorted) -> str:
    """Two formulas with their sorts, for what they cannot be to each other."""
    return f"`{one}` is {with_article(one.sort)} and `{other}` {with_article(other.sort)}"


def did_you_mean(name: str, options: Iterable[str]) -> str:
    """A sentence offering the nearest names, or listing what exists when none is near."""
    known = sorted(set(options))
    near = get_close_matches(name, known, n=3, cutoff=0.5)
    if near:
        best = [n for n in near if _likeness(name, n) > _likeness(name, near[0]) - 0.15]
        return "Did you mean " + " or ".join(repr(n) for n in best) + "?"
    if not known:
        return "There is none to choose from."
    shown = ", ".join(known[:12])
    return f"Known: {shown}{', ...' if len(known) > 12 else ''}."


def _likeness(one: str, other: str) -> float:
    return SequenceMatcher(None, other, one).ratio()
