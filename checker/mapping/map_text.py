"""Writes a proposed mapping file: what is sure with its reason, what is guessed or missing with a mark."""

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.mapping.declarations import CDeclarations
from rovercheck.checker.mapping.entry_points import EntryPoints
from rovercheck.checker.mapping.match import ELEMENT, SignalMatch, is_counter, unit_of
from rovercheck.checker.mapping.places import CLeaf
from rovercheck.checker.mapping.words import likeness, words
from rovercheck.spec_model.abstraction import BoardSignal
from rovercheck.spec_model.lang.domain import Enum

UNITS: Mapping[str, Mapping[str, float]] = {
    "ms": {"us": 0.001, "s": 1000.0, "sec": 1000.0},
    "cm": {"mm": 0.1, "m": 100.0},
    "%": {"permille": 0.1, "promille": 0.1},
}
"""By the unit of a signal: what a word of a place makes of its scale."""
PARTS = {"deci": 0.1, "centi": 0.01, "milli": 0.001, "x10": 0.1, "x100": 0.01, "x1000": 0.001}
LSB = re.compile(
    r"(?:lsb|bit)\s*[=:]?\s*(\d*\.\d+)|(\d*\.\d+)\s*\S*\s*(?:/|per)\s*(?:lsb|bit)|^in\s+(\d*\.\d+)", re.I
)
OF_Q = re.compile(r"\bq\d*\.?(\d+)\b", re.I)


@dataclass(frozen=True)
class MapProposal:
    """A proposed mapping file, with what it says about itself."""

    board: str
    found: CDeclarations
    entry: EntryPoints
    inputs: Sequence[SignalMatch]
    outputs: Sequence[SignalMatch]

    @property
    def signals(self) -> tuple[SignalMatch, ...]:
        return (*self.inputs, *self.outputs)

    def remarks(self) -> Iterator[str]:
        """What is guessed, ambiguous or missing, a line each."""
        for key, remark in self.entry.remarks.items():
            if remark.startswith(("?", "check")):
                yield f"{key}: {remark.lstrip('? ')}"
        for one in self.signals:
            if one.leaf is None:
                alike = f"; perhaps {', '.join(one.rivals)}" if one.rivals else ""
                yield f"{one.signal.name}: nothing looks like it{alike}"
            elif (doubts := all_doubts(one)) and (one.leaf.index == 0 or not doubts[0].startswith(ELEMENT)):
                whole = one.leaf.at if not one.leaf.size else f"{one.leaf.at} and those after it"
                yield f"{one.signal.name}: check {whole}: {'; '.join(doubts)}"
        for place in self.found.unread:
            yield f"{place} could not be read as C without its preprocessor; what it declares may be missing"

    def text(self, command: str) -> str:
        """The file; ``command`` is what wrote it."""
        return "\n".join(_lines(self, command)) + "\n"


def all_doubts(one: SignalMatch) -> list[str]:
    """What is to be looked at, also of the values of an enumeration and of a scale."""
    if one.leaf is None:
        return []
    scaled = (
        [f"scale {_scale(one.signal, one.leaf):g} by its words"] if _scale(one.signal, one.leaf) != 1 else []
    )
    return [*one.doubts, *scaled, *_values(one.signal, one.leaf)[1]]


def _lines(of: MapProposal, command: str) -> Iterator[str]:
    entry = of.entry
    yield f"# Proposed by `{command}` from the names and types of the sources."
    yield '# "check" marks what is guessed, "?" what is missing; all else has the reason beside it.'
    yield ""
    headers = _headers(of)
    yield from _entry("header", headers, "") if headers else ()
    for key in ("initialize", "step", "terminate"):
        calls = getattr(entry, key)
        if calls:
            yield from _entry(key, calls, entry.remarks.get(key, ""))
        elif key in entry.remarks:
            yield f'# {entry.remarks[key]}\n# {key} = ""'
    include = _include(of, headers)
    if include:
        yield from _entry("include", include, "where headers were found")
    if entry.mains:
        rest = [file.name for file in of.found.sources if file.name not in entry.mains]
        yield from _entry("sources", rest, f"without {', '.join(entry.mains)}, which has the main program")
    declared = [*_externs(of), *entry.declarations]
    if declared:
        yield 'declarations = """'
        yield from declared
        yield '"""'
    for name, matches in (("inputs", of.inputs), ("outputs", of.outputs)):
        yield f"\n[{name}]"
        yield from (line for one in matches for line in _signal(one, takes=name == "inputs"))


def _entry(key: str, texts: Sequence[str], remark: str) -> Iterator[str]:
    value = json.dumps(texts[0] if len(texts) == 1 else list(texts), ensure_ascii=False)
    yield f"{key} = {value}{f'  # {remark}' if remark else ''}"


