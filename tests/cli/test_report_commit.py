"""The commit that the cover of a review page names."""

import subprocess
from pathlib import Path

from rovercheck.checker.commands.shared.revisions import commit_of


def git(folder: Path, *words: str) -> None:
    name = "-c", "user.name=A", "-c", "user.email=a@example.org"
    subprocess.run(["git", "-C", str(folder), *name, *words], check=True, capture_output=True)


def test_the_commit_of_a_model_is_named_and_that_it_has_changed(tmp_path: Path) -> None:
    model, other = tmp_path / "door.py", tmp_path / "other.py"
    for file in (model, other):
        file.write_text("x = 1\n", encoding="utf-8")
    assert commit_of(model) == ""
    git(tmp_path, "init", "-q")
    git(tmp_path, "add", "door.py")
    git(tmp_path, "commit", "-q", "-m", "A door.")
    name = commit_of(model)
    assert len(name) >= 10 and set(name) <= set("0123456789abcdef")
    assert commit_of(other) == "", "a file that git does not keep has no commit"
    model.write_text("x = 2\n", encoding="utf-8")
    assert commit_of(model) == f"{name}, with changes that are not committed"
