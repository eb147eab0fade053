"""What docs/inside.md says of folders and figures is so, and nothing is left out."""

import re
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "inside.md").read_text(encoding="utf-8")
CITED = re.compile(r"Figs? (\d+)(?:-(\d+)|((?:, \d+)+))?")
CHARTS = ("board1", "board2", "manoeuvres", "composition")


def figures(text: str) -> Iterator[int]:
    """The figures that a text cites: ``Fig 16``, ``Figs 12, 24, 28`` and ``Figs 24-27``."""
    for first, last, more in CITED.findall(text):
        yield from range(int(first), int(last or first) + 1)
        yield from map(int, re.findall(r"\d+", more))


def table(head: str) -> Iterator[list[str]]:
    """The cells of each row of the table whose first row begins so."""
    lines = PAGE.partition(f"| {head} |")[2].splitlines()[2:]
    for line in lines:
        if not line.startswith("|"):
            return
        yield [cell.strip() for cell in line.strip("|").split("|")]


def test_every_folder_of_the_checker_has_a_row() -> None:
    told = [row[0].strip("`/") for row in table("Folder of `checker/`")]
    there = {p.name for p in (ROOT / "checker").iterdir() if p.is_dir() and p.name != "__pycache__"}
    assert sorted(told) == sorted(there)


def test_a_file_shows_the_figures_that_the_page_says_it_shows() -> None:
    rows = list(table("Figure"))
    assert rows
    for cell, _, where in rows:
        files = [ROOT / name for name in re.findall(r"`(spec_model/[^`]*)`", where)]
        cited = {n for file in files for n in figures(file.read_text(encoding="utf-8"))}
        assert files and {int(n) for n in cell.split(",")} <= cited, cell


def test_every_figure_that_a_chart_cites_is_on_the_page() -> None:
    told = {int(n) for row in table("Figure") for n in row[0].split(",")}
    files = [p for folder in CHARTS for p in (ROOT / "spec_model" / folder).glob("*.py")]
    assert {n for p in files for n in figures(p.read_text(encoding="utf-8"))} <= told


def test_every_path_on_the_page_is_there() -> None:
    named = re.findall(r"`((?:checker|spec_model|properties|supervisor|rovercheck)/[\w/.]*)`", PAGE)
    assert len(named) > 40
    assert [name for name in named if not (ROOT / name).exists() and not (ROOT / f"{name}.py").exists()] == []
