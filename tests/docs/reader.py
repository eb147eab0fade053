"""A reader of the documents, who writes the files, types the commands and compares what is printed."""

import io
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import chdir, redirect_stderr, redirect_stdout
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from unittest.mock import patch

from docs.reference.listings import Listing, applied
from rovercheck.checker.cli import run

MARKS = "✓✗≈?"
ANYWHERE = re.compile(r"(?:check|trace)(?: P[A-Z0-9]+-[0-9a-z]+)+")
"""Questions about the rover alone: they read and write no file of the folder that one is in."""
PROMPT = re.compile(r"^tick \d+, [\d.]+ m?s> (.+)$")


PROGRESS = re.compile(
    r"(?m)^(?:(?:\d+ of [\d,]+(?: [a-z]+)?, )?(?:\d+ (?:h|min|s) )+so far\b.*"
    r"|following \S+|looking for causes in \d+ parts?(?:, \d+ of them searched)?)\n"
)


@dataclass
class Reader:
    """Somebody in a folder, who does as a page says."""

    folder: Path
    at: Path = field(init=False)

    def __post_init__(self) -> None:
        self.at = self.folder

    def write(self, listing: Listing) -> None:
        """The file that a listing shows: whole, or with ``added`` at its end, or changed."""
        file = self.at / listing.title
        before = file.read_text(encoding="utf-8") if file.exists() else ""
        if listing.language == "diff":
            text = applied(before, listing.text)
        else:
            assert bool(before) == listing.added, (
                f"{listing}: {file.name} is written twice, or added to nothing"
            )
            text = f"{before}\n{listing.text}\n" if listing.added else f"{listing.text}\n"
        file.write_text(text, encoding="utf-8")

    def type(self, command: str) -> tuple[int, str]:
        """The exit code of a command, and all that it prints in a terminal of 80 columns."""
        words = shlex.split(command, comments=True)
        match words[0].rpartition("/")[2]:
            case "rovercheck" if ANYWHERE.fullmatch(" ".join(words[1:])):
                return _anywhere(*words[1:])
            case "rovercheck":
                return _rovercheck(words[1:], self.at)
            case "pytest":
                return self._pytest(words[1:])
            case "cd":
                self.at /= words[1]
                return 0, ""
        raise AssertionError(f"nobody knows how to run `{command}`: add it to the table in elsewhere.py")

    def _pytest(self, words: list[str]) -> tuple[int, str]:
        command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", *words]
        done = subprocess.run(command, cwd=self.at, capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr


def _rovercheck(words: Sequence[str], folder: Path) -> tuple[int, str]:
    kept = io.TextIOWrapper(io.BytesIO(), encoding="utf-8", write_through=True)
    found = f"{Path(sys.executable).parent}{os.pathsep}{os.environ.get('PATH', '')}"  # as after activation
    known = {"COLUMNS": "80", "PATH": found}
    with chdir(folder), patch.dict(os.environ, known), redirect_stdout(kept), redirect_stderr(kept):
        code = run([*words])
    kept.seek(0)
    return int(code), kept.read()


@cache
def _anywhere(*words: str) -> tuple[int, str]:
    """One run for all pages that show it."""
    return _rovercheck(words, Path())


def session(shown: str) -> str:
    """The commands that are typed in a session of ``explore``, as a script."""
    return "".join(f"{typed[1]}\n" for line in shown.splitlines() if (typed := PROMPT.match(line)))


def typed(text: str) -> Iterator[tuple[str, str]]:
    """The commands of a listing with ``$``, each with what it prints."""
    for part in re.split(r"(?m)^\$ ", text)[1:]:
        command, _, shown = part.partition("\n")
        yield command, shown


def differs(shown: str, printed: str) -> str:
    """What a page shows and what is printed, where they differ; empty if they agree.

    ``...`` stands for anything within a line, or, alone in a line, for any lines.  Lines of verdicts may
    come in another order, since searches end in any, and progress of a slow machine is no output.
    """
    ours, theirs = _ordered(shown), _ordered(PROGRESS.sub("", printed))
    if re.fullmatch("".join(map(_pattern, ours)), "".join(f"{line}\n" for line in theirs)):
        return ""
    return "the page shows\n{}\n\nprinted is\n{}".format("\n".join(ours), "\n".join(theirs))


def _ordered(text: str) -> list[str]:
    """The lines, without blanks at their ends, those of neighbouring verdicts in order."""
    found: list[str] = []
    verdicts: list[str] = []
    for line in text.strip("\n").splitlines():
        if line[:1] and line[0] in MARKS:
            verdicts.append(line.rstrip())
        elif verdicts and line.startswith("    "):
            verdicts[-1] += f"\n{line.rstrip()}"
        else:
            found += [*sorted(verdicts), line.rstrip()]
            verdicts = []
    return [*found, *sorted(verdicts)]


def _pattern(line: str) -> str:
    if line.strip() == "...":
        return r"(?:.*\n)*?"
    return r".*?".join(map(re.escape, line.split("..."))) + r"\n"
