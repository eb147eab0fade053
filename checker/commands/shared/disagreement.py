"""Engines that disagree: what is needed to see it again, in a folder of its own."""

import json
import platform
import shlex
from collections.abc import Iterator
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.commands.shared.output import write
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.results.verdict import Reached, Run
from rovercheck.checker.verify.decide import Disagreement
from rovercheck.checker.verify.portfolio.disagreement import Statement
from rovercheck.properties.catalogue import catalogue

SCHEMA = "rovercheck/disagreement/1"
SOLVERS = ("rovercheck", "z3-solver", "llvmlite", "numpy", "python-sat", "oxidd", "bitwuzla", "cvc5")


def bundle(found: Disagreement, command: list[str], folder: Path) -> Path:
    """Write the question, every answer and the command that asks again; the folder made in ``folder``.

    Raises ``UsageError`` when the place cannot be written.
    """
    document = json.dumps(_document(found, command), indent=2, ensure_ascii=False)
    target = folder / f"rovercheck-disagreement-{sha256(document.encode()).hexdigest()[:12]}"
    try:
        target.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(
            f"Cannot write {whole(target)}: {error.strerror}. Run it in another folder."
        ) from error
    write(document + "\n", target / "disagreement.json")
    write("\n".join(_readme(found, command)), target / "README.md")
    return target


def again(found: Disagreement, arguments: list[str]) -> list[str]:
    """The command that asks again, about the one property if the goal is one's."""
    only = [found.goal] if found.goal in catalogue() and arguments[:1] == ["check"] else []
    return ["rovercheck", *arguments, *(id for id in only if id not in arguments)]


def _document(found: Disagreement, command: list[str]) -> dict[str, object]:
    return {
        "schema": SCHEMA,
        "command": command,
        "system": found.system,
        "goal": found.goal,
        "answers": [_answer(said) for said in found.said],
        "versions": dict(_versions()),
    }


def _answer(said: Statement) -> dict[str, object]:
    run = _run(said.answer.run) if isinstance(said.answer, Reached) else None
    return {"engine": said.engine, "says": said.words, "replays": said.replayed, "run": run}


def _run(run: Run) -> dict[str, object]:
    return {"frozen": dict(run.frozen), "inputs": [dict(tick) for tick in run.inputs]}


def _versions() -> Iterator[tuple[str, str]]:
    yield "python", platform.python_version()
    for name in SOLVERS:
        try:
            yield name, version(name)
        except PackageNotFoundError:
            yield name, "not installed"


def _readme(found: Disagreement, command: list[str]) -> Iterator[str]:
    yield f"# Engines disagree about {found.goal} of {found.system}"
    yield ""
    yield from (f"- {said}" for said in found.said)
    yield ""
    yield "At least one engine is wrong; please report it with this folder. To see it again:"
    yield ""
    yield "    " + shlex.join(command)
    yield ""
    yield "`disagreement.json` holds the runs as raw values, tick by tick, and the versions of all solvers."
    yield ""
