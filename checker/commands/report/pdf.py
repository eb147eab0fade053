"""The review page on paper: a PDF that an installed Chromium prints of it."""

import os
import re
import shutil
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.commands.shared.text_wrap import whole

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
VARIABLE = "CHROMIUM"
OLDEST = 131
"""The first Chromium that prints page numbers that a style sheet asks for."""
SECONDS = 300.0
_NUMBER = re.compile(r'<span class="page-number" data-of="([\w-]+)">')
"""Where the number of a page belongs in the contents."""
_OBJECT = re.compile(rb"(?:^|\n)(\d+) 0 obj\n(<<.*?)\nendobj", re.DOTALL)
_KIDS = re.compile(rb"/Type /Pages\b.*?/Kids \[([^]]*)\]", re.DOTALL)
_REFERENCE = re.compile(rb"(\d+) 0 R")
_DESTINATION = re.compile(rb"/(section-[\w-]+) \[(\d+) 0 R /XYZ")
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
        raise UsageError(
            f"Cannot write {whole(file)}: it is no file in a folder that exists. Choose another --pdf."
        )


def printed(page: Path, file: Path) -> None:
    """Print a page into a file, all of it or nothing, with the numbers of the pages in its contents.

    It is printed twice, since only what is printed shows on which page a section begins.  Raises
    ``UsageError`` with what the browser said.
    """
    with TemporaryDirectory(prefix="rovercheck-", dir=file.absolute().parent) as folder:
        made, numbered = Path(folder, "page.pdf"), Path(folder, "page.html")
        _print(page, made, folder)
        text = page.read_text(encoding="utf-8")
        numbered.write_text(with_pages(text, pages_of(made.read_bytes())), encoding="utf-8")
        _print(numbered, made, folder)
        made.replace(file)


def _print(page: Path, made: Path, folder: str) -> None:
    profile = f"--user-data-dir={Path(folder, 'profile')}"
    sandbox = ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
    words = [browser(), *FLAGS, *sandbox, profile, f"--print-to-pdf={made}", page.absolute().as_uri()]
    made.unlink(missing_ok=True)
    try:
        done = subprocess.run(
            words, capture_output=True, text=True, errors="replace", timeout=SECONDS, check=False
        )
    except subprocess.TimeoutExpired as late:
        raise UsageError(f"{words[0]} has not printed the page within {SECONDS:g} s.") from late
    if not made.is_file():
        said = done.stderr.strip().splitlines()[-1:] or [f"exit code {done.returncode}"]
        raise UsageError(f"{words[0]} has not printed the page: {said[0]}")


def with_pages(page: str, pages: Mapping[str, int]) -> str:
    """The page with the numbers of the pages on which sections begin in its contents."""

    def number(found: re.Match[str]) -> str:
        return f"{found[0]}{pages.get(found[1], '')}"

    return _NUMBER.sub(number, page)


def pages_of(document: bytes) -> dict[str, int]:
    """The page, from 1, on which each section begins, by its id, of a PDF as Chromium writes it.

    Empty where its objects are not found: they are compressed, or written in another way.
    """
    found = _OBJECT.findall(document)
    kids = {number: _REFERENCE.findall(of) for number, body in found for of in _KIDS.findall(body)}
    inner = {kid for of in kids.values() for kid in of}
    order = [page for root in kids if root not in inner for page in _leaves(root, kids)]
    places = {page: place for place, page in enumerate(order, 1)}
    named = (pair for _, body in found if not _KIDS.search(body) for pair in _DESTINATION.findall(body))
    return {name.decode(): places[page] for name, page in named if page in places}


def _leaves(node: bytes, kids: Mapping[bytes, Sequence[bytes]]) -> Iterator[bytes]:
    if node not in kids:
        yield node
    for kid in kids.get(node, ()):
        yield from _leaves(kid, kids)
