"""What only the rover has on its review page: interpretations, repairs, tests that are kept."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict
from functools import partial
from typing import Any

from rovercheck.checker.cache.entries import MEANINGLESS
from rovercheck.checker.commands.report.data import Extras
from rovercheck.checker.commands.report.graphs import LEFT_OUT
from rovercheck.checker.commands.reports.repairs import LIMITS, Proof
from rovercheck.checker.commands.shared.dependencies import of_verdict
from rovercheck.checker.commands.shared.output import err
from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.engines import AUTO
from rovercheck.checker.model.kept_invariants import invariants_of_rover
from rovercheck.checker.model.variant import Variant
from rovercheck.checker.render.drawing.changes import changes
from rovercheck.checker.render.review.model import Covered, Edit, InterpretationRow, Remedy
from rovercheck.checker.render.verdict_text import evidence
from rovercheck.checker.store.parts import PartStore
from rovercheck.checker.store.verdicts import store
from rovercheck.checker.system.instrument.goals import KEPT
from rovercheck.checker.system.instrument.watch import watched
from rovercheck.checker.testgen import kept_text
from rovercheck.checker.testgen.keep import kept_of
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.searches import SearchSettings
from rovercheck.spec_model.abstraction import boards
from rovercheck.spec_model.ambiguity import Ambiguity, ambiguities
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.repairs import Repair, repairs


def extras(
    variant: Variant,
    found: Sequence[CheckedProperty],
    with_repairs: bool,
    kept: PartStore,
    kept_only: bool = False,
) -> Extras:
    """All of it; repairs only if wanted and for the charts as specified, and with ``kept_only`` those that
    are kept."""
    mended = kept_remedies(found, kept, kept_only) if with_repairs and not variant.name else ()
    taken = tuple(
        interpretation(one, variant.choices.get(one.id, one.default)) for one in ambiguities().values()
    )
    return Extras(taken, partial(of_verdict, variant=variant, kept=kept), mended, tuple(coverage()))


def interpretation(one: Ambiguity, taken: str) -> InterpretationRow:
    """An interpretation as the page shows it."""
    choices = tuple((name, _meaning(one, name)) for name in one.choices)
    return InterpretationRow(one.id, one.about, one.says, taken, choices, one.scenario, one.because)


def _meaning(one: Ambiguity, choice: str) -> str:
    why = one.not_modelled.get(choice)
    return f"{one.choices[choice]} (not modelled: {why})".strip() if why else one.choices[choice]


def kept_remedies(
    found: Sequence[CheckedProperty], kept: PartStore, kept_only: bool = False
) -> tuple[Remedy, ...]:
    """The repairs of what was found violated: as they are kept while no file has changed, or decided.

    With ``kept_only`` those that are not kept are shown undecided.
    """
    violated = sorted(c.result.property.id for c in found if c.verdict.word == "violated")
    name = kept.name_now("remedies", violated)
    with suppress(*MEANINGLESS):
        return tuple(_remedy_of(row) for row in kept.read(name))
    if kept_only:
        fixing = (one for one in repairs().values() if not {*one.fixes}.isdisjoint(violated))
        return tuple(_undecided(one, {*violated}, LEFT_OUT) for one in fixing)
    made = tuple(remedies(found))
    if all(word != "unknown" for one in made for _, word, _ in one.proofs):
        kept.write(name, [asdict(one) for one in made])
    return made


def _remedy_of(row: Mapping[str, Any]) -> Remedy:
    """A repair from its fields as JSON."""
    edits = tuple(Edit(e["part"], e["place"], tuple(e["before"]), tuple(e["after"])) for e in row["edits"])
    pairs = {n: tuple(tuple(one) for one in row[n]) for n in ("proofs", "gives_up")}
    return Remedy(**{**row, **pairs, "edits": edits})


def remedies(found: Sequence[CheckedProperty]) -> Iterator[Remedy]:
    """The repairs of what was found violated, the properties that they repair decided."""
    violated = {c.result.property.id for c in found if c.verdict.word == "violated"}
    for repair in repairs().values():
        if not violated.isdisjoint(repair.fixes):
            try:
                yield remedy(Proof(repair, tuple(_decided(repair, violated))))
            except ModelError as error:  # a chart was edited where the repair changes it
                yield _unfit(repair, violated, str(error))


def _unfit(repair: Repair, violated: set[str], why: str) -> Remedy:
    """A repair that the charts as they are now have no place for; the message says which."""
    err.print(f"The repair {repair.name} does not fit the charts, and is not decided. {why}")
    return _undecided(repair, violated, f"the repair does not fit the charts as they are. {why}")


def _undecided(repair: Repair, violated: set[str], why: str) -> Remedy:
    rows = tuple((id, "not decided", why) for id in repair.fixes if id in violated)
    return Remedy(repair.name, repair.text, (), rows, tuple(repair.gives_up.items()), _again(repair))


def _decided(repair: Repair, violated: set[str]) -> Iterator[Result]:
    variant = Variant(repair.interpretations, repair)
    wanted = [variant.properties()[id] for id in repair.fixes if id in violated]
    search = SearchSettings(
        limits=LIMITS, invariants=invariants_of_rover(), store=store(AUTO, LIMITS), traces=False
    )
    by_id = {r.property.id: r for r in results(wanted, variant.systems(), search)}
    yield from (by_id[prop.id] for prop in wanted)


def remedy(proof: Proof) -> Remedy:
    """A repair as the page shows it."""
    one = proof.repair
    return Remedy(
        one.name,
        one.text,
        tuple(_edits(proof)),
        tuple((r.property.id, _word(r), evidence(r)) for r in proof.results),
        tuple(one.gives_up.items()),
        _again(one),
    )


def _again(repair: Repair) -> str:
    return f"rovercheck check --timers free --repair {repair.name}"


def _word(result: Result) -> str:
    return f"{result.verdict.word} for a restricted model" if result.in_part else result.verdict.word


def _edits(proof: Proof) -> Iterator[Edit]:
    for before, after in proof.changed:
        kind = "" if isinstance(after, Chart) else "block "
        for change in changes(before, after):
            yield Edit(f"{kind}{after.name}", change.place, change.before, change.after)


def coverage() -> Iterator[Covered]:
    """What the tests reach that are kept with the project."""
    for board in boards().values():
        kept = kept_of(board, kept_text(board.name))
        reached = {goal for _, goals, _ in kept.tests for goal in goals}
        for kind in KEPT:
            ids = {goal.id for goal in watched(board.system, {kind}).goals}
            proved, left = ids & kept.uncoverable.keys(), ids & kept.unknown.keys()
            yield Covered(board.name, kind.word, len(ids), len(ids & reached), len(proved), len(left))
