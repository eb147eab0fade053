"""Deviations from the charts in a sentence, whoever met them."""

from collections.abc import Mapping

from rovercheck.checker.conformance.deviations import Deviation, DeviationKind

MISSING = "missing"
KINDS: Mapping[DeviationKind, str] = {
    "value": "",
    "late": ", one step late",
    "frozen": ", they stay while the charts go on",
    "swapped": ", each is what is required of the other",
}


def headline(deviation: Deviation) -> str:
    """What decides the outputs, and what they are instead of what: a sentence without its end."""
    told = []
    for name, expected, actual in deviation.scope.differences:
        if not expected:
            told.append(f"{name} differs" if deviation.scope.kind == "value" else name)
        elif expected.startswith("0x"):
            told.append(f"{name} has {actual} instead of {expected} of these bits")
        elif expected == "a value":
            told.append(f"{name} is {actual}" + ("" if actual == MISSING else ", which is no value"))
        else:
            told.append(f"{name} is {actual} instead of {expected}")
    decided = f"{deviation.first.decided_by}: " if deviation.scope.part else ""
    on_top = ", on top of the other causes" if deviation.scope.on_top else ""
    return f"{decided}{', '.join(told)}{KINDS[deviation.kind]}{on_top}"
