"""The charts that the command line asks for: the rover's, changed or not, or a model of the user's own."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.commands.shared.output import err
from rovercheck.checker.commands.shared.select import pick
from rovercheck.checker.extras import CERTIFICATES
from rovercheck.checker.model import Model
from rovercheck.checker.model.variant import Variant
from rovercheck.properties.forms import Property
from rovercheck.spec_model.ambiguity import ANY, ambiguities
from rovercheck.spec_model.lang.system import Assumption, System
from rovercheck.spec_model.repairs import proposals
from rovercheck.spec_model.rover import systems

if TYPE_CHECKING:
    from rovercheck.checker.verify.certificates import Certification


def askable(variant: Variant, properties: Sequence[Property]) -> list[Property]:
    """The properties that speak of what the changed systems still have; says which do not."""
    asked, left = variant.askable(properties)
    notes = variant.changes.notes() if variant.changes else ()
    for text in (*notes, *left):
        err.print(text, markup=False)
    return asked


def certifying(variant: Variant, folder: Path | None, again: bool) -> "Certification":
    """What to do with the proofs, with a note of how the charts are changed.

    Raises ``UsageError`` where they are to be checked again and the solver for that is not installed.
    """
    if again and not CERTIFICATES.installed:
        raise UsageError(f"{CERTIFICATES.needed('--certify')}.")
    from rovercheck.checker.verify.certificates import Certification

    repair = variant.repair.name if variant.repair else ""
    changes = variant.changes.rows if variant.changes else ()
    return Certification(
        folder, again, dict(variant.choices), repair, tuple(sorted(variant.without)), changes
    )


def pick_variant(
    chosen: Sequence[str],
    repair: str | None,
    dropped: Sequence[str],
    path: Path | None = None,
    changes: Path | None = None,
) -> Variant:
    """The variant that the command line asks for, of the rover or of the model at a path.

    Raises ``UsageError`` or ``ModelError``.
    """
    variant = _variant(chosen, repair, dropped, path)
    if changes is None:
        return variant
    from rovercheck.checker.commands.shared.changes import read_changes

    return replace(variant, changes=read_changes(changes, variant))


def _variant(chosen: Sequence[str], repair: str | None, dropped: Sequence[str], path: Path | None) -> Variant:
    if path is not None:
        from rovercheck.checker.model.load import load

        return _own(load(path), chosen, repair, dropped)
    choices = _choices(chosen)
    without = _dropped(dropped, systems(choices))
    if repair is None:
        return Variant(choices, None, without)
    found = pick("repair", repair, proposals())
    return Variant({**found.interpretations, **choices}, found, without)


def _own(model: Model, chosen: Sequence[str], repair: str | None, dropped: Sequence[str]) -> Variant:
    for option in ["--interpret"] * bool(chosen) + ["--repair"] * (repair is not None):
        raise UsageError(f"{option} changes the rover's charts, and {model.name} is a model of your own.")
    return Variant({}, None, _dropped(dropped, model.systems), model)


def _dropped(ids: Sequence[str], by_name: Mapping[str, System]) -> frozenset[str]:
    if not ids:
        return frozenset()
    known: dict[str, Assumption] = {a.id: a for s in by_name.values() for a in s.assumptions}
    return frozenset(pick("assumption", id, known).id for id in ids)


def _choices(chosen: Sequence[str]) -> dict[str, str]:
    """Interpretations and their choices from ``ID=CHOICE``."""
    choices: dict[str, str] = {}
    for text in chosen:
        id, equals, choice = text.partition("=")
        one = pick("interpretation", id, ambiguities())
        options = [c for c in one.choices if c not in one.not_modelled]
        if not equals or not choice:
            raise UsageError(f"{text!r} names no choice; write {id}= and one of {', '.join(options)}, {ANY}.")
        if choice != ANY:
            one.value(choice)
        choices[id] = choice
    return choices
