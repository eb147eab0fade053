"""``rovercheck import MODEL.slx --write FOLDER``: the model as charts in Python, compared first."""

import os
import shutil
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from keyword import iskeyword
from pathlib import Path

from rovercheck.checker.commands.import_.equality import Equality, equality_of
from rovercheck.checker.commands.import_.lines import say
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import counted, err
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.drawn.charts.system import DrawnCharts, charts_of_model
from rovercheck.checker.drawn.lower.domains import domains_path, read_domains
from rovercheck.checker.drawn.lower.lowered import LoweredModel
from rovercheck.checker.drawn.lower.symbols import NotLowered
from rovercheck.checker.export.source.module import SourceModule, module_of
from rovercheck.checker.export.source.names import plain_word
from rovercheck.checker.export.source.properties import WrittenNames, begun, rewritten
from rovercheck.checker.model import shown
from rovercheck.checker.model.drawn import lowered_simulink
from rovercheck.checker.model.execute import TESTS
from rovercheck.checker.model.load import load
from rovercheck.checker.model.neighbours import installed
from rovercheck.checker.model.records import baseline_of
from rovercheck.checker.model.two_readings import Readings, compared_readings
from rovercheck.checker.simulink.model import read_model
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Named, Var
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.walk import structure
from rovercheck.spec_model.lang.wellformed import check_system

SECONDS = 5.0
"""Seconds of the processor for which the written model is run beside the direct interpreter."""
OF_PROPERTIES = ("baseline.toml", "hazards.toml", "requirements.toml")
AROUND = "keep the .slx as the model: `--model {}` works with it"


@dataclass(frozen=True)
class WrittenModel:
    """The files of a model by name, what of them says what, and what is to be told about its properties."""

    name: str
    module: SourceModule
    files: Mapping[str, str]
    told: tuple[str, ...]


def write_model(path: Path, beside: Sequence[Path], folder: Path) -> Exit:
    """Write a model as a folder of Python, once it is shown to do what is drawn.

    Raises ``ModelError`` for what has no meaning or no words here, ``UsageError`` for a folder that is not
    empty.
    """
    _refuse_full(folder)
    said = read_domains(domains_path(path))
    lowered = lowered_simulink(path, read_model(path, [*said.beside, *beside]), said).lowered
    try:
        drawn = charts_of_model(lowered, path.name, said.step)
        written = written_model(path, drawn)
    except (NotLowered, ModelError) as error:
        lines = str(error).rstrip(".").splitlines()
        raise ModelError(
            f"{path.name} is not written: {'; '.join(lines)}. This has no words in a chart in Python: "
            f"{AROUND.format(whole(shown(path)))}."
        ) from error
    with _made(folder) as place:
        for name, text in written.files.items():
            (place / name).write_text(text, encoding="utf-8")
        readings, equal = compared(place, drawn.model, lowered, said.step)
    for one in written.told:
        say(one)
    _tell(folder, written, readings, equal)
    return Exit.AS_EXPECTED


def written_model(path: Path, drawn: DrawnCharts) -> WrittenModel:
    """The files of a model.  Raises ``ModelError`` for what has no words."""
    check_system(drawn.model.system)
    model = drawn.model.model
    release = f" of Simulink {model.release}" if model.release else ""
    system = replace(drawn.model.system, text=f"The model {model.name}, written from {path.name}.")
    module = module_of(system, drawn.labels, f"The model {model.name}{release}, written from {path.name}.")
    name = _module_name(path.stem)
    line = f"from . import {name}" if installed(name) else f"import {name}"
    charts = {one.name: (module.charts[one.name], one) for one in drawn.model.system.charts}
    names = WrittenNames(line, module.system, dict(_signals(drawn.model, module)), charts)
    files, told = {f"{name}.py": module.text}, list[str]()
    own = path.with_name(f"{path.stem}_properties")
    copied = sorted(own.glob("*.py")) if own.is_dir() else [own.with_suffix(".py")]
    for file in copied:
        if file.is_file():
            try:
                own_name = file.name if own.is_dir() else f"{name}_properties.py"
                files[own_name] = rewritten(file.read_text(encoding="utf-8"), names)
            except (ModelError, UnicodeDecodeError) as error:
                told.append(f"{file.name} is not copied: {error}. Write it about {name}.py by hand.")
    if len(files) == 1 and charts:
        files[f"{name}_properties.py"] = begun(f"the model {model.name}", names)
    for file, copy in _beside(path):
        if told and copy in OF_PROPERTIES:
            told.append(f"{file.name} is not copied: it speaks of properties that are not.")
        else:
            files[copy] = file.read_text(encoding="utf-8")
    return WrittenModel(name, module, files, tuple(told))


