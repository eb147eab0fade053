"""What a verdict depends on: interpretations of the document and assumptions about the environment."""

from rovercheck.checker.model.variant import Variant
from rovercheck.checker.system.cone import Dependencies, dependencies
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.properties.catalogue import as_written
from rovercheck.properties.forms import Property
from rovercheck.spec_model.ambiguity import ambiguities
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.rover import left_to_read


def of_verdict(compared: CheckedProperty, variant: Variant) -> Dependencies:
    """What the verdict can depend on, of the system that it is about: what lies in the property's own cone.

    Interpretations that say what the property means come first.  Those of the charts are found in the charts
    as drawn, without a repair; a model of a user has none.
    """
    prop, name = compared.result.property, compared.result.system
    on = name if name in variant.model.systems else prop.on
    if variant.own is not None:
        system = variant.own.systems[on].without(variant.without)
        return dependencies(system, lowered(system), prop)
    found = of_rover(prop, on)
    kept = tuple(id for id in found.assumptions if id not in variant.without)
    return Dependencies(found.interpretations, kept)


def of_rover(prop: Property, on: str) -> Dependencies:
    """The same of a property of the rover, on one of its systems as specified."""
    system: System = left_to_read(on)
    found = dependencies(system, lowered(system), as_written()[prop.id], ambiguities())
    return Dependencies(
        tuple(dict.fromkeys((*prop.interpretations, *found.interpretations))), found.assumptions
    )
