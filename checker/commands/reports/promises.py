"""The page on promises: what the document asks from datum to motors, what holds, what breaks it."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from rovercheck.checker.commands.check.chains import check
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.properties.catalogue import catalogue, expected, promises
from rovercheck.properties.forms import Property
from rovercheck.properties.promises.promise import Chain, Promise
from rovercheck.spec_model.composition.fine_systems import CONTRACTS, NO_LOSS, WIRES
from rovercheck.spec_model.lang.expr import TRUE
from rovercheck.spec_model.lang.label import text
from rovercheck.spec_model.repairs import repairs
from rovercheck.spec_model.rover import systems

if TYPE_CHECKING:
    from rovercheck.checker.commands.reports.repairs import Proof

INTRODUCTION = (
    "What the document promises, each from what is measured to what is commanded. The statements speak of a "
    "whole board, of both boards with the link, or of a chain: properties of which each begins where the one "
    "before ends. Stamps and phases are in milliseconds. Those marked * belong to the full profile "
    "(`make check-full`; with a repair `make check-repairs`); their verdict is the expected one."
)

ACROSS = (
    "In milliseconds, at all phases. Below each statement stands what it rests on; that "
    "these say what it takes for granted, and that the frame carries it, is checked formula by formula."
)

Words = Mapping[str, str]
"""The verdict of each property that was decided, as people read it."""


Repaired = Mapping[tuple[str, str], str]
"""The same of each repair and property that was decided with it."""


def page(found: Sequence[CheckedProperty], proved: Sequence["Proof"] = ()) -> str:
    """The promises, with the verdicts that were found, else with the expected ones; ``proved``: repairs."""
    words = {c.result.property.id: c.word for c in found}
    repaired = {
        (proof.repair.name, r.property.id): CheckedProperty(r, proof.variant.expected(r.property.id)).word
        for proof in proved
        for r in proof.results
    }
    pages = {c.result.property.id for c in found if c.verdict.word == "violated"}
    lines = ["# Promises", "", INTRODUCTION, "", "| promise | required | true |", "|---|---|---|"]
    lines += [f"| [{p.title}](#{_anchor(p)}) | {p.bound} | {p.true_bound} |" for p in promises()]
    for promise in promises():
        lines += ["", *_promise(promise, words, repaired, pages)]
    return "\n".join(lines) + "\n"


def _anchor(promise: Promise) -> str:
    """As GitHub names the heading."""
    kept = (c for c in promise.title.lower() if c.isalnum() or c in " -")
    return "".join(kept).replace(" ", "-")


def _promise(promise: Promise, words: Words, repaired: Repaired, pages: Collection[str]) -> Iterator[str]:
    """The promise on one screen; the tables below it open with a click."""
    check(promise)
    yield from (
        f"## {promise.title}",
        "",
        f"> {promise.sentence} [{promise.source}]",
        "",
        "| | |",
        "|---|---|",
    )
    for name, cell in _summary(promise, words, pages):
        yield f"| {name} | {cell} |"
    yield from _folded("Required, as the document has it", _required(promise, words, pages))
    yield from _folded("What holds", _holds(promise, words))
    yield from _folded("With a repair", _with_repairs(promise, repaired))
    yield from _folded("Across the link", _across(promise, words))


def _folded(title: str, lines: Iterator[str]) -> Iterator[str]:
    if inside := list(lines):
        yield from ("", f"<details><summary>{title}</summary>", "", *inside, "", "</details>")


def _summary(promise: Promise, words: Words, pages: Collection[str]) -> Iterator[tuple[str, str]]:
    """Bounds, what is proved and how, what breaks it, what repairs that."""
    broken = [id for id in promise.required if expected(id).verdict == "violated"]
    kept = [id for id in promise.required if id not in broken]
    mended = {name: [id for id in broken if id in repair.fixes] for name, repair in repairs().items()}
    left = [id for id in broken if not any(id in ids for ids in mended.values())]
    direct = (f"{p.id} on {_about(p)}{'' if p.id in words else ' *'}" for p in promise.holds)
    chains = (
        f"{c.across} ← {', '.join(id for id in c.properties if id != c.across)}" for c in promise.chains
    )
    yield "required", promise.bound
    yield "true", promise.true_bound
    yield "kept as required", ", ".join(kept)
    yield "what breaks it", ", ".join(_link(id, pages) for id in broken)
    yield "what repairs it", "; ".join(f"{_repair(n)}: {', '.join(ids)}" for n, ids in mended.items() if ids)
    yield "no repair", ", ".join(_link(id, pages) for id in left)
    yield "proved directly", ", ".join(direct)
    yield "proved by a chain", "; ".join(dict.fromkeys(chains))


def _link(id: str, pages: Collection[str]) -> str:
    return f"[{id}](findings/{id}.md)" if id in pages else id


def _required(promise: Promise, words: Words, pages: Collection[str]) -> Iterator[str]:
    yield from (
        "| property | verdict | what it says | what breaks it | what repairs it |",
        "|---|---|---|---|---|",
    )
    for id in promise.required:
        prop = catalogue()[id]
        why = expected(id).because if expected(id).verdict != "proved" else ""
        cells = (_link(id, pages), _word(prop, words), prop.text, why, _repaired_by(id))
        yield f"| {' | '.join(map(_cell, cells))} |"


def _holds(promise: Promise, words: Words) -> Iterator[str]:
    yield from ("| property | verdict | about | what it says |", "|---|---|---|---|")
    for prop in promise.holds:
        yield f"| {' | '.join(map(_cell, (prop.id, _word(prop, words), _about(prop), prop.text)))} |"


def _across(promise: Promise, words: Words) -> Iterator[str]:
    """The chains; those that prove one statement of several causes are shown once."""
    if promise.chains:
        yield from (ACROSS, "")
    for across in dict.fromkeys(chain.across for chain in promise.chains):
        yield from _chain([chain for chain in promise.chains if chain.across == across], words)


def _chain(chains: Sequence[Chain], words: Words) -> Iterator[str]:
    """What is proved of the tasks between the boards, and below it what proves its contracts."""
    across = catalogue()[chains[0].across]
    system = systems()[across.on]

    def said(id: str, under: str) -> str:
        prop = catalogue()[id]
        repair = repairs().get(under)
        with_it = repair is not None and id in repair.fixes
        word = f"proved with {_repair(under)}" if with_it else _word(prop, words)
        return f"{id} ({word}, {_about(prop)}): {prop.text}"

    def below(chain: Chain) -> Iterator[tuple[int, str]]:
        """The lines of one chain, each with its place."""
        if chain.first:
            yield 0, f"its premise from {said(chain.first, chain.under)}"
        for contract in CONTRACTS.get(system.name, ()):
            yield 1, f"{contract.name} from {said(chain.by[contract.name], chain.under)}"
        sent, received = (text(chain.stands[wire.name]) for wire in WIRES[system.name])
        yield 2, f"the frame carries `{sent}`, which arrives as `{received}`"
        if chain.last:
            yield 3, f"its conclusion from {said(chain.last, chain.under)}"
        granted = [NO_LOSS, *([] if chain.assuming is TRUE else [f"{text(chain.assuming)}."])]
        yield 4, f"taken for granted: {' '.join(granted)}"
        lost = [
            f"{_repair(name)} ({', '.join(ids)})"
            for name, repair in repairs().items()
            if (ids := [id for id in chain.properties if id in repair.gives_up])
        ]
        if lost:
            yield 5, f"it no longer holds with a repair that gives up a link: {', '.join(lost)}"

    yield f"- {said(across.id, chains[0].under)}"
    lines = dict.fromkeys(line for chain in chains for line in below(chain))
    yield from (f"  - {line}" for _, line in sorted(lines, key=lambda pair: pair[0]))


def _with_repairs(promise: Promise, repaired: Repaired) -> Iterator[str]:
    """What is required and violated, and holds with a repair: the verdict under it."""
    rows = [
        (_repair(name), id, repaired.get((name, id)) or _recorded(prop), _about(prop), prop.text)
        for id in promise.required
        for prop in [catalogue()[id]]
        for name, repair in repairs().items()
        if id in repair.fixes
    ]
    if rows:
        yield from ("| repair | property | verdict | about | what then holds |", "|---|---|---|---|---|")
        yield from (f"| {' | '.join(map(_cell, row))} |" for row in rows)


def _repair(name: str) -> str:
    return f"[{name}](repairs/README.md#{name})"


def _word(prop: Property, words: Words) -> str:
    if prop.id in words:
        return words[prop.id]
    return _recorded(prop, expected(prop.id).verdict)


def _recorded(prop: Property, verdict: str = "proved") -> str:
    """A verdict that was not found now."""
    in_part = verdict == "proved" and systems()[prop.on].under
    return f"{verdict} for a restricted model*" if in_part else f"{verdict}*"


def _about(prop: Property) -> str:
    return f"[{prop.on}](systems.md#{prop.on.lower()})"


def _repaired_by(id: str) -> str:
    """The repairs that a property holds with, or why there is none."""
    found = [_repair(name) for name, repair in repairs().items() if id in repair.fixes]
    return ", ".join(found) or expected(id).no_repair


def _cell(text: str) -> str:
    return text.replace("|", "\\|")
