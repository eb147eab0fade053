"""Random systems of charts, written as models of Simulink and read again: do they do the same?

    python -m benchmarks.slx_runs [--write] [COUNT] [FIRST]

Each is run for 60 steps in the interpreter of charts, and what is read of its file in both readings; with
``--write`` also the charts in Python that ``import --write`` makes of the file.  The exit code is 1 if one of
them differs.
"""

import sys
import tempfile
from collections import Counter
from pathlib import Path

from rovercheck.spec_model.lang.errors import ModelError
from tests.export.slx_runs import differences, random_system


def main(count: int = 1000, first: int = 0, *, written: bool = False) -> int:
    """Run them, and print what differs; the exit code."""
    told = Counter[str]()
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(first, first + count):
            try:
                differences(random_system(seed), Path(folder), seed, written=written)
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
    given = [one for one in sys.argv[1:] if one != "--write"]
    sys.exit(main(*map(int, given), written="--write" in sys.argv))
