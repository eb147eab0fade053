"""Random systems of charts, written as models of Simulink and read again: do they do the same?

    python -m benchmarks.slx_runs [COUNT] [FIRST]

Each is run for 60 steps in the interpreter of charts, and what is read of its file in both readings.  The
exit code is 1 if one of them differs.
"""

import sys
import tempfile
from collections import Counter
from pathlib import Path

from rovercheck.spec_model.lang.errors import ModelError
from tests.export.slx_runs import differences, random_system


def main(count: int = 1000, first: int = 0) -> int:
    """Run them, and print what differs; the exit code."""
    told = Counter[str]()
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(first, first + count):
            try:
                differences(random_system(seed), Path(folder), seed)
                told["alike"] += 1
            except ModelError as error:
                told["refused"] += 1
                print(f"{seed}: {error}", flush=True)
            except AssertionError as error:
                told["different"] += 1
                print(error, flush=True)
    print(", ".join(f"{number} {word}" for word, number in told.items()))
    return 1 if told["different"] else 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