def _signal(one: SignalMatch, *, takes: bool) -> Iterator[str]:
    signal, leaf = one.signal, one.leaf
    if leaf is None:
        said = f" ({signal.doc})" if signal.doc else ""
        alike = f"; perhaps {', '.join(one.rivals)}" if one.rivals else ""
        yield f"# ? {signal.name}{said}: nothing looks like it{alike}"
        yield f'# {signal.name} = ""'
        return
    parts = {"counter" if is_counter(signal, leaf) else "at": json.dumps(leaf.at)}
    if one.counter:
        parts["counter"] = json.dumps(one.counter)
    if (scale := _scale(signal, leaf)) != 1:
        parts["scale"] = f"{scale:g}"
    if takes and any("integer holds a number" in doubt for doubt in one.doubts):
        parts["rounding"] = '"nearest"'
    if values := _values(signal, leaf)[0]:
        parts = {
            "at": parts["at"],
            "values": "{ " + ", ".join(f'{k} = "{v}"' for k, v in values.items()) + " }",
        }
    text = (
        parts["at"]
        if parts.keys() == {"at"}
        else "{ " + ", ".join(f"{k} = {v}" for k, v in parts.items()) + " }"
    )
    doubts = all_doubts(one)
    remark = f"check: {'; '.join(doubts)}; {one.because}" if doubts else one.because
    yield f"{signal.name} = {text}  # {remark}"


def _scale(signal: BoardSignal, leaf: CLeaf) -> float:
    """What one of the place is in units of the signal, as far as words say it."""
    known = UNITS.get(unit_of(signal), {})
    own = (*leaf.words[-2:],)
    scale = next((known[word] for word in own if word in known and word not in words(signal.name)), 1.0)
    if leaf.kind == "integer" and not signal.whole:
        scale *= next((part for text, part in PARTS.items() if any(text in word for word in own)), 1.0)
        if scale == 1 and (found := LSB.search(leaf.comment)):
            scale = float(next(group for group in found.groups() if group))
        elif scale == 1 and (found := OF_Q.search(f"{leaf.comment} {leaf.type}")):
            scale = 2.0 ** -int(found[1])
    return scale


def _values(signal: BoardSignal, leaf: CLeaf) -> tuple[dict[str, str], list[str]]:
    """The members of an enumeration with the constants of the code, and what is doubtful about them."""
    sort = signal.domain.sort
    if not isinstance(sort, Enum) or not leaf.constants:
        return {}, []
    members = [name for name, _ in sort.members]
    mine, theirs = _own_words(members), _own_words(leaf.constants)
    pairs: dict[str, str] = {}
    free = dict(theirs)
    for same in (tuple.__eq__, _alike):  # the words themselves before what is like them
        for member, own in sorted(mine.items(), key=lambda pair: -len(pair[1])):
            fits = [c for c, other in free.items() if member not in pairs and same(own, other)]
            if len(fits) == 1:
                pairs[member] = fits[0]
                del free[fits[0]]
    left = [member for member in members if member not in pairs]
    if len(left) == len(free) == 1:
        pairs[left[0]] = next(iter(free))
        left = []
    if left:
        return {}, [f"values {', '.join(leaf.constants[:8])} are taken by their numbers"]
    return {member: pairs[member] for member in members}, []


def _own_words(names: Sequence[str]) -> dict[str, tuple[str, ...]]:
    """The words of each name that not all of them have."""
    split = {name: words(name) for name in names}
    common = set.intersection(*(set(w) for w in split.values())) if len(split) > 1 else set()
    return {name: tuple(w for w in own if w not in common) for name, own in split.items()}


def _alike(one: tuple[str, ...], other: tuple[str, ...]) -> bool:
    short, long = sorted((one, other), key=len)
    return bool(short) and all(any(likeness(a, b) >= 0.8 for b in long) for a in short)


def _headers(of: MapProposal) -> list[str]:
    """The headers that declare what the map names."""
    roots = {one.leaf.root for one in of.signals if one.leaf is not None}
    found = [*of.entry.headers]
    for one in of.found.variables:
        if one.declared.name in roots and one.in_header:
            found.append(one.file.name)
    if not found:
        found = [file.name for file in of.found.headers]
    elif of.entry.own or _externs(of):
        found += [file.name for file in of.found.headers if _declares(of, file.name)]
    return list(dict.fromkeys(found))


def _declares(of: MapProposal, header: str) -> bool:
    """Whether a header has a type that a declaration of the map needs."""
    types = {own.type for own, _ in of.entry.own} | {v.declared.type for v in of.found.variables}
    file = next(f for f in of.found.headers if f.name == header)
    text = file.read_text(encoding="utf-8", errors="replace")
    return any(re.search(rf"\b{re.escape(t.split()[-1])}\b", text) for t in types)


def _externs(of: MapProposal) -> list[str]:
    """Variables that are in no header."""
    roots = {one.leaf.root for one in of.signals if one.leaf is not None}
    headers = {one.declared.name for one in of.found.variables if one.in_header}
    found: dict[str, str] = {}
    for one in of.found.variables:
        name = one.declared.name
        if name in roots - headers and not one.in_header and not one.static:
            sizes = "".join(f"[{size}]" for size in one.declared.dimensions)
            found[name] = f"extern {one.declared.type} {'*' * one.declared.pointer}{name}{sizes};"
    return list(found.values())


def _include(of: MapProposal, headers: Sequence[str]) -> list[str]:
    """The folders of headers that are not that of the map."""
    folder = of.found.folder
    return sorted({
        str(file.parent.relative_to(folder)) for file in of.found.headers if file.parent != folder
    }) if headers else []  # fmt: skip
