"""What a verdict depends on: interpretations of the document and assumptions about the environment."""

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import asdict, fields

from rovercheck.checker.cache.entries import MEANINGLESS
from rovercheck.checker.model.variant import Variant
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Violated
from rovercheck.checker.store.parts import UNKEPT, PartStore
from rovercheck.checker.system.cone import Dependencies, dependencies
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.checker.verify.runs.choices import needed
from rovercheck.checker.verify.runs.known_runs import run_of
from rovercheck.properties.catalogue import as_written, read_by
from rovercheck.spec_model.ambiguity import ANY, ambiguities
from rovercheck.spec_model.rover import AS_READ, interpretations_of, left_to_read


def of_verdict(compared: CheckedProperty, variant: Variant, kept: PartStore = UNKEPT) -> Dependencies:
    """What the verdict can depend on, of the system that it is about: what lies in the property's own cone.

    A run that is shown is a run without any assumption too, so that its verdict depends on none.  Of the
    interpretations it depends on those of which another choice lets its inputs break nothing, as far as that
    can be tried: not of runs that go on for ever.  Interpretations that say what the property means come
    first.  What a repair changes in the charts is not looked at; a model of a user has no interpretations.
    """
    prop, name = compared.result.property, compared.result.system
    on = name if name in variant.model.systems else prop.on
    if variant.own is not None:
        system = variant.own.systems[on].without(variant.without)
        found = dependencies(system, lowered(system), prop)
    else:
        found = of_rover(compared, on, {} if variant.repair else variant.choices, kept)
    by_run = isinstance(compared.verdict, Violated) and isinstance(compared.verdict.because, Trace)
    left = () if by_run else tuple(id for id in found.assumptions if id not in variant.without)
    return Dependencies(found.interpretations, left, found.besides)


def of_rover(
    compared: CheckedProperty, on: str, choices: Mapping[str, str] = AS_READ, kept: PartStore = UNKEPT
) -> Dependencies:
    """The same on one of the rover's systems, what it assumes included; not asked again where it is kept."""
    prop = compared.result.property
    about = prop, as_written()[prop.id], prop.interpretations, sorted(read_by(prop)), left_to_read(on)
    run = run_of(compared.verdict) if isinstance(compared.verdict, Violated) else None
    name = kept.name("depends", *about, run, sorted(interpretations_of(on)), dict(choices), _meanings())
    with suppress(*MEANINGLESS):
        row = kept.read(name)
        return Dependencies(*(tuple(map(str, row[kind.name])) for kind in fields(Dependencies)))
    found = _of_rover(compared, on, choices)
    kept.write(name, asdict(found))
    return found


def _meanings() -> dict[str, list[object]]:
    """What of the interpretations a verdict can depend on."""
    return {id: [one.default, [*one.choices], sorted(one.not_modelled)] for id, one in ambiguities().items()}


def _of_rover(compared: CheckedProperty, on: str, choices: Mapping[str, str]) -> Dependencies:
    prop = compared.result.property
    by_run = _tried(compared, on, choices)
    if by_run is not None:
        return by_run
    system = left_to_read(on)
    found = dependencies(system, lowered(system), as_written()[prop.id], ambiguities())
    read = tuple(dict.fromkeys((*prop.interpretations, *found.interpretations)))
    return Dependencies(read, found.assumptions)


def _tried(compared: CheckedProperty, on: str, choices: Mapping[str, str]) -> Dependencies | None:
    """What a counterexample depends on, by trying its inputs under every other choice; None if that fails."""
    run = run_of(compared.verdict) if isinstance(compared.verdict, Violated) else None
    if run is None or ANY in choices.values():
        return None
    prop = compared.result.property
    read = tuple(dict.fromkeys((*prop.interpretations, *sorted(read_by(prop) | interpretations_of(on)))))
    taken, others = {}, {}
    for id, one in ambiguities().items():
        choice = choices.get(id, one.default)
        taken[id] = one.var.domain.raw(choice)
        if id in read:
            rest = (c for c in one.choices if c != choice and c not in one.not_modelled)
            others[id] = [one.var.domain.raw(c) for c in rest]
    mattering = needed(lowered(left_to_read(on)), as_written()[prop.id], run, taken, others)
    if mattering is None:
        return None
    return Dependencies(
        tuple(id for id in read if id in mattering), (), tuple(id for id in read if id not in mattering)
    )
