"""The sanitizers of the C compiler: whether it has them is asked, and what they say is read."""

import os
import re
import subprocess
import tempfile
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from rovercheck.checker.adapters.c_build import compiler

FLAGS = (
    "-fsanitize=address,undefined,float-cast-overflow",
    "-fno-sanitize-recover=all",
    "-fno-omit-frame-pointer",
)
TRIAL = "int trial(int x) { return x + 1; }\n"
SECONDS = 60
RUNTIME = re.compile(r"^\s*(?:.*/)?([^/:\s]+:\d+)(?::\d+)?: runtime error: (.*)$", re.M)
SUMMARY = re.compile(
    r"^SUMMARY: AddressSanitizer: (\S+)(?: (?:.*/)?([^/\s]+:\d+))?(?::\d+)?(?: in (\S+))?", re.M
)
FRAME = re.compile(r"^ +#\d+ \S+ in (\S+) (?:.*/)?([^/\s]+):\d+", re.M)


@dataclass(frozen=True)
class Sanitizers:
    """What compiles with them and what runs what was so compiled; ``missing`` says why there are none."""

    flags: tuple[str, ...] = ()
    environment: Mapping[str, str] | None = None
    missing: str = ""


def sanitizers(folder: Path) -> Sanitizers:
    """Those of the compiler, tried on a small program; they write what they find into ``folder``."""
    cc = compiler()
    if cc is None:
        return Sanitizers(missing="there is no C compiler")
    runtime = _said([cc, "-print-file-name=libasan.so"]).strip()
    if not Path(runtime).is_absolute():
        return Sanitizers(missing=f"{Path(cc).name} has no library of AddressSanitizer (libasan.so)")
    environment = {
        "LD_PRELOAD": runtime,
        "ASAN_OPTIONS": f"detect_leaks=0:abort_on_error=1:log_path={folder}/found",
        "UBSAN_OPTIONS": f"print_stacktrace=0:log_path={folder}/found",
    }
    with tempfile.TemporaryDirectory(prefix="rovercheck-") as place:
        source, made = Path(place, "trial.c"), Path(place, "trial.so")
        source.write_text(TRIAL, encoding="utf-8")
        built = subprocess.run(
            [cc, *FLAGS, "-shared", "-fPIC", "-o", str(made), str(source)],
            capture_output=True, text=True, timeout=SECONDS, check=False,
        )  # fmt: skip
        if built.returncode:
            return Sanitizers(missing=f"{Path(cc).name} does not compile with {FLAGS[0]}")
    return Sanitizers(FLAGS, environment)


def said_by(folder: Path, heard: str) -> tuple[str, str] | None:
    """Where in the code, and what a sanitizer found last; its file is deleted.

    ``heard`` is what was said on standard error, where some versions of GCC let it be said.
    """
    found = None
    if hit := RUNTIME.search(heard):
        found = hit[1], hit[2]
    for file in sorted(folder.glob("found*"), key=lambda f: f.stat().st_mtime):
        text = file.read_text(encoding="utf-8", errors="replace")
        file.unlink()
        if hit := RUNTIME.search(text):
            found = hit[1], hit[2]
        elif hit := SUMMARY.search(text):
            found = _recursion(text) or (hit[2] or hit[3] or "", hit[1])
    return found


def _recursion(text: str) -> tuple[str, str] | None:
    """Files and functions that call each other until the stack is full.

    The line at which it is full differs from run to run with the addresses of the process.
    """
    calls = Counter(FRAME.findall(text)) if "AddressSanitizer: stack-overflow" in text else {}
    again = sorted(call for call, count in calls.items() if count > 1)
    if not again:
        return None
    functions = [name for name, _ in again]
    whom = (
        f"{functions[0]}, which calls itself"
        if len(again) == 1
        else f"{', '.join(functions)}, which call each other"
    )
    return ", ".join(sorted({file for _, file in again})), f"stack-overflow in {whom}"


def _said(command: list[str]) -> str:
    done = subprocess.run(
        command, capture_output=True, text=True, timeout=SECONDS, check=False,
        env={**os.environ, "LC_ALL": "C"},
    )  # fmt: skip
    return done.stdout
