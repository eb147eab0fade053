"""The live page of ``rovercheck serve``: what its server knows is asked for when it is shown."""

from importlib.resources import files

from markupsafe import Markup

from rovercheck.checker.render import page as pages
from rovercheck.checker.render.page import Part
from rovercheck.checker.render.statechart_svg import STYLE


def page() -> str:
    """The page, which knows nothing of a model yet."""
    body = Markup(own("explorer.html"))
    return pages.page(
        "rovercheck", [Part(body, (STYLE, own("explorer.css")), (own("explorer.js"),))], connects=True
    )


def own(name: str) -> str:
    """The text of a file beside this one: markup, a style sheet or a script."""
    return files(__name__).joinpath(name).read_text(encoding="utf-8")
