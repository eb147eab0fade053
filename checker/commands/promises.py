"""The page on promises: what the document asks from datum to motors, what holds, what breaks it."""

from collections.abc import Collection, Iterator, Mapping, Sequence

from checker.commands.check import Compared
from properties.catalogue import catalogue, expected, promises
from properties.forms import Property
from properties.promises.promise import Promise
from spec_model.repairs import repairs
from spec_model.rover import systems

INTRODUCTION = (
    "What the document promises, each from what is measured to what is commanded. The statements speak of a "
    "whole board, of both boards with the link, or of a chain: properties of which each begins where the one "
    "before ends. Stamps and phases are in milliseconds. Those marked * belong to the full profile "
    "(`make check-full`); their verdict is the one on record."
)

Words = Mapping[str, str]
"""The verdict of each property that was decided, as people read it."""


def page(found: Sequence[Compared]) -> str:
    """The promises, with the verdicts that were found, or else with those on record."""
    words = {c.result.property.id: c.word for c in found}
    pages = {c.result.property.id for c in found if c.verdict.word == "violated"}
    lines = ["# Promises", "", INTRODUCTION, "", "| promise | required | true |", "|---|---|---|"]
    lines += [f"| [{p.title}](#{_anchor(p)}) | {p.bound} | {p.true_bound} |" for p in promises()]
    for promise in promises():
        lines += ["", *_promise(promise, words, pages)]
    return "\n".join(lines) + "\n"


def _anchor(promise: Promise) -> str:
    """As GitHub names the heading."""
    kept = (c for c in promise.title.lower() if c.isalnum() or c in " -")
    return "".join(kept).replace(" ", "-")


def _promise(promise: Promise, words: Words, pages: Collection[str]) -> Iterator[str]:
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
    if promise.chains:
        yield from ("", "Across the link:", "")
        for chain in promise.chains:
            yield "- " + " → ".join(f"{id} ({_word(catalogue()[id], words)})" for id in chain)


def _word(prop: Property, words: Words) -> str:
    if prop.id in words:
        return words[prop.id]
    verdict = expected(prop.id).verdict
    in_part = verdict == "proved" and systems()[prop.on].under
    return f"{verdict} in part*" if in_part else f"{verdict}*"


def _about(prop: Property) -> str:
    return f"[{prop.on}](systems.md#{prop.on.lower()})"


def _repaired_by(id: str) -> str:
    """The repairs that a property holds with, or why there is none."""
    found = [name for name, repair in repairs().items() if id in repair.fixes]
    return ", ".join(f"[{name}](repairs/README.md#{name})" for name in found) or expected(id).no_repair


def _cell(text: str) -> str:
    return text.replace("|", "\\|")
