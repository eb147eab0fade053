"""``rovercheck export``: properties as problems for other model checkers, a file each."""

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from rovercheck.checker.commands.export import CHARTS
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import err, write, wrote
from rovercheck.checker.commands.shared.property_text import formally
from rovercheck.checker.commands.shared.select import pick, pick_properties
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.commands.shared.variant import askable
from rovercheck.checker.export import Exporter, exporters, problem
from rovercheck.checker.model.variant import Variant
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import System


def export(
    ids: Sequence[str], about: Sequence[str], format: str, variant: Variant, output: Path | None
) -> Exit:
    """Write the chosen properties in a format: one to a file or standard output, several to a folder.

    Of several, those that the format cannot say are named and left out.  Raises ``UsageError`` for names
    without meaning and for a place that cannot be written, ``ModelError`` when nothing can be exported.
    """
    pick("export format", format, {**exporters(), **dict.fromkeys(CHARTS)})
    exporter = exporters()[format]
    if not ids and not about:
        raise UsageError("Nothing names what to export; write the ids of properties, or --system NAME.")
    chosen = pick_properties(ids, about, variant.properties(), True, variant.unchanged())
    if variant.name:
        chosen = askable(variant, chosen)
    if not chosen:
        raise UsageError("Nothing to export: no such property is about such a system.")
    systems = variant.systems()
    if len(chosen) == 1:
        [prop] = chosen
        data = _exported(prop, systems[prop.on], exporter, variant.name)
        into = output is not None and output.is_dir()
        target = output / file_name(prop.id, exporter) if output is not None and into else output
        write(data, target)
        wrote(target)
        return Exit.AS_EXPECTED
    return _several(chosen, systems, exporter, variant.name, output)


def _several(
    chosen: Sequence[Property],
    systems: Mapping[str, System],
    exporter: Exporter,
    variant: str,
    output: Path | None,
) -> Exit:
    if output is None:
        raise UsageError(f"{len(chosen)} properties need a folder; write --output FOLDER.")
    _folder(output)
    refused: list[ModelError] = []
    for prop in chosen:
        try:
            data = _exported(prop, systems[prop.on], exporter, variant)
        except ModelError as error:
            refused.append(error)
            err.print(f"{prop.id} is left out: {error}", markup=False)
            continue
        target = output / file_name(prop.id, exporter)
        write(data, target)
        wrote(target)
    if len(refused) == len(chosen):
        raise refused[0]
    return Exit.AS_EXPECTED


def _exported(prop: Property, system: System, exporter: Exporter, variant: str) -> str | bytes:
    about = [formally(prop, system, "checked: ")[0], *([f"variant: {variant}"] if variant else [])]
    return exporter.export(problem(lower(system), prop, about))


def file_name(id: str, exporter: Exporter) -> str:
    """The name of the file of a property: its id, with what no file system minds, and the suffix."""
    return f"{re.sub(r'[^A-Za-z0-9._-]', '_', id)}{exporter.FORMAT.suffix}"


def _folder(place: Path) -> None:
    try:
        place.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(
            f"Cannot write {whole(place)}: {error.strerror}. Choose another --output."
        ) from error
