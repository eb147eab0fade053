"""The pages on proposed repairs: what each changes in the charts, and the proof that it repairs."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from html import escape

from rovercheck.checker.commands.reports.record import VerdictRecord
from rovercheck.checker.engines import Limits, Timers
from rovercheck.checker.model.variant import Variant
from rovercheck.checker.render import renderers
from rovercheck.checker.render.drawing.changes import changes
from rovercheck.checker.render.verdict_text import evidence
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.checker.verify.result import Result
from rovercheck.properties.catalogue import catalogue
from rovercheck.properties.expected import Expected
from rovercheck.spec_model.lang.chart import Block, Chart, parts
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.repairs import Repair, repairs
from rovercheck.spec_model.rover import systems

LIMITS = Limits(timers=Timers.FREE)
"""Timers that may expire at any time prove most repairs with far fewer states."""


@dataclass(frozen=True)
class Proof:
    """A repair with the verdicts, under it, on the properties that it repairs."""

    repair: Repair
    results: tuple[Result, ...]

    @cached_property
    def variant(self) -> Variant:
        return Variant(self.repair.interpretations, self.repair)

    @cached_property
    def changed(self) -> Sequence[tuple[Chart | Block, Chart | Block]]:
        """The charts and blocks that differ from those specified, with their repaired form.

        Of parts with one name in several systems, the first that differs.
        """
        found: dict[str, tuple[Chart | Block, Chart | Block]] = {}
        repaired = _repaired(self.repair.name)
        for name, system in _specified().items():
            after = {part.name: part for part in parts(repaired[name].components)}
            for part in parts(system.components):
                other = after.get(part.name, part)
                if other is not part and part.name not in found and changes(part, other):
                    found[part.name] = (part, other)
        return list(found.values())

    @cached_property
    def others(self) -> int:
        """How many other properties are about a system that the repair changes."""
        return sum(map(self.variant.concerns(), self.variant.properties().values())) - len(self.results)


def proofs(record: VerdictRecord) -> tuple[Proof, ...]:
    """Every repair, its properties decided as far as the record does not know the verdicts."""
    return tuple(Proof(repair, tuple(_decided(repair, record))) for repair in repairs().values())


@cache
def _repaired(name: str) -> Mapping[str, System]:
    repair = repairs()[name]
    return Variant(repair.interpretations, repair).systems()


@cache
def _specified() -> Mapping[str, System]:
    return systems()


def _decided(repair: Repair, record: VerdictRecord) -> Iterator[Result]:
    variant = Variant(repair.interpretations, repair)
    wanted = [prop for id in repair.fixes if not (prop := variant.properties()[id]).costly]
    decided = record.decided(wanted, _repaired(repair.name), LIMITS, f"{repair.name}: ")
    found = {r.property.id: r for r in decided}
    yield from (found[prop.id] for prop in wanted)


def sections(id: str, expected: Expected, proved: Sequence[Proof]) -> list[str]:
    """What a finding page says of its repair: the change and the proof, or why there is none."""
    mine = [proof for proof in proved if id in proof.repair.fixes]
    lines = ["## Proposed repair", ""]
    if not mine:
        return [*lines, f"None. {expected.no_repair}".rstrip(), ""]
    for proof in mine:
        lines += [f"**{proof.repair.name}**: {proof.repair.text}", "", *_change(proof, "../repairs/")]
    lines += ["## Proof of the repair", ""]
    for proof in mine:
        lines += [*_verdicts(proof), ""]
    return lines


def _change(proof: Proof, folder: str) -> list[str]:
    """The changed places side by side, and a picture of each repaired chart."""
    lines: list[str] = []
    for before, after in proof.changed:
        lines += [_title(proof, after, folder), "", "| where | as specified | repaired |", "|---|---|---|"]
        for change in changes(before, after):
            lines.append(f"| {_cell(change.place)} | {_code(change.before)} | {_code(change.after)} |")
        lines.append("")
    if proof.repair.gives_up:
        lines += ["It gives up:", "", *(f"- {id}: {why}" for id, why in proof.repair.gives_up.items()), ""]
    return lines


def _title(proof: Proof, part: Chart | Block, folder: str) -> str:
    picture = f"{folder}{proof.repair.name}/{part.name}.svg"
    return f"[{part.name}, repaired]({picture})" if isinstance(part, Chart) else part.name


def _code(lines: Sequence[str]) -> str:
    return "<br>".join(f"<code>{_cell(line)}</code>" for line in lines) or "—"


def _cell(text: str) -> str:
    return escape(text, quote=False).replace("|", "\\|")


def _verdicts(proof: Proof) -> list[str]:
    name, count = proof.repair.name, proof.others
    lines = [f"With {name}:", ""]
    lines += [
        f"- {r.property.id}: {CheckedProperty(r, Expected()).word}, {evidence(r)}" for r in proof.results
    ]
    lines += [
        f"- {id}: only in the full profile; `rovercheck check --repair {name} {id}` decides it"
        for id in _costly(proof.repair)
    ]
    others = f"`{_recheck(name)}` decides these and {count} other properties that it concerns."
    return [*lines, "", others]


def _costly(repair: Repair) -> list[str]:
    """What a repair repairs and only the full profile decides."""
    return [id for id in repair.fixes if catalogue()[id].costly]


def _recheck(name: str) -> str:
    return f"rovercheck check --timers free --repair {name}"


def repair_pages(proved: Sequence[Proof]) -> dict[str, str]:
    """The page that lists the repairs, and a picture of each repaired chart, by relative path."""
    made = {"repairs/README.md": _index(proved)}
    draw = renderers("statechart")["svg"].render
    for proof in proved:
        for _, part in proof.changed:
            if isinstance(part, Chart):
                drawn = draw(part)
                assert isinstance(drawn, str)
                made[f"repairs/{proof.repair.name}/{part.name}.svg"] = drawn
    return made


INTRODUCTION = (
    "Each repair is a variant of the charts kept beside the original, in a file of `spec_model/repairs/`; "
    f"the specified charts stay as they are. `{_recheck('NAME')}` decides every property that it concerns "
    "(timers that may expire at any time only make it faster), `--repair all` does so for all repairs that "
    "edit charts, together."
)


def _index(proved: Sequence[Proof]) -> str:
    lines = ["<!-- generated by `rovercheck reports`; do not edit -->", ""]
    lines += ["# Proposed repairs", "", INTRODUCTION, ""]
    for proof in proved:
        costly = _costly(proof.repair)
        fixed = ", ".join(id if id in costly else f"[{id}](../findings/{id}.md)" for id in proof.repair.fixes)
        lines += [f"## {proof.repair.name}", "", proof.repair.text, "", f"Repairs {fixed}.", ""]
        lines += [*_change(proof, ""), *_verdicts(proof), ""]
    return "\n".join(lines).rstrip() + "\n"


__all__ = ["Proof", "proofs", "repair_pages", "sections"]
