"""``RESULTS.md``: the tables of the last runs, each between its own marks, and what they were run on."""

import os
import platform
import re
from contextlib import suppress
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version

from benchmarks.measure import ROOT
from benchmarks.rivals import versions

FILE = ROOT / "benchmarks" / "RESULTS.md"
PACKAGES = ("llvmlite", "numpy", "z3-solver", "python-sat", "oxidd", "bitwuzla")
HEAD = """# What was measured

Written by `python -m benchmarks.compare --write` and `python -m benchmarks.growth --write`; `README.md`
says what the columns mean and how far to trust them. Figures are comparable within one run only.
"""


def cores() -> int:
    """The processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def machine() -> str:
    """``2 cores, x86-64, Python 3.11.7, gcc 12.2.0, ...``: nothing that names a machine."""
    kind = {"x86_64": "x86-64", "AMD64": "x86-64"}.get(platform.machine(), platform.machine())
    parts = [f"{cores()} cores", kind, f"Python {platform.python_version()}"]
    for package in PACKAGES:
        with suppress(PackageNotFoundError):
            parts.append(f"{package} {version(package)}")
    return ", ".join(parts + [f"{name} {number}" for name, number in versions().items()])


def load() -> str:
    """How busy the machine is now, in processes per core."""
    return f"{os.getloadavg()[0] / cores():.1f}" if hasattr(os, "getloadavg") else "an unknown number of"


def write(key: str, title: str, text: str, repetitions: int) -> None:
    """Replace the part of ``RESULTS.md`` between the marks of ``key``, or add it at the end."""
    day = datetime.now(UTC).date().isoformat()
    times = f"{repetitions} run{'s' * (repetitions > 1)} of each"
    about = f"{day}; {machine()}; {times}; at the end {load()} processes per core."
    start, end = f"<!-- {key} -->", f"<!-- end of {key} -->"
    part = f"{start}\n## {title}\n\n{about}\n\n{text.rstrip()}\n{end}\n"
    old = FILE.read_text(encoding="utf-8") if FILE.exists() else HEAD
    marked = re.compile(re.escape(start) + ".*?" + re.escape(end) + r"\n", re.DOTALL)
    new = marked.sub(lambda _: part, old) if marked.search(old) else f"{old.rstrip()}\n\n{part}"
    FILE.write_text(new, encoding="utf-8")
