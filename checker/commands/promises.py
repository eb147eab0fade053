"""The page on promises: what the document asks from datum to motors, what holds, what breaks it."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from checker.commands.chains import check
from checker.commands.check import Compared
from properties.catalogue import catalogue, expected, promises
from properties.forms import Property
from properties.promises.promise import Chain, Promise
from spec_model.composition.fine_systems import CONTRACTS, NO_LOSS, WIRES
from spec_model.lang.expr import TRUE
from spec_model.lang.label import text
from spec_model.repairs import repairs
from spec_model.rover import systems

if TYPE_CHECKING:
    from checker.commands.repairing import Proof

INTRODUCTION = (
    "What the document promises, each from what is measured to what is commanded. The statements speak of a "
    "whole board, of both boards with the link, or of a chain: properties of which each begins where the one "
    "before ends. Stamps and phases are in milliseconds. Those marked * belong to the full profile "
    "(`make check-full`; with a repair `make check-repairs`); their verdict is the one on record."
)

ACROSS = (
    "Across the link, in milliseconds, at all phases. Below each statement stands what it rests on; that "
    "these say what it takes for granted, and that the frame carries it, is checked formula by formula."
)

Words = Mapping[str, str]
"""The verdict of each property that was decided, as people read it."""


Repaired = Mapping[tuple[str, str], str]
"""The same of each repair and property that was decided with it."""


def page(found: Sequence[Compared], proved: Sequence["Proof"] = ()) -> str:
    """The promises, with the verdicts that were found, or else with those on record; ``proved``: repairs."""
    words = {c.result.property.id: c.word for c in found}
    repaired = {
        (proof.repair.name, r.property.id): Compared(r, proof.variant.expected(r.property.id)).word
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
    yield from (f"## {promise.title}", "", f"> {promise.sentence} [{promise.source}]", "")
    yield from ("Required, as the document has it:", "")
    yield from (
        "| property | verdict | what it says | what breaks it | what repairs it |",
        "|---|---|---|---|---|",
    )
    for id in promise.required:
        prop = catalogue()[id]
        name = f"[{id}](findings/{id}.md)" if id in pages else id
        why = expected(id).because if expected(id).verdict != "proved" else ""
        cells = (name, _word(prop, words), prop.text, why, _repaired_by(id))
        yield f"| {' | '.join(map(_cell, cells))} |"
    yield from ("", "What holds:", "", "| property | verdict | about | what it says |", "|---|---|---|---|")
    for prop in promise.holds:
        yield f"| {' | '.join(map(_cell, (prop.id, _word(prop, words), _about(prop), prop.text)))} |"
    yield from _with_repairs(promise, repaired)
    if promise.chains:
        check(promise)
        yield from ("", ACROSS, "")
        for chain in promise.chains:
            yield from _chain(chain, words)


def _chain(chain: Chain, words: Words) -> Iterator[str]:
    """What is proved of the tasks between the boards, and below it what proves its contracts."""
    across = catalogue()[chain.across]
    system = systems()[across.on]

    def said(id: str) -> str:
        prop = catalogue()[id]
        repair = repairs().get(chain.under)
        with_it = repair is not None and id in repair.fixes
        word = f"proved with {_repair(chain.under)}" if with_it else _word(prop, words)
        return f"{id} ({word}, {_about(prop)}): {prop.text}"

    yield f"- {said(across.id)}"
    if chain.first:
        yield f"  - its premise from {said(chain.first)}"
    for contract in CONTRACTS.get(system.name, ()):
        yield f"  - {contract.name} from {said(chain.by[contract.name])}"
    sent, received = (text(chain.stands[wire.name]) for wire in WIRES[system.name])
    yield f"  - the frame carries `{sent}`, which arrives as `{received}`"
    if chain.last:
        yield f"  - its conclusion from {said(chain.last)}"
    granted = [NO_LOSS, *([] if chain.assuming is TRUE else [f"{text(chain.assuming)}."])]
    yield f"  - taken for granted: {' '.join(granted)}"
    lost = [
        f"{_repair(name)} ({', '.join(ids)})"
        for name, repair in repairs().items()
        if (ids := [id for id in chain.properties if id in repair.gives_up])
    ]
    if lost:
        yield f"  - it no longer holds with a repair that gives up a link: {', '.join(lost)}"


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
        yield from ("", "With a repair:", "")
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
    return f"{verdict} in part*" if in_part else f"{verdict}*"


def _about(prop: Property) -> str:
    return f"[{prop.on}](systems.md#{prop.on.lower()})"


def _repaired_by(id: str) -> str:
    """The repairs that a property holds with, or why there is none."""
    found = [_repair(name) for name, repair in repairs().items() if id in repair.fixes]
    return ", ".join(found) or expected(id).no_repair


def _cell(text: str) -> str:
    return text.replace("|", "\\|")
