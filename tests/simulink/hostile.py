"""What becomes of a package that nobody can trust: a model, or one message; nothing is written or started."""

import json
import os
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.checker.drawn.refused import notes_of
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.packages import DIAGRAM, packed
from rovercheck.spec_model.lang.errors import ModelError
from tests.simulink.samples import SAMPLES

ROOT = "simulink/systems/system_root.xml"
CHART = "simulink/stateflow/chart_22.xml"
MACHINE = "simulink/stateflow/machine.xml"
FORBIDDEN = ("subprocess.", "os.system", "os.exec", "os.posix_spawn", "socket.", "os.mkdir", "os.rename",
             "os.remove", "pickle.", "ctypes.", "shutil.", "tempfile.")  # fmt: skip
LONGEST = 600
"""Letters of a message."""
_watching: list[list[str]] = []


def _heard(event: str, arguments: tuple[object, ...]) -> None:
    if not _watching:
        return
    if event == "open":
        path, _, flags = arguments
        writes = isinstance(flags, int) and flags & (os.O_WRONLY | os.O_RDWR | os.O_CREAT)
        if writes and "__pycache__" not in str(path):
            _watching[-1].append(f"open {path!s} to write")
    elif event.startswith(FORBIDDEN):
        _watching[-1].append(event)


sys.addaudithook(_heard)


@contextmanager
def harmless() -> Iterator[None]:
    """Nothing is written to a disk, sent or started meanwhile."""
    done: list[str] = []
    _watching.append(done)
    try:
        yield
    finally:
        _watching.pop()
    assert done == []


def outcome(path: Path) -> DrawnModel | str:
    """The model in a package with all its notes, or the message why there is none."""
    try:
        with harmless():
            model = read_model(path)
            for note in notes_of(model):
                str(note)
            json.dumps(model, default=vars, allow_nan=False)
            return model
    except ModelError as error:
        message = str(error)
        assert message.isprintable() and message.endswith(".") and len(message) < LONGEST + len(str(path))
        return message.replace(f"{path.parent}/", "")


def refusal(path: Path) -> str:
    """Why a package is not read."""
    found = outcome(path)
    assert isinstance(found, str), "it is read"
    return found


def refused_parts(files: Mapping[str, bytes | str], folder: Path) -> str:
    """Why a package of these parts is not read."""
    packed(folder / "hostile.slx", files)
    return refusal(folder / "hostile.slx")


def lamp(**more: bytes | str) -> Mapping[str, bytes | str]:
    """The parts of a sound model, with some in place of its own."""
    names = {"root": ROOT, "chart": CHART, "diagram": DIAGRAM, "machine": MACHINE}
    return {**SAMPLES["1_lamp"]().files(), **{names[name]: text for name, text in more.items()}}


def package_in(folder: Path, files: Mapping[str, bytes | str]) -> Path:
    """A package of these parts."""
    packed(folder / "model.slx", files)
    return folder / "model.slx"


__all__ = [
    "CHART", "MACHINE", "ROOT", "harmless", "lamp", "outcome", "package_in", "refusal", "refused_parts",
]  # fmt: skip
