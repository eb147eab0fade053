"""``rovercheck docs``: the pages of the documentation, from the wheel or from a clone."""

import webbrowser
from collections.abc import Mapping
from pathlib import Path

import click
from rich.markdown import Markdown

from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import at_terminal, out
from rovercheck.checker.commands.shared.tables import listed
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.spec_model.lang.errors import did_you_mean

HOME = "index"
"""The page with which the list begins."""
WIDEST = 100
"""Columns of a page, also on a wider terminal."""


def docs(name: str | None, opened: bool, place: bool) -> Exit:
    """List the pages, show one, open it in the browser, or say where it is.

    Raises ``UsageError`` for a page that there is not, and where no site is built or no browser is found.
    """
    if opened and place:
        raise UsageError("--open and --path exclude each other; write one of them.")
    folder = installed()
    known = pages(folder)
    file = known[_named(name, known)] if name is not None else folder / f"{HOME}.md"
    if opened:
        _open(folder, file)
    elif place:
        print(folder if name is None else file)
    elif name is not None:
        _show(file)
    else:
        _list(known)
    return Exit.AS_EXPECTED


def installed() -> Path:
    """The folder of the pages: in the package, or in a clone beside it.  Raises ``UsageError`` without."""
    # Four folders up is `rovercheck` in the wheel, and in a clone, whose links are followed, its top.
    folder = Path(__file__).resolve().parents[3] / "docs"
    if not (folder / f"{HOME}.md").is_file():
        raise UsageError(f"The pages are not where they belong, in {whole(folder)}: install rovercheck anew.")
    return folder


def pages(folder: Path) -> Mapping[str, Path]:
    """The pages by name, the first one first and the reference last."""
    found = {p.relative_to(folder).with_suffix("").as_posix(): p for p in folder.rglob("*.md")}
    order = sorted(found, key=lambda name: (name != HOME, "/" in name, name))
    return {name: found[name] for name in order}


def _named(name: str, known: Mapping[str, Path]) -> str:
    """The page meant, which may also be written as the pages link to it: ``ci.md#caches``, ``docs/ci.md``."""
    wanted = name.partition("#")[0].removeprefix("docs/").removesuffix(".md")
    if wanted in known:
        return wanted
    ends = [one for one in known if one.endswith(f"/{wanted}")]
    if len(ends) == 1:
        return ends[0]
    raise UsageError(f"There is no page {name!r}. {did_you_mean(wanted, known)} rovercheck docs lists all.")


def _list(known: Mapping[str, Path]) -> None:
    listed(("page", "about"), [(name, title(file)) for name, file in known.items()])


def title(file: Path) -> str:
    """The heading of a page."""
    with file.open(encoding="utf-8") as lines:
        return next((line[2:].strip() for line in lines if line.startswith("# ")), "")


def _show(file: Path) -> None:
    text = file.read_text(encoding="utf-8")
    if not at_terminal(out):
        out.print(text, end="", markup=False)
        return
    with out.capture() as captured:
        out.print(
            Markdown(text, hyperlinks=False), width=min(out.width, WIDEST), soft_wrap=False, no_wrap=False
        )
    shown = captured.get()
    if shown.count("\n") < out.height:
        print(shown, end="")
    else:
        click.echo_via_pager(shown)


def _open(folder: Path, file: Path) -> None:
    site = folder.parent / "site"
    built = site / file.relative_to(folder).with_suffix(".html")
    if not built.is_file():
        raise UsageError(
            f"No site is built in {whole(site)}. In a clone `make docs` builds it; without --open the page "
            "is shown here."
        )
    if not webbrowser.open(built.as_uri()):
        raise UsageError(f"No browser is found. The page is {whole(built)}.")
