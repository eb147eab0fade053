"""How long ``rovercheck check`` of the rover takes after one guard of one chart was edited.

    python -m benchmarks.edits [CHART ...]

Copies the project, checks the rover once from an empty store, then edits one chart after the other, each time
in a copy of the charts and of the store as they were, and checks again.  Prints the wall time and the time of
the processor in all processes for each edit, and the medians.  The target is 10 s on the wall in the median;
the exit code is 1 if it is missed.
"""

import os
import resource
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from time import perf_counter

TARGET = 10.0
ROOT = Path(__file__).parents[1]
EDITS = {
    "board1/temperature": ("for_=4 * sec", "for_=5 * sec"),
    "board1/battery": ("when=b < 23", "when=b < 22"),
    "board1/wheels": ('to("Wheel_CRIT", when=lost & ~consistent)', 'to("Wheel_CRIT", when=lost)'),
    "board1/relay": ("> 3 * sec", "> 2 * sec"),
    "board1/safety": (
        'to("Rover_Degraded_State", when=degraded)',
        'to("Rover_Degraded_State", when=degraded & ~critical)',
    ),
    "board1/reception": ('to("Rx_DEG", when=rx_slow)', 'to("Rx_DEG", when=rx_slow & ~silent)'),
    "board1/motion": ("when=stop_commanded | critical,", "when=stop_commanded,"),
    "board2/monitors": ("recovered(source, 1 * sec)", "recovered(source, 2 * sec)"),
    "board2/obstacles": ('to("J3", when=~is_close & detected)', 'to("J3", when=detected)'),
    "board2/failure_check": ('duration(named("!q", ~q)) > 3 * sec', 'duration(named("!q", ~q)) > 2 * sec'),
    "board2/acquisition": ("after(20 * ms)", "after(40 * ms)"),
}
"""What is written in a chart, and what takes its place, once."""
LEFT_OUT = shutil.ignore_patterns(".git", ".venv", "build", "__pycache__", ".hypothesis", "*.egg-info")


@dataclass(frozen=True)
class Took:
    """Seconds, and the exit code of the command."""

    wall: float
    processor: float
    code: int


def main(charts: list[str]) -> int:
    """Measure and print; the exit code."""
    unknown = [name for name in charts if name not in EDITS]
    if unknown:
        print(
            f"{', '.join(unknown)}: no edit of this is known. There are {', '.join(EDITS)}.", file=sys.stderr
        )
        return 4
    with tempfile.TemporaryDirectory(prefix="rovercheck-edits-") as place:
        project, store, spare = (Path(place) / name for name in ("project", "store", "spare"))
        shutil.copytree(ROOT, project, symlinks=True, ignore=LEFT_OUT)
        told("empty store", checked(project, spare))
        told("unchanged", checked(project, spare))
        took = []
        for name in charts or EDITS:
            shutil.rmtree(store, ignore_errors=True)
            shutil.copytree(spare, store)
            took.append(edited(project, store, name))
            told(name, took[-1])
    walls, processor = [one.wall for one in took], [one.processor for one in took]
    print(f"{'median':24} {median(walls):7.1f} s, processor {median(processor):7.1f} s")
    return 0 if median(walls) < TARGET else 1


def edited(project: Path, store: Path, name: str) -> Took:
    """What a check takes with a chart edited, which is then as it was."""
    file, (before, after) = project / "spec_model" / f"{name}.py", EDITS[name]
    written = file.read_text(encoding="utf-8")
    assert before in written, f"{name} has no `{before}` any more: write another edit."
    file.write_text(written.replace(before, after, 1), encoding="utf-8")
    try:
        return checked(project, store)
    finally:
        file.write_text(written, encoding="utf-8")


def checked(project: Path, store: Path) -> Took:
    """What a check of the rover takes, with what is kept in a folder."""
    environment: Mapping[str, str] = {
        **os.environ, "ROVERCHECK_CACHE": str(store), "ROVERCHECK_SECRET": str(store.with_name("secret")),
    }  # fmt: skip
    before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), perf_counter()
    command = [sys.executable, "-m", "rovercheck", "check", "--quiet"]
    done = subprocess.run(command, cwd=project, env=environment, capture_output=True, check=False)
    wall, after = perf_counter() - begun, resource.getrusage(resource.RUSAGE_CHILDREN)
    assert done.returncode in (0, 1), done.stderr.decode()
    return Took(wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.returncode)


def told(what: str, took: Took) -> None:
    """A line of the table."""
    print(f"{what:24} {took.wall:7.1f} s, processor {took.processor:7.1f} s, exit {took.code}", flush=True)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
