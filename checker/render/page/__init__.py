"""Self-contained HTML pages: parts of a page, put together into one file that fetches nothing.

A *part* is markup with the styles and scripts it needs.  Scripts are only those of this package: a page
carries a content security policy that names their hashes and forbids everything else, also scripts and
handlers that somebody wrote into a text of a model.  Data for a script lies in a block made by ``data``.
"""

import json
import re
from base64 import b64encode
from collections.abc import Iterable
from dataclasses import dataclass
from hashlib import sha256
from importlib.resources import files
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup


def templates(folder: str) -> Environment:
    """The templates of a package beside this one, every value escaped, no name left undefined."""
    return Environment(
        loader=PackageLoader("rovercheck.checker.render", folder),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )


TEMPLATES = templates("page")


@dataclass(frozen=True)
class Part:
    """Markup (whatever came from a model is escaped in it), and the styles and scripts that it needs.

    Each different style and script is put into a page once, in the order of first use.  Scripts run once,
    at the end of the page; what a page puts in later is told by an event ``page:added`` on its container.
    """

    body: Markup
    styles: tuple[str, ...] = ()
    scripts: tuple[str, ...] = ()


def together(parts: Iterable[Part]) -> Part:
    """The parts as one in which everything that shows one run follows: a tick chosen here is shown there.

    Scripts of parts tell such a tick by an event ``page:tick`` at the element around them, which keeps it.
    """
    shown = list(parts)
    body = Markup("\n").join(part.body for part in shown)
    return Part(
        Markup("<div data-together>\n{}\n</div>").format(body),
        tuple(dict.fromkeys(text for part in shown for text in part.styles)),
        tuple(dict.fromkeys(text for part in shown for text in part.scripts)),
    )


def own(name: str) -> str:
    """The text of a file beside this one: a style sheet or a script."""
    return files(__name__).joinpath(name).read_text(encoding="utf-8")


def data(value: Any, kind: str) -> Markup:
    """A block of JSON that scripts find by the class ``kind`` and that never runs.

    No text in it can end the block: every ``<`` is written as an escape of JSON.
    """
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c")
    return Markup('<script type="application/json" class="{}">{}</script>').format(kind, Markup(text))


def page(title: str, parts: Iterable[Part], *, connects: bool = False) -> str:
    """One HTML document with the parts in their order; one that ``connects`` may ask its own server.

    Raises ``ValueError`` for a style or script that would end its own element.
    """
    shown = list(parts)
    styles = [own("base.css"), *dict.fromkeys(text for part in shown for text in part.styles)]
    scripts = [*dict.fromkeys(text for part in shown for text in part.scripts)]
    return TEMPLATES.get_template("page.html").render(
        title=title,
        policy=_policy(scripts, connects),
        styles=[_whole(text, "style") for text in styles],
        scripts=[_whole(text, "script") for text in scripts],
        bodies=[part.body for part in shown],
    )


def _whole(text: str, element: str) -> Markup:
    if re.search(rf"</{element}|<!--", text, re.IGNORECASE):
        raise ValueError(f"A {element} of a page holds '</{element}' or '<!--'; write '<\\/' or '<\\!--'.")
    return Markup(text)


NONE, SELF = "'none'", "'self'"


def _policy(scripts: Iterable[str], connects: bool) -> str:
    """Nothing is embedded, only these scripts run, and nothing is fetched or sent, but to its own server."""
    hashes = " ".join(f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'" for text in scripts)
    return (
        f"default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src {hashes or NONE}; "
        f"connect-src {SELF if connects else NONE}; base-uri 'none'; form-action 'none'"
    )
