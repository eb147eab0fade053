"""Calls of other model checkers, where they are installed."""

import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest

from rovercheck.checker.export import Problem, exporters

needs_abc = pytest.mark.skipif(not shutil.which("berkeley-abc"), reason="berkeley-abc is not installed")
needs_spin = pytest.mark.skipif(
    not (shutil.which("spin") and shutil.which("gcc")), reason="spin and gcc are not both installed"
)
MOST_SECONDS = 120


@dataclass(frozen=True)
class Outcome:
    """What a tool said: a bad state is reached, after so many ticks if it told, or never."""

    reached: bool
    ticks: int = 0


def abc(problem: Problem, folder: Path, command: str = "pdr") -> Outcome:
    """What ABC says of a problem with one bad state.  ``bmc3`` finds shortest runs; ``pdr`` proves too.

    What has no latches is for ``pdr`` alone.
    """
    data = exporters()["aiger"].export(problem)
    assert isinstance(data, bytes)
    (folder / "problem.aig").write_bytes(data)
    said = _run(["berkeley-abc", "-q", f"read_aiger problem.aig; fold; {command}"], folder)
    if "combinational" in said and command != "pdr":
        return abc(problem, folder)
    found = re.search(r"asserted in frame (\d+)", said)
    if found:
        return Outcome(True, int(found[1]) + 1)
    assert re.search(r"Property proved|No output(s)? asserted|trivially", said, re.IGNORECASE), said
    return Outcome(False)


def spin(problem: Problem, folder: Path) -> Outcome:
    """What SPIN says of a problem: whether some assertion is violated."""
    text = exporters()["promela"].export(problem)
    (folder / "problem.pml").write_text(str(text), encoding="utf-8")
    _run(["spin", "-a", "problem.pml"], folder)
    _run(["gcc", "-O0", "-w", "-DSAFETY", "-DBFS", "-o", "pan", "pan.c"], folder)
    said = _run(["./pan"], folder)
    [errors] = re.findall(r"errors: (\d+)", said)
    assert "Search not completed" not in said or errors != "0", said
    return Outcome(errors != "0")


def _run(command: list[str], folder: Path) -> str:
    done = subprocess.run(
        command, cwd=folder, capture_output=True, text=True, timeout=MOST_SECONDS, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout + done.stderr