def _beside(path: Path) -> Iterator[tuple[Path, str]]:
    """The files beside a model that speak of it, and what each is called beside the written one."""
    every = [(baseline_of(path), "baseline.toml"), (domains_path(path), domains_path(path).name)]
    every += [(path.with_name(name), name) for name in ("hazards.toml", "requirements.toml")]
    yield from (one for one in every if one[0].is_file())


def _module_name(stem: str) -> str:
    """The name of a module that a model may have: no test of pytest's."""
    name = plain_word(stem)
    ends = any(Path(f"{name}.py").match(one) for one in TESTS) or name.endswith("_properties")
    return f"model_{name}_model" if ends or not name.isidentifier() or iskeyword(name) else name


def _signals(model: LoweredModel, module: SourceModule) -> Iterator[tuple[str, str]]:
    """The words of Python for inputs, outputs and data, by their names in Simulink."""
    own = {name.rpartition(".")[2]: expr for name, expr in model.data.items()}
    for name, expr in {**own, **model.data, **model.inputs, **model.outputs}.items():
        if isinstance(expr, Var) and expr.name in module.variables:
            yield name, module.variables[expr.name]
        elif isinstance(expr, Named) and (word := module.formulas.get((expr.name, structure(expr.body)))):
            yield name, word


# --- comparing ---------------------------------------------------------------------------------------------


def compared(place: Path, drawn: LoweredModel, lowered: LoweredModel, step: str) -> tuple[Readings, Equality]:
    """Load what is written, and compare it with what is drawn.  Raises ``ModelError`` where they differ."""
    system = _loaded(place, drawn.system.name)
    readings = compared_readings(replace(drawn, system=system), SECONDS, step)
    difference = str(readings.difference or "")
    if readings.difference is not None and lowered.real and not readings.difference.said:
        difference = ""  # real numbers are exact here, which is said of the drawn model, too
    ends = {name: (drawn.outputs[name], one) for name, one in lowered.outputs.items()}
    equal = Equality() if difference else equality_of(system, lowered.system, ends)
    if difference or equal.difference:
        raise ModelError(
            f"{drawn.model.name} is not written: what was to be written does otherwise than what is drawn, "
            f"{difference or equal.difference}. This is an error of rovercheck: please report it."
        )
    return readings, equal


def _loaded(place: Path, name: str) -> System:
    try:
        return load(place).systems[name]
    except (ModelError, KeyError) as error:
        lines = "; ".join(str(error).replace(f"{shown(place)}/", "").splitlines())
        raise ModelError(f"it cannot be written as a model in Python: {lines}") from error


# --- the folder --------------------------------------------------------------------------------------------


def _refuse_full(folder: Path) -> None:
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        what = "is not empty" if folder.is_dir() else "is no folder"
        raise UsageError(f"{whole(shown(folder))} {what}. Nothing is overwritten; name another folder.")


@contextmanager
def _made(folder: Path) -> Iterator[Path]:
    """A folder beside the one that is asked for, which it becomes once all is well; else nothing is left."""
    made: Path | None = None
    try:
        folder.absolute().parent.mkdir(parents=True, exist_ok=True)
        made = Path(tempfile.mkdtemp(prefix=f".{folder.name}-", dir=folder.absolute().parent))
        yield made
        made.chmod(0o777 & ~_umask())
        if folder.exists():
            folder.rmdir()
        made.rename(folder.absolute())
    except OSError as error:
        raise UsageError(
            f"Cannot write the folder {whole(shown(folder))}: {error.strerror}. Name another."
        ) from error
    finally:
        if made is not None:
            shutil.rmtree(made, ignore_errors=True)


def _umask() -> int:
    now = os.umask(0)
    os.umask(now)
    return now


def _tell(folder: Path, written: WrittenModel, readings: Readings, equal: Equality) -> None:
    for name in written.files:
        err.print(f"wrote {whole(shown(folder / name))}", markup=False)
    if equal.proved:
        say(f"✓ It does what is drawn: proved, {equal.how}.")
    else:
        say(f"• It does what is drawn in random runs; {equal.how}.")
    steps = counted(readings.steps, "step", "steps")
    say(f"  In {steps} of random runs the direct interpreter gives the same.")
    say(f"Check it: rovercheck check --model {shown(folder)}")


__all__ = ["WrittenModel", "compared", "write_model", "written_model"]
