"""The pictures of the documents, drawn from the charts."""

from pathlib import Path
from tempfile import TemporaryDirectory

from docs.reference.listings import applied, listings
from rovercheck.checker.model.load import load
from rovercheck.checker.render import statechart_svg

TUTORIAL = Path(__file__).parents[1] / "tutorial.md"
ICON = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24">
<path d="M4 13l5 5L20 6" fill="none" stroke="#4051b5" stroke-width="4"/></svg>
"""


def of_tutorial(changes: int = 0) -> str:
    """The chart that the tutorial writes, as SVG, after so many of its changes."""
    blocks = [block for block in listings(TUTORIAL) if block.title == "pump.py"]
    source = next(block.text for block in blocks if block.language == "python")
    for block in [block for block in blocks if block.language == "diff"][:changes]:
        source = applied(source, block.text)
    with TemporaryDirectory() as folder:
        file = Path(folder, "pump.py")
        file.write_text(source, encoding="utf-8")
        return statechart_svg.render(load(file).charts["Pump"])
