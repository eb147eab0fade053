"""Which place of a firmware is which signal of a board: by names, types, and who assigns to what."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from string import ascii_letters

from rovercheck.checker.mapping.declarations import CAssignment
from rovercheck.checker.mapping.places import CLeaf, CLeaves
from rovercheck.checker.mapping.words import FEWEST, covered, plain, weights, words
from rovercheck.spec_model.abstraction import Board, BoardSignal
from rovercheck.spec_model.lang.domain import Bool, Enum, Num

SURE, LIKELY = 0.86, 0.45
"""From which likeness on a match is taken without a remark, and from which on it is proposed at all."""
RIVAL = 0.85
"""A place that is so much as alike as the one taken is named, too."""
MOST_RIVALS, MOST_LEFT = 3, 6
FITTING = 0.9
ELEMENT = "element"
"""How a doubt begins about which element of an array is which signal."""
COUNTERS = frozenset({"alive", "counter", "count", "cnt", "seq", "sequence"})


@dataclass(frozen=True)
class SignalMatch:
    """A signal with its place, or without; ``doubts`` say what a person has to look at."""

    signal: BoardSignal
    leaf: CLeaf | None
    because: str
    doubts: tuple[str, ...] = ()
    rivals: tuple[str, ...] = ()
    counter: str = ""
    """A counter beside the place, which goes up with every new stamp."""

    @property
    def sure(self) -> bool:
        return self.leaf is not None and not self.doubts


@dataclass(frozen=True)
class _Candidate:
    score: float
    signal: BoardSignal
    leaf: CLeaf
    because: str
    doubts: tuple[str, ...] = ()


@dataclass
class _Direction:
    """Inputs, or outputs."""

    signals: tuple[BoardSignal, ...]
    leaves: CLeaves
    inputs: bool
    groups: dict[str, tuple[str, int, int]]
    """By signal: the words that its group shares, its place in the group, and how many there are."""
    own: str
    """What the names of a board call it itself, such as b2: it says little there."""


def matched(board: Board, leaves: CLeaves) -> tuple[list[SignalMatch], list[SignalMatch]]:
    """The inputs and the outputs of a board, in its order."""
    inputs = tuple(board.inputs)
    outputs = tuple(o.signal for o in board.outputs)
    number = board.name.lstrip(ascii_letters)
    own = f"{board.name[:1]}{number}" if number else board.name
    return (
        _matched(_Direction(inputs, leaves, True, _groups(inputs), own)),
        _matched(_Direction(outputs, leaves, False, _groups(outputs), own)),
    )


def _groups(signals: Iterable[BoardSignal]) -> dict[str, tuple[str, int, int]]:
    """Signals that differ in their last word or digits: the wheels, the sonars."""
    stems: dict[str, list[BoardSignal]] = {}
    for signal in signals:
        stem = signal.name.rstrip("0123456789")
        if stem == signal.name:
            stem = signal.name.rpartition("_")[0]
        if stem:
            stems.setdefault(stem, []).append(signal)
    found: dict[str, tuple[str, int, int]] = {}
    for stem, members in stems.items():
        alike = {str(m.domain) for m in members}
        if len(members) > 1 and len(alike) == 1:
            found |= {m.name: (stem, n, len(members)) for n, m in enumerate(members)}
    return found


def _matched(of: _Direction) -> list[SignalMatch]:
    candidates = sorted(_candidates(of), key=lambda c: (-c.score, c.leaf.at))
    taken: dict[str, _Candidate] = {}
    used: dict[str, str] = {}
    for one in candidates:
        if one.signal.name not in taken and one.leaf.at not in used and one.score >= LIKELY:
            taken[one.signal.name] = one
            used[one.leaf.at] = one.signal.name
    found = []
    for signal in of.signals:
        mine = [c for c in candidates if c.signal is signal]
        found.append(_told(of, taken.get(signal.name), mine, used, signal))
    return found


def _told(
    of: _Direction,
    chosen: _Candidate | None,
    mine: list[_Candidate],
    used: dict[str, str],
    signal: BoardSignal,
) -> SignalMatch:
    rivals = tuple(
        c.leaf.at
        for c in mine
        if (chosen is None and c.score > LIKELY / 2)
        or (chosen is not None and c.leaf is not chosen.leaf and c.score >= RIVAL * chosen.score)
    )
    if chosen is None:
        alike = [r for r in rivals if r not in used] or _left(of, signal, used)
        return SignalMatch(signal, None, "nothing looks like it", rivals=tuple(alike[:MOST_LEFT]))
    doubts = list(chosen.doubts)
    taken_over = {c.leaf.at for c in mine if of.inputs and _assigned(of, c.leaf)}
    free = [r for r in rivals if r not in used and r not in taken_over]
    elsewhere = [r for r in rivals if r in used and of.groups.get(signal.name) is None]
    if free:
        doubts.append(f"{', '.join(free[:MOST_RIVALS])} looks alike, too")
    elif chosen.score < SURE and elsewhere:
        doubts.append(f"{elsewhere[0]} looks alike, and is {used[elsewhere[0]]}")
    if chosen.score < SURE and not doubts:
        doubts.append("only some words are the same")
    found = SignalMatch(signal, chosen.leaf, chosen.because, tuple(doubts), rivals[:MOST_RIVALS])
    return _followed(of, found, used) if of.inputs else found


def _left(of: _Direction, signal: BoardSignal, used: dict[str, str]) -> list[str]:
    """Places of the direction that are nothing else, and could hold it."""
    role = "input" if of.inputs else "output"
    free = [leaf for leaf in of.leaves.all if leaf.at not in used and not leaf.hidden and leaf.role == role]
    return [leaf.at for leaf in free if _type_fits(signal, leaf) >= FITTING and not leaf.size]


def _followed(of: _Direction, match: SignalMatch, used: dict[str, str]) -> SignalMatch:
    """What the firmware itself assigns is overwritten: its source is the place, where there is one."""
    assert match.leaf is not None
    written = _assigned(of, match.leaf)
    if not written:
        return match
    first = written[0]
    where = f"{first.file.name}, line {first.line}"
    for source, copy in of.leaves.copied_from(match.leaf):
        if source.at in used and used[source.at] != match.signal.name:
            continue
        used[source.at] = match.signal.name
        why = f"{copy.file.name}, line {copy.line}, hands it on to {match.leaf.at}"
        doubts = tuple(doubt for doubt in match.doubts if source.at not in doubt)
        if copy.conditional and match.signal.stamp and (counter := _counter_of(of, source, used)):
            used[counter] = match.signal.name
            doubts += (f"taken over when {counter} is new, which the map counts",)
            return SignalMatch(match.signal, source, why, doubts, match.rivals, counter)
        if copy.conditional:
            doubts += (
                f"{copy.function} takes it over only under a condition, which may have to be given, too",
            )
        return SignalMatch(match.signal, source, why, doubts, match.rivals)
    doubt = f"{where}, assigns it: what is given there is lost"
    return SignalMatch(match.signal, match.leaf, match.because, (*match.doubts, doubt), match.rivals)


def _assigned(of: _Direction, leaf: CLeaf) -> list[CAssignment]:
    """Who assigns a place but in the beginning."""
    return [one for one in of.leaves.assigned(leaf) if "init" not in one.function.lower()]


def _counter_of(of: _Direction, beside: CLeaf, used: dict[str, str]) -> str:
    """A counter in the same variable that shares a word with a place."""
    for leaf in of.leaves.all:
        shares = set(leaf.words) & set(beside.words) and leaf.root == beside.root
        if shares and COUNTERS & set(leaf.words) and leaf.kind == "integer" and leaf.at not in used:
            return leaf.at
    return ""


def _candidates(of: _Direction) -> list[_Candidate]:
    signal_weight = {**weights([words(s.name) for s in of.signals]), of.own: 0.2}
    leaf_weight = weights([leaf.words for leaf in of.leaves.all])
    found: list[_Candidate] = []
    for signal in of.signals:
        for leaf in of.leaves.all:
            if leaf.hidden:
                continue
            one = _candidate(of, signal, leaf, signal_weight, leaf_weight)
            if one is not None:
                found.append(one)
    return found


def _candidate(
    of: _Direction,
    signal: BoardSignal,
    leaf: CLeaf,
    signal_weight: dict[str, float],
    leaf_weight: dict[str, float],
) -> _Candidate | None:
    name, doubts = signal.name, list[str]()
    if leaf.size:
        group = of.groups.get(name)
        if group is None or group[2] != leaf.size or group[1] != leaf.index:
            return None
        name = group[0]
        doubts.append(f"{ELEMENT} {leaf.index}: their order is taken to be that of the signals")
    fits = _type_fits(signal, leaf)
    if not fits:
        return None
    mine = words(name)
    if plain(name) in (plain("".join(leaf.words)), plain(leaf.words[-1] if leaf.words else "")):
        score, why = 1.0, "the same name"
    elif plain("".join(leaf.words)).endswith(plain(name)) and len(plain(name)) > 3:
        score, why = 0.97, "its path ends with the name"
    else:
        score, why = _by_words(signal, mine, leaf, signal_weight, leaf_weight)
    score *= fits * _role(of, leaf)
    if score < LIKELY / 2:
        return None
    score -= 0.001 * len(leaf.words)
    return _Candidate(score, signal, leaf, f"{why}; {leaf.type}", tuple([*doubts, *_doubts(signal, leaf)]))


def _by_words(
    signal: BoardSignal,
    mine: Sequence[str],
    leaf: CLeaf,
    signal_weight: dict[str, float],
    leaf_weight: dict[str, float],
) -> tuple[float, str]:
    """The harmonic mean of what of the one is in the other; comments help a little."""
    told, said = words(signal.doc), words(leaf.comment)
    mine = tuple(_meant(word, told) for word in mine)
    forth = covered(mine, leaf.words, signal_weight)
    back = covered(leaf.words, mine, leaf_weight)
    root = covered(mine, leaf.root_words, signal_weight)
    if told and forth + back < 2:
        back = max(back, 0.75 * covered(leaf.words, (*mine, *told), leaf_weight))
    if said:
        forth = max(forth, 0.75 * covered(mine, (*leaf.words, *said), signal_weight))
    forth = min(1.0, forth + 0.2 * root)
    if not forth or not back:
        return 0.0, ""
    common = [w for w in mine if covered((w,), leaf.words, {}) >= 0.6]
    shared = f"has {', '.join(common)}" if common else "by its comments"
    return 2 * forth * back / (forth + back), shared


def _meant(word: str, told: Sequence[str]) -> str:
    """A letter that stands for a word of the description: d for distance."""
    if len(word) > 1 or word.isdigit():
        return word
    return next((long for long in told if long.startswith(word) and len(long) > FEWEST), word)


def _role(of: _Direction, leaf: CLeaf) -> float:
    """How far a place can be one of this direction: inputs are read by the code, outputs assigned."""
    written = bool(_assigned(of, leaf))
    role = leaf.role
    if of.inputs:
        factor = {"input": 1.0, "output": 0.3, "state": 0.2}.get(role, 0.95)
        return factor * (0.9 if written else 1.0)
    factor = {"output": 1.0, "input": 0.25, "state": 0.55}.get(role, 0.9)
    return factor * (1.0 if written or role == "output" else 0.4)


def unit_of(signal: BoardSignal) -> str:
    """The unit of a number, "" if it has none."""
    sort = signal.domain.sort
    return str(sort.unit) if isinstance(sort, Num) else ""


def _type_fits(signal: BoardSignal, leaf: CLeaf) -> float:
    sort, kind = signal.domain.sort, leaf.kind
    if signal.stamp:
        return 1.0 if kind == "integer" and not leaf.constants else 0.0
    if isinstance(sort, Bool):
        return {"boolean": 1.0, "integer": 0.75, "unknown": 0.7}.get(kind, 0.0) * (
            0.4 if leaf.constants else 1
        )
    if isinstance(sort, Enum):
        return {"integer": 1.0 if leaf.constants else 0.8, "unknown": 0.7}.get(kind, 0.0)
    if signal.whole:
        return {"integer": 1.0, "float": 0.95, "unknown": 0.8}.get(kind, 0.0)
    return {"float": 1.0, "integer": 0.8, "unknown": 0.8}.get(kind, 0.0)


def is_counter(signal: BoardSignal, leaf: CLeaf) -> bool:
    """Whether a place counts what a stamp gives the times of."""
    return signal.stamp and bool(COUNTERS & set(leaf.words))


def _doubts(signal: BoardSignal, leaf: CLeaf) -> list[str]:
    found = []
    if is_counter(signal, leaf):
        found.append("an alive counter, which the map has counted with every new stamp")
    if leaf.kind == "unknown":
        found.append(f"what {leaf.type} is stands in no header here")
    fractional = isinstance(signal.domain.sort, Num) and not signal.whole and not signal.stamp
    if fractional and leaf.kind == "integer":
        unit = unit_of(signal)
        found.append(f"an integer holds a number{f' of {unit}' if unit else ''}: give the scale of the code")
    return found
