"""A program that runs commands one after the other, as a user types them, for tests of what a terminal shows.

It runs in a folder that has our ``examples``, and the ``lift`` of them.  Each command is quick: it decides,
or compares, only a part.
"""

import os
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from unittest.mock import patch

from rovercheck.checker.cli import run
from rovercheck.checker.commands.generate_tests import run as generating
from rovercheck.checker.commands.reports import run as reporting
from rovercheck.checker.compare import check, recorded_runs
from rovercheck.checker.compare.beside import Run
from rovercheck.checker.compare.environment import Environment
from rovercheck.checker.system.instrument.watch import watched
from rovercheck.checker.testgen.generate import Aim
from rovercheck.properties.catalogue import catalogue
from tests.testgen import cover_toys

ROOT = Path(__file__).parents[2]
LIFT = "--model lift"
MARK = "====="
"""Begins the line before each command, and the one after it with its exit code."""

COMMANDS = (
    f"check {LIFT} --certify --certificates certificates",
    f"trace LIFT-3 {LIFT} --witnesses 2",
    f"requirements {LIFT} --check",
    f"report {LIFT} -o review.html",
    f"certify certificates {LIFT}",
    f"graph lift {LIFT} --project Door -o door.svg",
    "reports -o reports",
    "compare --system board2 --impl python:tests.compare.cross_faults:StopsLate --examples 1",
    "check-log examples/logs",
    "simulate examples/scenarios/link_loss.toml -o motion.csv",
    "generate-tests --system toy --ticks 200 --jobs 1 -o tests",
    f"explore lift {LIFT} --trace LIFT-3 --script {ROOT}/tests/cli/conversation.txt",
)


def _known(env: Environment, folder: Path | None) -> Iterator[Run]:
    yield from islice(recorded_runs.counterexamples(env.board), 9)


def _few() -> dict[str, object]:
    return {"PB1-11": catalogue()["PB1-11"]}


def main() -> None:
    """Run every command, with one search at a time."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    toy = [Aim(cover_toys.TOY, watched(cover_toys.TOY.system).goals)]
    with (
        patch.object(check, "_known", _known),
        patch.object(reporting, "catalogue", _few),
        patch.object(reporting, "proofs", lambda record: ()),
        patch.object(reporting, "repair_pages", lambda proved: {}),
        patch.object(generating, "aims", lambda names, kinds, boards: toy),
        patch.object(generating, "_model", lambda board, charts: cover_toys.SYSTEM),
    ):
        for command in COMMANDS:
            print(f"{MARK} {command.split()[0]}", flush=True)
            code = run(command.split())
            print(f"{MARK} {int(code)}", flush=True)


if __name__ == "__main__":
    main()
