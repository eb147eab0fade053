"""All changes of a part that are tried, from near to far; those of limits have the values tried in limits."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cache, partial

from rovercheck.checker.diagnosis.change import NUMBERS_BEGIN, ChangeKind, ChartChange, place_text
from rovercheck.checker.mutate.delays import Delay, delays
from rovercheck.checker.mutate.durings import other_durings
from rovercheck.checker.mutate.functions import function_rewrites
from rovercheck.checker.mutate.memory import shared_memory
from rovercheck.checker.mutate.mutants import Mutant, mutants
from rovercheck.checker.mutate.power_up import other_beginnings
from rovercheck.checker.mutate.regions import BITS, RegionsInOneMemory, regions_in_one_memory
from rovercheck.checker.mutate.rewrites import (
    ASSIGNED,
    COMPARED,
    Rewrite,
    extra_transitions,
    rewrites,
    timer_rewrites,
)
from rovercheck.checker.mutate.rounding import rounded, with_other_age
from rovercheck.checker.mutate.wiring import kept
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.abstraction.board import made_of
from rovercheck.spec_model.abstraction.boards import BOARDS, RECORDED
from rovercheck.spec_model.abstraction.interface import Carriage, beside
from rovercheck.spec_model.abstraction.readings import AGES, StampReading, readings_of
from rovercheck.spec_model.ambiguity import ambiguities, fixed
from rovercheck.spec_model.interpretations import Alternative, alternatives, name_of
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled, parts
from rovercheck.spec_model.lang.domain import Bool, Num
from rovercheck.spec_model.lang.edit import in_system
from rovercheck.spec_model.lang.expr import Const, Expr, Var
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.walk import outermost, structure, variables
from rovercheck.spec_model.repairs import repaired, repairs

OPERATORS: Mapping[str, ChangeKind] = {
    "comparison": "comparison", "and-or": "joined", "dropped": "dropped", "bit": "bit", "member": "member",
    "value": "value", "action-missing": "missing", "condition-negated": "negated", "field": "signal",
    "guard-negated": "negated", "guard-true": "always", "guard-false": "never", "arrow-missing": "never",
    "target": "target", "priority": "order", "order": "order", "initial": "initial", "dead": "dead",
    "enabled": "enabled", "dead-wire": "unread",
}  # fmt: skip
"""What the operators of mutants are called here.  Limits and times are tried with many values instead."""

MOST_CONDITIONS = 60
"""Conditions of the chart that are tried on transitions that are not drawn."""


def mutant_changes(system: System, only: frozenset[str] | None = None) -> Iterator[ChartChange]:
    """The first-order mutants."""
    numbers = {name for name, var in system.written.items() if isinstance(var.sort, Num)}
    for one in mutants(system, only):
        if one.operator in OPERATORS:
            change = _of_mutant(one)
            of_number = change.kind == "initial" and change.at.split("/")[1] in numbers
            yield replace(change, tier=NUMBERS_BEGIN) if of_number else change


def _of_mutant(one: Mutant) -> ChartChange:
    kind, at = OPERATORS[one.operator], one.id.partition("/")[2]
    # comparisons with a number are limits, which are tried with all their values and told as such
    distance = 0.05 if kind == "comparison" else 0.0
    return ChartChange(kind, one.part, at, "as drawn", one.text, one.text, one.make, distance)


def rewrite_changes(system: System, others: Mapping[str, Var], only: frozenset[str]) -> Iterator[ChartChange]:
    """What the mutants leave out.

    What is written several times at one site, as a member in the branches of an action, is one change of each
    of them: ``block``, ``block#2`` and so on.
    """
    for part in parts(system.components):
        met = Counter[tuple[str, ...]]()
        for one, kind in _rewritten(system, part, others) if part.name in only else ():
            key = (kind, one.site, one.old, one.new)
            met[key] += 1
            site = one.site if met[key] == 1 else f"{one.site}#{met[key]}"
            yield _of_rewrite(system, part, replace(one, site=site), kind)


def _rewritten(
    system: System, part: Chart | Block, others: Mapping[str, Var]
) -> Iterator[tuple[Rewrite, ChangeKind]]:
    yield from ((one, REWRITES[one.kind]) for one in rewrites(part, others))
    yield from ((one, "shared") for one in shared_memory(part))
    yield from ((one, "rounded") for one in rounded(part))
    for one in function_rewrites(part, system.step_ms):
        yield one, OPERATORS.get(one.kind, "dropped")


def region_changes(system: System, only: frozenset[str]) -> Iterator[ChartChange]:
    """Two regions in one memory, as where two instances of one structure are one."""
    for one in regions_in_one_memory(system):
        if one.chart.name in only:
            yield _of_regions(system, one)


def _of_regions(system: System, one: RegionsInOneMemory) -> ChartChange:
    first, second = one.first.name, one.second.name
    text = f"the regions {first} and {second} share one memory, active state and times included"
    if one.bits:
        text += f", and times are added up in {BITS} bits"
    return ChartChange(
        "shared", one.chart.name, f"regions/{one.bits}" if one.bits else "regions", second, first, text,
        partial(one.system, system), 0.5,
    )  # fmt: skip


REWRITES: Mapping[str, ChangeKind] = {
    "bit": "bit", "only": "dropped", "also": "joined", "operands": "operands", "member": "member",
    "negated": "negated", "signal": "signal", "exchanged": "exchanged", "members": "exchanged",
    "bits": "exchanged", "target": "target", "order": "order", "timer": "timer", "extra": "extra",
    "shared": "shared", "entry": "entry",
}  # fmt: skip

TOLD = {
    "bit": "`{new}` in place of `{old}`",
    "only": "of `{old}` only `{new}` counts",
    "also": "`{new}` in place of `{old}`",
    "and-or": "`{new}` in place of `{old}`",
    "comparison": "`{new}` in place of `{old}`",
    "dropped": "`{new}` in place of `{old}`",
    "operands": "`{new}` in place of `{old}`",
    "value": "`{new}` in place of `{old}`",
    "member": "{new} in place of {old}",
    "negated": "`{old}` is negated",
    "signal": "{new} is read in place of {old}",
    "exchanged": "{old} and {new} are exchanged",
    "members": "{old} and {new} are exchanged where they are {site}",
    "bits": "{old} and {new} are exchanged",
    "target": "the transition to {old} leads to {new}",
    "order": "{old} is tested {new}",
    "timer": "a time of {new} instead of {old}",
    "shared": "{old} and {new} share one memory",
    "rounded read": "{old} is read in {new}",
    "rounded assigned": "{old} is assigned in {new}",
    "rounded together": "{old} are assigned in {new}",
    "rounded products": "every product is in {new}",
    "extra": "there is an extra transition, {new}",
    "entry": "{new} from {old} is tested in the step in which it is entered, too",
}

OF_THE_WHOLE = ("everywhere", "memory", "buffers", "arrays", COMPARED, ASSIGNED)
"""Sites that are no place in a part."""
TOLD_ALONE = (
    "members", "bits", "only", "and-or", "also", "rounded read", "rounded assigned", "rounded together",
    "rounded products",
)  # fmt: skip
"""Rewrites that are told otherwise than their kind of change."""


def _of_rewrite(system: System, part: Chart | Block, one: Rewrite, kind: ChangeKind) -> ChartChange:
    word: str = "signal" if kind == "exchanged" and one.new not in part.read else kind
    if one.kind in TOLD_ALONE:
        word = one.kind
    text = TOLD[word].format(old=one.old, new=one.new, site=one.site.removeprefix("where "))
    if kind not in ("entry", "rounded") and one.site not in OF_THE_WHOLE:
        text += f", {place_text(one.site)}"
    make = partial(_with_part, system, part, one)
    return ChartChange(kind, part.name, one.site, one.old, one.new, text, make)


def _with_part(system: System, old: Chart | Block, one: Rewrite) -> System:
    new = one.make()
    return kept(system, in_system(system, old.name, lambda _: new))


def signals_of(board: Board) -> dict[str, Var]:
    """The signals of a board that a chart may read by mistake, by the name of the variable."""
    carried = {v.var.name: v.var for v in board.interface.views}
    return {**carried, **board.system.inputs, **{o.var.name: o.var for o in board.outputs}}


def timer_changes(system: System, steps: Sequence[int], only: frozenset[str]) -> Iterator[ChartChange]:
    """Other times; ``steps``: numbers of steps that the recordings suggest."""
    for part in parts(system.components):
        if part.name in only:
            for number, one in enumerate(timer_rewrites(part, system.step_ms, steps)):
                change = _of_rewrite(system, part, one, "timer")
                nearer = 0.0 if one.site == "everywhere" else 0.5
                yield replace(change, distance=nearer + number / 1e6)


def delay_changes(
    system: System, only: frozenset[str], outputs: frozenset[str] = frozenset()
) -> Iterator[ChartChange]:
    """Values late, old, held or never renewed; those of ``outputs`` are nearer than what lies inside."""
    kinds: Mapping[str, ChangeKind] = {
        "late": "late", "stale": "stale", "held": "held", "frozen": "frozen", "unread": "unread"
    }  # fmt: skip
    for one in delays(system):
        if one.part in only:
            far = 0.0 if one.signal in outputs else 0.5 if one.kind in ("late", "held") else 0.25
            yield ChartChange(
                kinds[one.kind], one.part, f"signal/{one.signal}", one.old, one.new, _told(one), one.make,
                far,
            )  # fmt: skip


def _told(one: Delay) -> str:
    match one.kind:
        case "late":
            return f"{one.signal} is given a step later"
        case "stale":
            return f"{one.signal} is read as of the step before"
        case "held":
            return f"{one.signal} is {one.new}"
        case "frozen":
            return f"{one.signal} is read in the first step only"
        case _:
            return f"{one.signal} is not read: {one.new}"


def beginning_changes(system: System, only: frozenset[str]) -> Iterator[ChartChange]:
    """Other initial values, which the default transition sets as well."""
    for part in parts(system.components):
        if isinstance(part, Chart) and part.name in only:
            for one in other_beginnings(system, part):
                old, new = one.var.domain.show(one.var.init), one.var.domain.show(one.value)
                text = f"{one.var.name} begins as {new}, not as {old}, and the default transition keeps it so"
                tier = NUMBERS_BEGIN if isinstance(one.var.sort, Num) else None
                yield ChartChange("initial", part.name, one.site, old, new, text, one.make, 0.5, tier=tier)


def during_changes(system: System, only: frozenset[str]) -> Iterator[ChartChange]:
    """During actions of a superstate that are not executed in each of the states inside it."""
    for part in parts(system.components):
        if isinstance(part, Chart) and part.name in only:
            for one in other_durings(system, part):
                text = f"{one.old} on during of {one.site.split('/')[1]}: executed {one.new}"
                yield ChartChange("missing", part.name, one.site, one.old, one.new, text, one.make, 0.5)


def stamp_changes(board: Board, system: System, only: frozenset[str]) -> Iterator[ChartChange]:
    """Every other way to take a stamp that a part reads, as it is handed to the charts."""
    recorded = [v.signal.name for v in board.interface.by_carriage[Carriage.SLOW]]
    stamps = dict.fromkeys(v.signal.name for v in board.interface.views if v.how is not Carriage.SAMPLE)
    for part in parts(system.components):
        if part.name in only:
            for number, one in enumerate(r for stamp in stamps for r in readings_of(stamp, recorded)):
                inputs = tuple(name for name in made_of(board, one) if name in part.read)
                if inputs:
                    yield ChartChange(
                        "shared" if one.other else "stamp", part.name, f"stamp/{one.stamp}", "as it is given",
                        one.how, one.text, lambda: system, number / 1e3, reading=one, inputs=inputs,
                    )  # fmt: skip


def other_ages(board: Board) -> Iterator[Var]:
    """The variables for ages that are held otherwise."""
    for view in board.interface.by_carriage[Carriage.AGE]:
        yield from (
            beside(view.var, StampReading(view.signal.name, how)) for how in AGES if view.taken is None
        )


def age_changes(board: Board, system: System, only: frozenset[str]) -> Iterator[ChartChange]:
    """An age that a part computes with, held in single precision; or also where it is compared alone."""
    ages = {v.var.name: v for v in board.interface.by_carriage[Carriage.AGE] if v.taken is None}
    for part in parts(system.components):
        for view in (ages[name] for name in part.read if name in ages) if part.name in only else ():
            for number, how in enumerate(AGES):
                reading = StampReading(view.signal.name, how)
                for alone in (False, True):
                    age = view.var.name
                    changed = partial(with_other_age, part, view.var, beside(view.var, reading), alone)
                    site = f"signal/{age}/compared" if alone else f"signal/{age}"
                    rewrite = Rewrite("single-precision", site, age, how, changed)
                    text = reading.text + (", also where it is only compared" if alone else "")
                    make = partial(_with_part, system, part, rewrite)
                    yield ChartChange(
                        "single-precision", part.name, site, age, how, text, make, number + 0.5 * alone,
                        reading=reading,
                    )  # fmt: skip


def extra_changes(system: System, only: frozenset[str]) -> Iterator[ChartChange]:
    """Transitions that are not drawn, under conditions that the chart knows."""
    for part in parts(system.components):
        if isinstance(part, Chart) and part.name in only:
            for one in extra_transitions(part, _conditions(part)):
                yield _of_rewrite(system, part, one, "extra")


def _conditions(chart: Chart) -> list[Expr]:
    """Guards of the chart, their conjuncts, and its boolean inputs."""
    found: dict[object, Expr] = {}
    for guard in chart.guards:
        for one in (guard, *outermost(guard)):
            found.setdefault(structure(one), one)
    for v in variables(*chart.guards).values():
        if isinstance(v.sort, Bool):
            for one in (v, ~v):
                found.setdefault(structure(one), one)
    return [one for one in found.values() if not isinstance(one, Const)][:MOST_CONDITIONS]


# --- what is written down ---------------------------------------------------------------------------------


def written_changes(board: Board, system: System) -> Iterator[ChartChange]:
    """Each alternative of an interpretation that concerns some part of the system; each repair that does."""
    names = frozenset(part.name for part in parts(system.components))
    raw = next((b.system for b in BOARDS if b.name == board.name), None)
    if raw is not None:
        for id, choice in _choices():
            changed = [a for a in alternatives() if (a.interpretation, a.choice) == (id, choice)]
            changed = [a for a in changed if a.among(raw)]
            concerned = [a.part for a in changed if a.part in names] or _reads(raw, names, id)
            if concerned:
                one = ambiguities()[id]
                meaning = changed[0].text.rstrip(".") if changed else one.choices[choice].rstrip(".")
                make = partial(_interpreted, raw, system, tuple(changed), id, choice)
                yield ChartChange(
                    "interpretation", concerned[0], id, one.default, choice, f"{id}={choice}: {meaning}", make
                )
    for repair in repairs().values():
        concerned = [n for n in names if n in repair.charts or n in repair.blocks]
        if concerned and not repair.interpretations:
            make = partial(repaired, system, repair)
            yield ChartChange("repair", concerned[0], repair.name, "as drawn", repair.name,
                f"the repair {repair.name}: {repair.text.rstrip('.')}", make)  # fmt: skip


@cache
def _choices() -> tuple[tuple[str, str], ...]:
    """Every choice that is not the default one, of what the boards can follow."""
    return tuple(
        (id, choice)
        for id, one in ambiguities().items()
        for choice in one.choices
        if choice != one.default and choice not in one.not_modelled and id not in RECORDED
    )


def _reads(raw: System, names: frozenset[str], id: str) -> list[str]:
    """Parts whose formulas depend on an interpretation themselves."""
    return [p.name for p in parts(raw.components) if p.name in names and id in p.read]


def _interpreted(
    raw: System, system: System, changed: tuple[Alternative, ...], id: str, choice: str
) -> System:
    """The parts of a system as the document is read with one other choice.

    A part that depends on the choice itself is taken as it was before interpretations were fixed.
    """
    open_ = {part.name: part for part in parts(raw.components) if id in part.read}

    def one(part: Chart | Block) -> tuple[Component, ...]:
        found: tuple[Component, ...] = (open_.get(part.name, part),)
        for a in changed:
            found = tuple(new for old in found for new in _altered(a, old))
        return found

    def walk(components: Sequence[Component]) -> tuple[Component, ...]:
        made: list[Component] = []
        for c in components:
            if isinstance(c, Enabled):
                made.append(Enabled(c.by, *walk(c.components), name=c.name, place=c.place))
            else:
                made += one(c)
        return tuple(made)

    return fixed({id: choice}).system(replace(system, components=walk(system.components)))


def _altered(one: Alternative, part: Component) -> tuple[Component, ...]:
    if name_of(part) != one.part:
        return (part,)
    made = one.change(part)
    return made if isinstance(made, tuple) else (made,)


__all__ = [
    "age_changes", "beginning_changes", "delay_changes", "during_changes", "extra_changes", "mutant_changes",
    "other_ages", "region_changes", "rewrite_changes", "signals_of", "stamp_changes", "timer_changes",
    "written_changes",
]  # fmt: skip
