"""How much alike two names are: their words, and what firmware engineers abbreviate them to."""

import re
from collections.abc import Iterable, Mapping, Sequence
from difflib import SequenceMatcher
from functools import cache

WORD = re.compile(r"[A-Z][0-9]+|[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")
ROWS = """\
temperature temp tmp degc celsius
battery batt bat pct percent soc
critical crit
degraded degr deg degrade
command cmd
button btn key
yaw heading
status state sts stat health level
supervisor sup
reception rx recv receive received
transmission tx send sends sent
distance dist range
time ms at stamp timestamp tick ticks now read arrival last valid
speed spd velocity vel rpm
reference ref setpoint sp target tgt
error err
enabled enable en
emergency emerg estop
previous prev
current cur curr act actual
counter cnt count alive
left l
right r
front f
authorized authorised auth
decision dec
consistent consistency coherent
imu gyro
joystick ble esp remote
request req requests
data frame msg message
pressure press prs
voltage volt u
position pos
open opened
closed close
board1 b1
board2 b2
heating heater heat
motor mot drive
"""
ALIKE: Mapping[str, str] = {word: row.split()[0] for row in ROWS.splitlines() for word in row.split()}
"""Each word, and the one that stands for all of its row."""
WEAK = frozenset((
    "is", "has", "the", "a", "of", "to", "in", "and", "was", "when", "value", "val", "status", "time",
))  # fmt: skip
"""Words that say little."""
NEAR = 0.84
FEWEST = 3


@cache
def words(name: str) -> tuple[str, ...]:
    """The words of a name, in lower case: ``isMotionConsistent``, ``b2_sup_status``, ``hasNoFeedback_FL``."""
    found: list[str] = []
    for part in re.split(r"[^A-Za-z0-9]+", name):
        if part.isupper() or part.islower() or re.fullmatch(r"[A-Za-z]{1,3}\d+", part):
            found += [part.lower()] if re.fullmatch(r"[A-Za-z]{1,3}\d+|\D*", part) else _split(part)
        else:
            found += _split(part)
    return tuple(found)


def _split(part: str) -> list[str]:
    return [word.lower() for word in WORD.findall(part)]


def plain(name: str) -> str:
    """A name without case and underscores."""
    return re.sub(r"[^a-z0-9]", "", name.lower())


@cache
def likeness(one: str, other: str) -> float:
    """From 0 to 1: the same word, one that stands for it, its beginning, one with a slip of the pen."""
    if one == other:
        return 1.0
    if ALIKE.get(one, one) == ALIKE.get(other, other):
        return 0.9 if ALIKE.get(one, one) not in WEAK else 0.6
    short, long = sorted((one, other), key=len)
    if long.startswith(short) and not long[len(short) :].isdigit():
        return 0.8 if len(short) >= FEWEST else 0.35
    if len(short) > FEWEST and SequenceMatcher(None, one, other).ratio() >= NEAR:
        return 0.8
    return 0.0


def covered(wanted: Sequence[str], given: Sequence[str], weight: Mapping[str, float]) -> float:
    """Which part of the words wanted is among those given, the rare ones weighing more."""
    whole = sum(weight.get(word, 1.0) for word in wanted)
    found = sum(weight.get(w, 1.0) * max((likeness(w, g) for g in given), default=0.0) for w in wanted)
    return found / whole if whole else 0.0


def weights(names: Iterable[Sequence[str]]) -> dict[str, float]:
    """How much a word tells one name from the others."""
    counts: dict[str, int] = {}
    for name in names:
        for word in set(name):
            counts[word] = counts.get(word, 0) + 1
    return {w: (0.35 if w in WEAK or ALIKE.get(w) in WEAK else 1.0) / n**0.5 for w, n in counts.items()}
