"""The page on the rover while nothing has changed: it is written again without reading a chart.

It is kept under one key of every file of rovercheck and of all that was asked of the page.
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, astuple, dataclass, replace
from datetime import date
from hashlib import sha256
from pathlib import Path
from typing import Any

from rovercheck.checker.cache import entries
from rovercheck.checker.commands.check.findings import Guide
from rovercheck.checker.commands.check.text import summary
from rovercheck.checker.commands.check.unchanged import keepable, told_of
from rovercheck.checker.commands.report import PageOptions
from rovercheck.checker.commands.report.origin import commit_of_rover, versions
from rovercheck.checker.commands.report.pdf import printable, printed
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.options import SearchOptions, SelectionOptions
from rovercheck.checker.commands.shared.output import counted, out, write
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.commands.shared.told import ToldVerdict
from rovercheck.checker.store.tree import tree_key

SCHEMA = "rovercheck/page/1"


@dataclass(frozen=True)
class KeptPage:
    """The HTML of a page, what the terminal tells of its verdicts, and the exit code."""

    html: str
    told: Sequence[ToldVerdict]
    code: Exit


@dataclass(frozen=True)
class PageKeeper:
    """Where a page is kept, for the files as they were when the command began."""

    tree: str
    name: str

    @staticmethod
    def now(search: SearchOptions, selection: SelectionOptions, page: PageOptions) -> "PageKeeper | None":
        """For the files as they are now, and today; None where they cannot be read."""
        try:
            tree = tree_key()
        except OSError:
            return None
        asked = astuple(replace(page, pdf=None, jobs=None))
        today = date.today().isoformat()
        about = [
            SCHEMA,
            tree,
            today,
            commit_of_rover(),
            versions(),
            astuple(search),
            astuple(selection),
            asked,
        ]
        return PageKeeper(tree, f"{sha256(json.dumps(about).encode()).hexdigest()}-page-json")

    def read(self) -> KeptPage | None:
        """The page; None if there is none, or what is kept has no meaning."""
        whole = entries.read(self.name, code=False)
        try:
            return None if whole is None else _page(json.loads(whole))
        except entries.MEANINGLESS:
            return None

    def write(self, page: KeptPage) -> None:
        """Keep a page, unless something on it is open or a file has changed meanwhile."""
        try:
            same = tree_key() == self.tree
        except OSError:
            return
        if same and all(map(keepable, page.told)):
            whole = {"html": page.html, "told": [asdict(one) for one in page.told], "code": page.code}
            entries.write(self.name, json.dumps(whole, separators=(",", ":")).encode())


def _page(found: Mapping[str, Any]) -> KeptPage:
    return KeptPage(str(found["html"]), [told_of(row) for row in found["told"]], Exit(found["code"]))


def possible(output: Path, pdf: Path | None) -> None:
    """Raises ``UsageError`` where a page certainly cannot be written or printed, before it is made."""
    if not output.parent.is_dir() or output.is_dir():
        raise UsageError(
            f"Cannot write {whole(output)}: it is no file in a folder that exists. Choose another --output."
        )
    if pdf is not None:
        printable(pdf)


def delivered(page: KeptPage, guide: Guide, output: Path, pdf: Path | None) -> Exit:
    """Write the page, print it where that is asked for, and tell of its verdicts.  Raises ``UsageError``."""
    write(page.html, output)
    if pdf is not None:
        printed(output, pdf)
    summary(page.told, guide)
    for file in filter(None, (output, pdf)):
        out.print(f"{whole(file)}: {counted(file.stat().st_size, 'byte', 'bytes')}.", markup=False)
    return page.code
