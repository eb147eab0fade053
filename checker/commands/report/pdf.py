"""The review page on paper: a PDF that an installed Chromium prints of it."""

import os
import shutil
import subprocess
from pathlib import Path
from tempfile import TemporaryDirectory

from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.commands.shared.text_wrap import whole

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
VARIABLE = "CHROMIUM"
OLDEST = 131
"""The first Chromium that prints page numbers that a style sheet asks for."""
SECONDS = 300.0
FLAGS = (
    "--headless",
    "--disable-gpu",
    "--disable-background-networking",
    "--no-first-run",
    "--no-pdf-header-footer",
    "--generate-pdf-document-outline",
)


def browser() -> str:
    """The Chromium to print with: ``$CHROMIUM``, or the first of the usual names.  Raises ``UsageError``."""
    named = os.environ.get(VARIABLE)
    found = shutil.which(named) if named else next(filter(None, map(shutil.which, NAMES)), None)
    if found is None:
        missing = f"{VARIABLE}={named} is no program" if named else "no Chromium is installed"
        raise UsageError(
            f"--pdf needs a Chromium to print with, and {missing}. Install one (on Debian and Ubuntu: "
            f"apt install chromium), name one in {VARIABLE}, or print the page from a browser."
        )
    return found


def printable(file: Path) -> None:
    """Raises ``UsageError`` where nothing can be printed into a file, before anything is searched."""
    browser()
    if not file.parent.is_dir() or file.is_dir():
        raise UsageError(f"Cannot write {whole(file)}: it is no file in a folder that exists. Choose another --pdf.")


def printed(page: Path, file: Path) -> None:
    """Print a page into a file, all of it or nothing.  Raises ``UsageError`` with what the browser said."""
    with TemporaryDirectory(prefix="rovercheck-", dir=file.absolute().parent) as folder:
        made = Path(folder, "page.pdf")
        profile = f"--user-data-dir={Path(folder, 'profile')}"
        sandbox = ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
        words = [browser(), *FLAGS, *sandbox, profile, f"--print-to-pdf={made}", page.absolute().as_uri()]
        try:
            done = subprocess.run(words, capture_output=True, text=True, errors="replace", timeout=SECONDS)
        except subprocess.TimeoutExpired as late:
            raise UsageError(f"{words[0]} has not printed {whole(page)} within {SECONDS:g} s.") from late
        if not made.is_file():
            said = done.stderr.strip().splitlines()[-1:] or [f"exit code {done.returncode}"]
            raise UsageError(f"{words[0]} has not printed {whole(page)}: {said[0]}")
        made.replace(file)
