"""Other tools on RoverLite: C by hand, SPIN, ABC and Z3, each as something to run again and again.

A tool that is not installed is None; every other failure is an error, never an empty cell.
"""

import re
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from benchmarks.measure import ROOT, Cost, Sample, Tool, run
from benchmarks.peers.spin import promela
from benchmarks.roverlite import FULL, question
from rovercheck.checker.export import exporters, problem
from rovercheck.spec_model.lang.lower import lower

PEERS = ROOT / "benchmarks" / "peers"
ABC = "berkeley-abc"
DEEPEST = {(31, 10): 10_000_000}
"""Steps that SPIN's depth-first search may be deep, where a million do not suffice; it clears the memory."""


def versions() -> dict[str, str]:
    """The outside tools that are here, and their versions; Debian's where the tool tells none."""
    asked = {"gcc": ["gcc", "-dumpfullversion"], "spin": ["spin", "-V"], ABC: [ABC, "-q", "version"]}
    found = {}
    for name, command in asked.items():
        if shutil.which(name):
            text = subprocess.run(command, capture_output=True, text=True, check=False).stdout
            found[name] = re.sub(r"^(Spin Version|UC Berkeley, ABC) | *\(compiled.*| -- .*", "", text.strip())
    return found


def made(command: Sequence[str | Path], folder: Path) -> None:
    """Run a generator or compiler.  Raises ``CalledProcessError`` when it fails."""
    subprocess.run(command, cwd=folder, check=True, capture_output=True)


def c_search(comp: int, k: int, factored: bool, folder: Path) -> Tool | None:
    """The C search of a model, compiled."""
    if shutil.which("gcc") is None:
        return None
    program = folder / f"c-{comp}-{k}-{factored}"
    options = ["-O3", "-march=native", f"-DCOMP={comp}", f"-DK={k}", *["-DFACT"] * factored]
    made(["gcc", *options, "-o", program, PEERS / "c" / "bfs.c"], folder)

    def once() -> Sample:
        cost = checked(run([program]))
        return Sample(
            float(told(cost, r"cpu=([\d.]+)")),
            float(told(cost, r" t=([\d.]+)")),
            "searched",
            states=int(told(cost, r"states=(\d+)")),
            memory=cost.memory,
        )

    return once


def spin_search(comp: int, k: int, folder: Path, limit: float) -> Tool | None:
    """SPIN's verifier of a model, compiled; it is given ``limit`` seconds of wall time."""
    if shutil.which("gcc") is None or shutil.which("spin") is None:
        return None
    here = folder / f"spin-{comp}-{k}"
    here.mkdir()
    (here / "rover.pml").write_text(promela(comp, k), encoding="utf-8")
    made(["spin", "-a", "rover.pml"], here)
    made(["gcc", "-O2", "-DSAFETY", "-w", "-o", "pan", "pan.c"], here)

    deepest = DEEPEST.get((comp, k), 1_000_000)

    def once() -> Sample:
        cost = run([here / "pan", f"-m{deepest}"], limit, here)
        complete = re.search(r"errors: 0\n +([\d.e+]+) states, stored", cost.text)
        if cost.timed_out or complete is None or "max search depth too small" in cost.text:
            return Sample(cost.seconds, cost.wall, "open", note="not to its end")
        states = int(float(complete.group(1)))
        return Sample(cost.seconds, cost.wall, "searched", states=states, memory=cost.memory)

    return once


def abc(command: str, name: str, limit: float) -> Tool | None:
    """An engine of ABC on the AIGER file by hand of a property of the full model at full timing.

    It reads registered outputs, so that the number of the frame is the number of steps.
    """
    file = PEERS / "aiger" / f"rover_bad{name.removeprefix('P')}.aig"
    return _abc(f"read_aiger {file}; {command}", 0, limit)


def abc_exported(name: str, folder: Path, limit: float) -> Tool | None:
    """ABC's pdr on what we export for the same property: only its cone, read within the step.

    The bad state of frame n is that of tick n + 1; ``fold`` makes the constraint on inputs part of it.
    """
    system, properties = question(FULL)
    prop = next(p for p in properties if p.id == f"RL-{name}")
    data = exporters()["aiger"].export(problem(lower(system), prop))
    file = folder / f"{name}.aig"
    file.write_bytes(data if isinstance(data, bytes) else data.encode())
    return _abc(f"read_aiger {file}; fold; pdr", 1, limit)


def _abc(script: str, ticks_before: int, limit: float) -> Tool | None:
    if shutil.which(ABC) is None:
        return None

    def once() -> Sample:
        cost = run([ABC, "-q", script], limit)
        frame = re.search(r"asserted in frame (\d+)", cost.text)
        if frame is not None:
            return Sample(cost.seconds, cost.wall, "reached", length=int(frame.group(1)) + ticks_before)
        proved = "Property proved" in cost.text
        return Sample(cost.seconds, cost.wall, "proved" if proved else "open")

    return once


def z3(name: str, limit: float, mode: str = "unroll") -> Tool:
    """Z3 on the full model at full timing: ``unroll`` or ``induct``."""

    def once() -> Sample:
        command = [sys.executable, "-m", "benchmarks.peers.unrolling", mode, name, "1"]
        cost = run(command, limit, ROOT)
        if not cost.timed_out:
            checked(cost)
        verdict, _, length = cost.text.strip().partition(" ")
        if cost.timed_out or verdict == "open":
            return Sample(cost.seconds, cost.wall, "open")
        return Sample(cost.seconds, cost.wall, verdict, length=int(length) if length else None)

    return once


def checked(cost: Cost) -> Cost:
    if cost.status:
        raise RuntimeError(f"a tool ended with status {cost.status}: {cost.text[-400:]}")
    return cost


def told(cost: Cost, pattern: str) -> str:
    """What the tool printed where the pattern has its group."""
    found = re.search(pattern, cost.text)
    if found is None:
        raise RuntimeError(f"nothing like {pattern} in what the tool printed: {cost.text[-400:]}")
    return found.group(1)
