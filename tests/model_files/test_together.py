"""All that is wrong with a model is told at once: what concerns different things, in all its files."""

from pathlib import Path

import pytest

from rovercheck.checker.model.load import load
from rovercheck.spec_model.lang.errors import ModelError
from tests.model_files.test_kinds import FIRST, HEAD

SIX = """
A = always("A", "t", that=5, covers=["R"], on="Oven")
B = always("B", "t", that=flag("nope"), covers=["R"], on="Oven")
C = always("C", "t", that=on, covers=["R"], on="Ovn")
D = always("D", "", that=on, covers=["R"], on="Oven")
E = always("D", "t", that=on, covers=["R"], on="Oven")
F = Chart("F", [State("A")], default="B")
G = always("G", "t", that=on, covers=["R"], on="F")
"""
COVERS = """
REQUIREMENTS = {"R1": "t", "R2": 5, "R3": {"texxt": "t"}}
A = always("A", "t", that=on, covers=["X", "R1"], on="Oven")
B = always("B", "t", that=on, covers=["Y", "Z"], on="Oven")
"""
BACK = """
A = recoverable("A", "t", to=on, by=on, within=sec, covers=["R"], on="Oven")
B = recoverable("B", "t", to=on, by=on, within=sec, covers=["R"], on="Oven")
"""
BASELINE = """
[NONE]
verdict = "violated"
because = "x"
[A]
verdict = "proved"
[B]
verdict = "violated"
because = "x"
depht = 3
"""


def refused(folder: Path, **files: str) -> list[str]:
    for name, text in files.items():
        (folder / f"{name}.py").write_text(text, encoding="utf-8")
    with pytest.raises(ModelError) as error:
        load(folder)
    return str(error.value).splitlines()


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def places(told: list[str]) -> list[str]:
    return [":".join(line.split(":")[:2]) for line in told]


def test_things_that_do_not_depend_on_each_other(here: Path) -> None:
    """Of G nothing is told: its system has no meaning yet."""
    assert places(refused(here, m=HEAD + SIX)) == [f"m.py:{FIRST + line}" for line in (6, 1, 2, 3, 4, 5)]


def test_files_that_run_beside_one_that_does_not(here: Path) -> None:
    """What is named in b may be in a or c: that it is nowhere is not told."""
    text = HEAD + 'P = always("P", "t", that=on, covers=["R"], on="Other")\n'
    text += 'C = Chart("C", [State("A")], default="B")\nQ = always("Q", "t", that=5, covers=["R"], on=C)'
    told = refused(here, a="x = 1/0\n", b=text, c="x = (\n")
    assert places(told) == ["a.py:1", "c.py:1", f"b.py:{FIRST + 1}", f"b.py:{FIRST + 2}"]


def test_every_requirement_that_is_none(here: Path) -> None:
    told = refused(here, m=HEAD + COVERS)
    assert places(told) == [f"m.py:{FIRST + line}" for line in (1, 1, 2, 3, 3)]
    assert [line.split("'")[1] for line in told[2:]] == ["X", "Y", "Z"]


def test_every_way_back_that_need_not_be_open(here: Path) -> None:
    assert places(refused(here, m=HEAD + BACK)) == [f"m.py:{FIRST + 1}", f"m.py:{FIRST + 2}"]


def test_every_entry_of_the_tables(here: Path) -> None:
    (here / "baseline.toml").write_text(BASELINE)
    (here / "requirements.toml").write_text('[R1]\nid = "x"\n[R2]\nsourc = "x"\n')
    told = refused(here, m=HEAD + BACK.replace("by=on", "by=hot").replace('"R"', '"R1"'))
    assert [line.partition(".")[0] for line in told] == ["baseline"] * 3 + ["requirements"] * 2


@pytest.mark.parametrize("name", ["baseline.toml", "requirements.toml"])
def test_a_table_that_is_a_folder(name: str, here: Path) -> None:
    (here / name).mkdir()
    assert refused(here, m=HEAD) == [f"{name} cannot be read: Is a directory."]


def test_a_folder_with_the_name_of_a_file(here: Path) -> None:
    (here / "x.py").mkdir()
    (here / "m.py").write_text(HEAD)
    assert list(load(here).systems) == ["Oven"]


def test_files_that_import_each_other_are_named_as_the_user_names_them(here: Path) -> None:
    told = refused(here, a="from .b import x\n", b="from .a import x\n")
    assert "module 'a'" in told[0]
    assert not any("rovercheck" in line for line in told)
