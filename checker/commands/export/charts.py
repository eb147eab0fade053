"""``rovercheck export --format slx`` or ``scxml``: the charts of a system as one file for other tools."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Protocol

from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import err, wrote
from rovercheck.checker.commands.shared.select import pick
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.export.scxml import scxml_of
from rovercheck.checker.export.slx import simulink_of
from rovercheck.checker.model.variant import Variant
from rovercheck.spec_model.lang.system import System


class WrittenCharts(Protocol):
    """The charts of a system in another format; ``notes`` say what the files do not hold."""

    @property
    def name(self) -> str: ...
    @property
    def notes(self) -> tuple[str, ...]: ...
    def save(self, path: Path, /) -> tuple[Path, ...]: ...


FORMATS: Mapping[str, tuple[Callable[[System], WrittenCharts], str]] = {
    "slx": (simulink_of, "model of Simulink"),
    "scxml": (scxml_of, "machine in SCXML"),
}
"""What writes a system, and what it is called."""


def export_charts(
    ids: Sequence[str], about: Sequence[str], format: str, variant: Variant, output: Path | None
) -> Exit:
    """Write a system with the files beside it; what these do not hold is said.

    Raises ``UsageError`` where no one system is named, or no file can be written, ``ModelError`` for a system
    with something that the format has not.
    """
    if ids or len(about) != 1:
        raise UsageError("Charts are written for one system; write --system NAME, and no property.")
    write, kind = FORMATS[format]
    made, suffix = write(pick("system", about[0], variant.systems())), f".{format}"
    target = output or Path(f"{made.name}{suffix}")
    if target.is_dir():
        target /= f"{made.name}{suffix}"
    if target.suffix != suffix:
        raise UsageError(f"{whole(target)} is no {kind}; name a file that ends with {suffix}.")
    try:
        for one in made.save(target):
            wrote(one)
    except OSError as error:
        raise UsageError(
            f"Cannot write {whole(target)}: {error.strerror}. Choose another --output."
        ) from error
    for note in made.notes:
        err.print(f"Not in the file: {note}.", markup=False)
    return Exit.AS_EXPECTED
