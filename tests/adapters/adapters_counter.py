"""A supervisor that counts its steps and repeats its inputs, with traps: as a class, and as a command."""

import ctypes
import json
import os
import signal
import sys
import time
from pathlib import Path

TRAP_FROM = 1000
TELL = "ADAPTERS_COUNTER_HANGS"
"""Names the file to make before a step without end."""


def crash():
    ctypes.string_at(0)


def abort():
    os.kill(os.getpid(), signal.SIGABRT)


def leave():
    os._exit(0)


def hang():
    if TELL in os.environ:
        Path(os.environ[TELL]).touch()
    while True:
        time.sleep(1)


def fill():
    kept = []
    while True:
        kept.append(bytearray(1 << 22))


TRAPS = (crash, abort, leave, hang, fill)


class Counter:
    """``critical_mask`` counts; ``omega_user`` is the process; a temperature of 1000 or more is a trap."""

    def __init__(self):
        self.count = 0

    def step(self, inputs):
        self.count += 1
        if inputs["temperature_degC"] >= TRAP_FROM:
            TRAPS[int(inputs["temperature_degC"]) - TRAP_FROM]()
        return {
            "critical_mask": self.count % 256,
            "v_ref": inputs["x_norm"],
            "v_user": inputs["battery_pct"],
            "give_b2_actuation": inputs["btn1"],
            "current_action": inputs["cmd"],
            "omega_user": os.getpid(),
        }


def main():
    """The class as a command."""
    counter = Counter()
    for line in sys.stdin:
        order = json.loads(line)
        if "reset" in order:
            counter = Counter()
        print(json.dumps(counter.step(_numbers(order["step"])) if "step" in order else {}), flush=True)


def _numbers(values):
    return {name: float(value) if isinstance(value, str) else value for name, value in values.items()}


if __name__ == "__main__":
    main()
