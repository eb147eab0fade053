"""Runs the files of a user's model; what goes wrong is reported with file and line."""

import linecache
import re
import traceback
from collections.abc import Sequence
from functools import partial
from importlib import import_module
from pathlib import Path
from types import ModuleType

from rovercheck.checker.model import FOREIGN, shown
from rovercheck.checker.model.neighbours import Neighbours
from rovercheck.checker.model.statements import statement_faults
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.place import Place

_FORMULA = re.compile(r"'(Var|Const|Apply|Named|Temporal)' object is not iterable")
_OURS = Path(__file__).parents[2]
_PACKAGES = {"site-packages", "dist-packages"}
"""Folders of an environment, which may lie in that of the model."""
_MODELS = "a model is a .py file, a folder of them, a .slx, .scxml or .json file"
TESTS = ("test_*.py", "*_test.py", "conftest.py")


def files_of(path: Path) -> list[Path]:
    """The file, or the Python files of a folder, tests left out, in the order of their names.

    Raises ``ModelError`` for what is no Python file and no folder with one.
    """
    if path.is_dir():
        inside = [f for f in sorted(path.glob("*.py")) if f.is_file() and not any(map(f.match, TESTS))]
        if not inside:
            raise ModelError(f"{shown(path)} holds no Python file; {_MODELS}.")
        return inside
    if not path.exists():
        raise ModelError(f"There is no {shown(path)}; {_MODELS}.")
    if path.suffix in FOREIGN:
        return _properties_of(path)
    if path.suffix != ".py":
        raise ModelError(f"{shown(path)} is no Python file; {_MODELS}.")
    if "." in path.stem:
        raise ModelError(f"{shown(path)} has a dot in its name, which no module can have; rename the file.")
    return [path]


def _properties_of(path: Path) -> list[Path]:
    """The files with the properties of a model of Simulink, ``NAME_properties``: a file or a folder."""
    beside = path.with_name(f"{path.stem}_properties")
    if beside.is_dir():
        return files_of(beside)
    file = beside.with_suffix(".py")
    return files_of(file) if file.exists() else []


def modules_of(
    files: Sequence[Path], folder: Path
) -> tuple[Neighbours, list[tuple[Path, ModuleType]], list[str]]:
    """The files of one folder that run, with their modules; and what is wrong with the others, with lines."""
    neighbours = Neighbours(folder)
    modules, faults = list[tuple[Path, ModuleType]](), list[str]()
    with neighbours.importing():
        for file in files:
            try:
                modules.append((file, _run(neighbours, file)))
            except ModelError as error:
                name = f"{neighbours.package}.{file.stem}"
                whole = neighbours.folder / file.name
                others = statement_faults(whole, name, partial(_located, neighbours=neighbours, file=file))
                told = dict.fromkeys([str(error), *others])
                faults += (one.replace(f"{neighbours.package}.", "") for one in told)
    return neighbours, modules, faults


def _run(neighbours: Neighbours, file: Path) -> ModuleType:
    try:
        return neighbours.module(file)
    except SyntaxError as error:
        where = Place(error.filename or str(file), error.lineno) if error.lineno else shown(file)
        raise ModelError(f"{where}: this is not Python: {error.msg}.") from error
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # also what is meant for test runners and event loops
        raise ModelError(_located(error, neighbours, file)) from error


def _located(error: BaseException, neighbours: Neighbours, file: Path) -> str:
    """The error with the last line of the user's that led to it."""
    frames = [f for f in traceback.extract_tb(error.__traceback__) if _of_the_user(f.filename, neighbours)]
    place, line = Place(str(file), 1), ""
    if frames and frames[-1].lineno:
        linecache.checkcache(frames[-1].filename)
        place, line = Place(frames[-1].filename, frames[-1].lineno), frames[-1].line or ""
    if isinstance(error, ModelError):
        return f"{place}: {error}"
    said = f"{type(error).__name__}{f': {error}' if str(error) else ''}"
    return f"{place}: {said}{f', in `{line}`' if line else ''}.{_hint(error, neighbours)}"


def _of_the_user(filename: str, neighbours: Neighbours) -> bool:
    """Whether a file is of the model, and not of a package in an environment that lies beside it."""
    path = Path(filename)
    if not path.is_relative_to(neighbours.folder) or path.is_relative_to(_OURS):
        return False
    return _PACKAGES.isdisjoint(path.relative_to(neighbours.folder).parts)


def _hint(error: BaseException, neighbours: Neighbours) -> str:
    """For a formula taken for a list, a state for an attribute, and names that are imported otherwise."""
    if isinstance(error, TypeError) and _FORMULA.fullmatch(str(error)):
        return " A formula is no list; join conditions with & and |, or with all_of(...) and any_of(...)."
    name = (getattr(error, "name", None) or "").partition(".")[0]
    if isinstance(error, AttributeError) and isinstance(error.obj, Chart) and (name,) in error.obj.states:
        return f' It is a state: the condition that it is active is .active("{name}").'
    if isinstance(error, NameError) and name in import_module("rovercheck.language").__all__:
        return f" It is a word of the language: write `from rovercheck import {name}`."
    if isinstance(error, ModuleNotFoundError) and name in ("spec_model", "properties"):
        return " What a model needs is imported from one place: write `from rovercheck import ...`."
    if isinstance(error, ImportError) and name in neighbours.hidden():
        return (
            f" An installed package is named {name} too: write `from .{name} import ...`, or rename the file."
        )
    return ""
