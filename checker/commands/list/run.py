"""``rovercheck list``: what there is."""

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import out
from rovercheck.checker.commands.shared.tables import listed
from rovercheck.checker.commands.shared.text_wrap import filled
from rovercheck.checker.engines import ALL, AUTO, engines
from rovercheck.checker.io.printable import json_text
from rovercheck.checker.results.format import KINDS, Format

if TYPE_CHECKING:  # each list reads only what is in it
    from rovercheck.checker.model import Model
    from rovercheck.properties.forms import Property


def list_properties(chosen: Iterable["Property"], model: "Model") -> None:
    listed(
        ("id", "system", "expected", "requires"),
        [(p.id, p.on, model.expected(p.id).verdict, p.text) for p in chosen],
    )


def list_systems(model: "Model") -> None:
    listed(
        ("name", "charts", "what it is"),
        [
            (s.name, ", ".join(c.name for c in s.charts), " ".join((s.text, *s.notes)))
            for s in model.systems.values()
        ],
    )


def list_charts(model: "Model") -> None:
    listed(
        ("name", "states", "transitions", "what it is"),
        [(c.name, str(len(c.states) - 1), str(len(c.transitions)), c.text) for c in model.charts.values()],
    )


def list_requirements(model: "Model") -> None:
    covered: dict[str, list[str]] = {}
    for prop in model.properties.values():
        for id in prop.covers:
            covered.setdefault(id, []).append(prop.id)
    listed(
        ("id", "source", "requirement", "properties"),
        [(r.id, r.source, r.text, ", ".join(covered.get(r.id, ["-"]))) for r in model.requirements.values()],
    )


def list_interpretations() -> None:
    """Every interpretation: the sentence, the choices (the default marked), what tells them apart."""
    from rovercheck.spec_model.ambiguity import ambiguities

    about = ""
    for one in ambiguities().values():
        if one.about != about:
            about = one.about
            out.print(f"\n{about}", style="bold", markup=False)
        out.print()
        _hanging(f"{one.id}  {one.says}")
        for choice, meaning in one.choices.items():
            mark = "*" if choice == one.default else "-"
            why = one.not_modelled.get(choice)
            text = f"{choice}{f': {meaning}' if meaning else ''}{f' (not modelled: {why})' if why else ''}"
            _hanging(f"     {mark} {text}", 7)
        _hanging(f"     Scenario: {one.scenario}")
        _hanging(f"     Default:  {one.because}")


def _hanging(text: str, indent: int = 5) -> None:
    out.print(filled(text, out.width, then=" " * indent), markup=False)


def list_repairs() -> None:
    from rovercheck.spec_model.repairs import proposals

    listed(
        ("name", "repairs", "what changes"),
        [(r.name, ", ".join(r.fixes), r.text) for r in proposals().values()],
    )


def list_assumptions(model: "Model") -> None:
    holders: dict[tuple[str, str], list[str]] = {}
    for system in model.systems.values():
        for one in system.assumptions:
            holders.setdefault((one.id, one.text), []).append(system.name)
    listed(
        ("id", "what is assumed", "of"),
        [(id, text, ", ".join(names)) for (id, text), names in holders.items()],
    )


def list_engines() -> None:
    rows = [(e.NAME, e.SUMMARY) for e in engines().values()]
    rows.append((AUTO, "engines in turn, each with more to spend; the first conclusive answer counts"))
    rows.append((ALL, "every engine; answers that cannot both be true are an error (exit code 3)"))
    listed(("name", "what it does"), rows)


def formats() -> list[Format]:
    """Every format in which something is written, by what it shows."""
    from rovercheck.checker.export import exporters
    from rovercheck.checker.render import RENDERED, renderers

    shown = (one.FORMAT for kind in RENDERED for one in renderers(kind).values())
    return [*shown, *(one.FORMAT for one in exporters().values())]


def list_formats() -> None:
    listed(
        ("name", "written by", "file", "what it is"),
        [(f.name, KINDS[f.kind], f.suffix, f.summary) for f in formats()],
    )


LISTS: dict[str, Callable[["Model"], None]] = {
    "systems": list_systems,
    "charts": list_charts,
    "requirements": list_requirements,
    "assumptions": list_assumptions,
}
OTHERS: dict[str, Callable[[], None]] = {
    "interpretations": list_interpretations,
    "repairs": list_repairs,
    "engines": list_engines,
    "formats": list_formats,
}


def listing(
    what: str,
    ids: Sequence[str] = (),
    english: bool = False,
    path: Path | None = None,
    as_json: bool = False,
) -> Exit:
    """Print one of the lists, of the rover or the model at a path; of the properties those of ``ids``.

    With ``english`` these are written in words, which JSON has in any case.  Raises ``UsageError`` if ``ids``
    or ``english`` is given for anything but properties, or if the list exists only for the rover.
    """
    if what != "properties" and (ids or english):
        raise UsageError(
            f"Ids and --english choose among properties; write `rovercheck list {what}` without them, "
            "or `rovercheck list properties [ID]... --english`."
        )
    if path is not None and what in OTHERS and what not in ("engines", "formats"):
        raise UsageError(f"No model of your own has {what}; write `rovercheck list {what}` without --model.")
    model = None if what in OTHERS else _model(path)
    chosen = _chosen(ids, model) if model and what == "properties" else []
    if as_json:
        from rovercheck.checker.commands.list.document import document

        print(json_text(document(what, chosen, model), indent=1))
    elif model is None:
        OTHERS[what]()
    elif what in LISTS:
        LISTS[what](model)
    elif english:
        from rovercheck.checker.commands.shared.property_text import in_english

        in_english(chosen, model)
    else:
        list_properties(chosen, model)
    return Exit.AS_EXPECTED


def _model(path: Path | None) -> "Model":
    if path is None:
        from rovercheck.checker.model.rover import rover

        return rover()
    from rovercheck.checker.model.load import load

    return load(path)


def _chosen(ids: Sequence[str], model: "Model") -> Sequence["Property"]:
    from rovercheck.checker.commands.shared.select import pick_properties

    return pick_properties(ids, (), model.stated(), full=True)
