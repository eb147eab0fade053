"""``rovercheck list``: what there is."""

import json
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from textwrap import fill

from rich.table import Table

from checker.commands.codes import Exit, UsageError
from checker.commands.listing_json import document
from checker.commands.output import out
from checker.commands.select import pick_properties
from checker.commands.wording import in_english
from checker.decide import ALL, AUTO
from checker.engine import engines
from checker.model import Model
from checker.model.load import load
from checker.model.rover import rover
from properties.forms import Property
from spec_model.readings import readings
from spec_model.repairs import proposals


def _table(*columns: str) -> Table:
    table = Table(box=None, pad_edge=False, header_style="bold")
    for column in columns:
        table.add_column(column, no_wrap=column == columns[0], overflow="fold")
    return table


def _print(columns: Iterable[str], rows: Iterable[tuple[str, ...]]) -> None:
    from rich.markup import escape

    table = _table(*columns)
    for row in rows:
        table.add_row(*map(escape, row))
    out.print(table, soft_wrap=False)


def list_properties(chosen: Iterable[Property], model: Model) -> None:
    _print(
        ("id", "system", "on record", "requires"),
        ((p.id, p.on, model.expected(p.id).verdict, p.text) for p in chosen),
    )


def list_systems(model: Model) -> None:
    _print(
        ("name", "charts", "what it is"),
        (
            (s.name, ", ".join(c.name for c in s.charts), " ".join((s.text, *s.notes)))
            for s in model.systems.values()
        ),
    )


def list_charts(model: Model) -> None:
    _print(
        ("name", "states", "arrows", "what it is"),
        ((c.name, str(len(c.states) - 1), str(len(c.arrows)), c.text) for c in model.charts.values()),
    )


def list_requirements(model: Model) -> None:
    covered: dict[str, list[str]] = {}
    for prop in model.properties.values():
        for id in prop.covers:
            covered.setdefault(id, []).append(prop.id)
    _print(
        ("id", "source", "requirement", "properties"),
        ((r.id, r.source, r.text, ", ".join(covered.get(r.id, ["-"]))) for r in model.requirements.values()),
    )


def list_readings() -> None:
    """Every reading: the sentence, the choices (the default marked), what tells them apart."""
    about = ""
    for one in readings().values():
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
    out.print(fill(text, out.width, subsequent_indent=" " * indent), markup=False)


def list_repairs() -> None:
    _print(
        ("name", "repairs", "what changes"),
        ((r.name, ", ".join(r.fixes), r.text) for r in proposals().values()),
    )


def list_assumptions(model: Model) -> None:
    holders: dict[tuple[str, str], list[str]] = {}
    for system in model.systems.values():
        for one in system.assumptions:
            holders.setdefault((one.id, one.text), []).append(system.name)
    _print(
        ("id", "what is assumed", "of"),
        ((id, text, ", ".join(names)) for (id, text), names in holders.items()),
    )


def list_engines() -> None:
    rows = [(e.NAME, e.SUMMARY) for e in engines().values()]
    rows.append((AUTO, "engines in turn, each with more to spend; the first conclusive answer counts"))
    rows.append((ALL, "every engine; answers that cannot both be true are an error (exit code 3)"))
    _print(("name", "what it does"), rows)


LISTS: dict[str, Callable[[Model], None]] = {
    "systems": list_systems,
    "charts": list_charts,
    "requirements": list_requirements,
    "assumptions": list_assumptions,
}
OTHERS: dict[str, Callable[[], None]] = {
    "readings": list_readings,
    "repairs": list_repairs,
    "engines": list_engines,
}


def listing(
    what: str,
    ids: Sequence[str] = (),
    english: bool = False,
    path: Path | None = None,
    as_json: bool = False,
) -> Exit:
    """Print one of the lists, of the rover or the model at a path; of the properties those of ``ids``.

    With ``english`` these are told in words, which JSON has in any case.  Raises ``UsageError`` for ids or
    ``english`` with another list, and for a list that only the rover has.
    """
    if what != "properties" and (ids or english):
        raise UsageError(
            f"Ids and --english choose among properties; write `rovercheck list {what}` without them, "
            "or `rovercheck list properties [ID]... --english`."
        )
    if path is not None and what in OTHERS and what != "engines":
        raise UsageError(f"No model of your own has {what}; write `rovercheck list {what}` without --model.")
    model = None if what in OTHERS else _model(path)
    chosen = pick_properties(ids, None, model.stated(), full=True) if model and what == "properties" else []
    if as_json:
        print(json.dumps(document(what, chosen, model), indent=1, ensure_ascii=False))
    elif model is None:
        OTHERS[what]()
    elif what in LISTS:
        LISTS[what](model)
    else:
        (in_english if english else list_properties)(chosen, model)
    return Exit.AS_EXPECTED


def _model(path: Path | None) -> Model:
    return rover() if path is None else load(path)
