"""What MkDocs does besides: the icon of the site, and files beside ``docs/``.

A page links to its neighbours as they lie in the repository (``../examples/README.md``).  On the site such
a file is a page or a download below ``project/``, and the links are rewritten.
"""

import posixpath
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from mkdocs.structure.files import File, Files

from docs.reference import pictures

ROOT = Path(__file__).parents[2]
PROJECT = "project/"
ALWAYS = ("README.md", "CONTRIBUTING.md", "CHANGES.md")
VENDOR = Path(__file__).parent / "vendor" / "iframe-worker"
SHIM = "assets/iframe-worker.js"
FETCHED = "https://unpkg.com/iframe-worker/shim"
LINK = re.compile(r"(?<=\]\()(?![a-z]+:|#)([^)#\s]+)(#[^)\s]*)?(?=\))")
ROW = re.compile(r"(?m)^\|.*$")
CODE = re.compile(r"`[^`\n]+`")
GENERATED: dict[str, Callable[[], str]] = {
    "pictures/icon.svg": lambda: pictures.ICON,
}


def on_files(files: Files, config: Any) -> Files:
    """Adds what is generated, and the files of the repository that pages link to."""
    for place, made in GENERATED.items():
        files.append(File.generated(config, place, content=made()))
    files.append(File.generated(config, SHIM, content=(VENDOR / "shim.js").read_text(encoding="utf-8")))
    for place in sorted(_linked(set(ALWAYS) | {f"docs/{f.src_uri}" for f in files.documentation_pages()})):
        files.append(File.generated(config, _on_site(place), abs_src_path=str(ROOT / place)))
    return files


def on_page_markdown(markdown: str, page: Any, **_: object) -> str:
    """Links as the site needs them, and in tables code whose bars need no backslash here."""
    here = page.file.src_uri

    def rewritten(link: re.Match[str]) -> str:
        target = _on_site(_target(_in_repository(here), link[1]))
        return posixpath.relpath(target, posixpath.dirname(here) or ".") + (link[2] or "").lower()

    return ROW.sub(_plain_bars, LINK.sub(rewritten, markdown))


def _plain_bars(row: re.Match[str]) -> str:
    return CODE.sub(lambda code: code[0].replace("\\|", "|"), row[0])


def on_post_page(output: str, page: Any, **_: object) -> str:
    """The one script that the theme would fetch from the network, from the site itself."""
    return output.replace(FETCHED, posixpath.relpath(SHIM, posixpath.dirname(page.file.dest_uri) or "."))


def on_post_template(output_content: str, **_: object) -> str:
    """The same for the page that says that there is no such page, which is shown in any folder."""
    return output_content.replace(FETCHED, f"/{SHIM}")


def _linked(pages: set[str]) -> set[str]:
    """The files outside ``docs/`` that the pages link to, directly or through each other."""
    found, todo = {p for p in pages if not p.startswith("docs/")}, list(pages)
    while todo:
        for target in set(_targets(todo.pop())) - found:
            found.add(target)
            todo += [target] if target.endswith(".md") else []
    return found


def _targets(place: str) -> Iterator[str]:
    source = ROOT / place
    text = source.read_text(encoding="utf-8") if source.is_file() else ""
    for link in LINK.finditer(text):
        target = _target(place, link[1])
        if not target.startswith("docs/") and (ROOT / target).is_file():
            yield target


def _target(place: str, link: str) -> str:
    """What a link means, as a path in the repository; a folder means its README."""
    target = posixpath.normpath(posixpath.join(posixpath.dirname(place), link))
    return f"{target}/README.md" if (ROOT / target).is_dir() else target


def _in_repository(place: str) -> str:
    return place.removeprefix(PROJECT) if place.startswith(PROJECT) else f"docs/{place}"


def _on_site(target: str) -> str:
    """Where a file of the repository is on the site, which leaves files with a leading dot out."""
    return target.removeprefix("docs/") if target.startswith("docs/") else PROJECT + target.replace("/.", "/")
