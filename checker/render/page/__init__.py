"""Self-contained HTML pages: parts of a page, put together into one file that fetches nothing.

A *part* is markup with the styles and scripts it needs.  Scripts are only those of this package: a page
carries a content security policy that names their hashes and forbids everything else.
"""

from base64 import b64encode
from collections.abc import Iterable
from dataclasses import dataclass
from hashlib import sha256
from importlib.resources import files

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

TEMPLATES = Environment(
    loader=PackageLoader("checker.render", "page"),
    autoescape=True,
    undefined=StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
)


@dataclass(frozen=True)
class Part:
    """Markup (whatever came from a model is escaped in it), and the styles and scripts that it needs.

    Each different style and script is put into a page once, in the order of first use.
    """

    body: Markup
    styles: tuple[str, ...] = ()
    scripts: tuple[str, ...] = ()


def own(name: str) -> str:
    """The text of a file beside this one: a style sheet or a script."""
    return files(__name__).joinpath(name).read_text(encoding="utf-8")


def page(title: str, parts: Iterable[Part]) -> str:
    """One HTML document with the parts in their order."""
    shown = list(parts)
    styles = [own("base.css"), *dict.fromkeys(text for part in shown for text in part.styles)]
    scripts = [*dict.fromkeys(text for part in shown for text in part.scripts)]
    return TEMPLATES.get_template("page.html").render(
        title=title,
        policy=_policy(scripts),
        styles=[Markup(text) for text in styles],
        scripts=[Markup(text) for text in scripts],
        bodies=[part.body for part in shown],
    )


NONE = "'none'"


def _policy(scripts: Iterable[str]) -> str:
    """Nothing is fetched; only these scripts run."""
    hashes = " ".join(f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'" for text in scripts)
    return f"default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src {hashes or NONE}"
