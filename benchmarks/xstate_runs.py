"""Random machines in XState itself: do they do the same?

    npm install --prefix FOLDER x5@npm:xstate@5 x4@npm:xstate@4
    XSTATE=FOLDER/node_modules python -m benchmarks.xstate_runs [COUNT] [FIRST] [VERSION]

Each is run for 25 steps in the interpreter of rovercheck and there, with node; what is active, the context
and the actions that ran are compared after each, up to a step in which several delays are over: XState takes
those in the order in which they began.  The exit code is 1 if one of them differs.
"""

import json
import subprocess
import sys
from collections import Counter
from pathlib import Path
from random import Random
from typing import Any

from rovercheck.checker.scxml.records import StateMachine
from rovercheck.checker.scxml.xstate.bindings import RAISE, Bindings
from rovercheck.checker.scxml.xstate.reader import xstate_machine_of
from rovercheck.spec_model.lang.errors import ModelError
from tests.scxml.random_xstate import Step, random_xstate, xstate_runs, xstate_steps

STEPS = 25


def asked(text: str, bindings: Bindings, machine: StateMachine, steps: list[Step]) -> str:
    """A machine and its steps as a line for node."""
    made: dict[str, Any] = {
        "version": bindings.version, "config": json.loads(text), "guards": dict(bindings.guards),
        "free": machine.guards, "named": machine.actions, "tick": machine.tick, "steps": steps,
        "assigns": {name: one for name, one in bindings.actions.items() if RAISE not in one},
        "raises": {name: one[RAISE] for name, one in bindings.actions.items() if RAISE in one},
    }  # fmt: skip
    return json.dumps(made)


def difference(machine: StateMachine, steps: list[Step], answer: dict[str, Any]) -> str:
    """Where a machine differs first; empty where both do the same, up to a step that is told in its place."""
    ours = list(xstate_runs(machine, steps, at_once=False))
    if "error" in answer:
        return f"there: {answer['error'][:200]}" if len(ours) == len(steps) else ""
    for number, (mine, told) in enumerate(zip(ours, answer["told"], strict=False), start=1):
        active = sorted(one.known_path for one in machine.states if one.id in mine[0])
        paths = sorted(one.partition(".")[2] for one in active)
        if [paths, mine[1], sorted(mine[2])] != told:
            return f"step {number} {steps[number - 1]}: {paths} {mine[1:]}, {told}"
    return ""


def main(count: int = 300, first: int = 0, version: int = 5) -> int:
    """Run them, and print what differs; the exit code."""
    told = Counter[str]()
    runs: list[tuple[int, StateMachine, list[Step]]] = []
    lines: list[str] = []
    for seed in range(first, first + count):
        text, bindings = random_xstate(seed, version)
        try:
            machine = xstate_machine_of(text.encode(), "random.json", bindings)
        except ModelError:
            told["refused"] += 1
            continue
        steps = xstate_steps(machine, Random(seed), STEPS)
        runs.append((seed, machine, steps))
        lines.append(asked(text, bindings, machine, steps))
    script = str(Path(__file__).with_suffix(".js"))
    done = subprocess.run(
        ["node", script], input="\n".join(lines), capture_output=True, text=True, check=True
    )
    for (seed, machine, steps), answer in zip(runs, done.stdout.splitlines(), strict=True):
        found = difference(machine, steps, json.loads(answer))
        told["different" if found else "alike"] += 1
        if found:
            print(f"{seed}: {found}")
    print(", ".join(f"{number} {word}" for word, number in told.items()))
    return 1 if told["different"] else 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
