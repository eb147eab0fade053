"""``rovercheck init``: a small model to begin with, in a folder of the user's own."""

from importlib.resources import files
from pathlib import Path
from shlex import quote

from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import err, write
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.model import shown

WRITTEN = {
    "heater.py": Path("heater.py"),
    "baseline.toml": Path("baseline.toml"),
    "README.md": Path("README.md"),
    "workflow.yml": Path(".github", "workflows", "rovercheck.yml"),
}
"""The files of ``checker/model/start`` and where each is written."""


def init(folder: Path) -> Exit:
    """Write the model, its expected verdicts and a file for CI; nothing is overwritten.

    Raises ``UsageError`` if one of the files is there already, or the folder cannot be written.
    """
    there = [shown(folder / name) for name in WRITTEN.values() if (folder / name).exists()]
    if there:
        raise UsageError(
            f"Already there: {', '.join(map(whole, there))}. Nothing is overwritten; name another folder."
        )
    _make(folder)
    source = files("rovercheck.checker.model").joinpath("start")
    for name, place in WRITTEN.items():
        _make((folder / place).parent)
        write(source.joinpath(name).read_bytes(), folder / place)
        err.print(f"wrote {whole(shown(folder / place))}", markup=False)
    check = whole(f"rovercheck check --model {quote(shown(folder / 'heater.py'))}")
    err.print(f"\nCheck it: {check}", markup=False)
    return Exit.AS_EXPECTED


def _make(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(
            f"Cannot make the folder {whole(shown(folder))}: {error.strerror}. Name another."
        ) from error
