"""``rovercheck export --format slx``: the charts of a system as a model of Simulink."""

from collections.abc import Sequence
from pathlib import Path

from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import err, wrote
from rovercheck.checker.commands.shared.select import pick
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.export.slx import simulink_of
from rovercheck.checker.model.variant import Variant

SUFFIX = ".slx"


def export_simulink(ids: Sequence[str], about: Sequence[str], variant: Variant, output: Path | None) -> Exit:
    """Write a system with the files beside it; what these do not hold is said.

    Raises ``UsageError`` where no one system is named, or no file can be written, ``ModelError`` for a system
    with something that Stateflow has not.
    """
    if ids or len(about) != 1:
        raise UsageError("Charts are written for one system; write --system NAME, and no property.")
    made = simulink_of(pick("system", about[0], variant.systems()))
    target = output or Path(f"{made.name}{SUFFIX}")
    if target.is_dir():
        target /= f"{made.name}{SUFFIX}"
    if target.suffix != SUFFIX:
        raise UsageError(f"{whole(target)} is no model of Simulink; name a file that ends with {SUFFIX}.")
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
