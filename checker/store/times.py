"""How long searches took the last time, so that it can be said how long they will take.

Nothing rests on it: what is kept is believed as an estimate only.
"""

import json
from collections.abc import Iterable, Mapping
from hashlib import sha256

from rovercheck.checker.cache import entries

NAME = f"{sha256(b'rovercheck search times 1').hexdigest()}-times-json"
_MOST = 5000
"""Searches of which the time is kept, the latest ones."""


def known_times() -> dict[str, float]:
    """Seconds by the title of a search."""
    whole = entries.read(NAME, code=False)
    try:
        found = {} if whole is None else json.loads(whole)
        return {str(title): float(seconds) for title, seconds in found.items()}
    except entries.MEANINGLESS:
        return {}


def keep_times(took: Mapping[str, float]) -> None:
    """Keep how long searches took, beside what is known of others."""
    if took:
        found = {**{t: s for t, s in known_times().items() if t not in took}, **took}
        latest = dict(list(found.items())[-_MOST:])
        entries.write(NAME, json.dumps({t: round(s, 2) for t, s in latest.items()}).encode())


def seconds_left(left: Iterable[str], known: Mapping[str, float], at_a_time: int) -> float | None:
    """How long searches will take that many at a time; None where too few of them are known.

    >>> seconds_left(["a", "b"], {"a": 4.0, "b": 2.0}, 2)
    4.0
    """
    times = [known.get(title) for title in left]
    told = [seconds for seconds in times if seconds is not None]
    if not times:
        return 0.0
    if 2 * len(told) < len(times):
        return None
    mean = sum(told) / len(told)
    every = [mean if seconds is None else seconds for seconds in times]
    return max(max(every), sum(every) / at_a_time)
