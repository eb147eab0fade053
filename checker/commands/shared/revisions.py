"""Earlier revisions of what is checked, as git has them: their files, in a folder for as long as it takes."""

import os
import subprocess
import sys
import tarfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.commands.shared.text_wrap import whole

_OWN = Path(__file__).parents[3]


@dataclass(frozen=True)
class RevisionTree:
    """Files of one revision: where programs about them run, and the path of the ``model`` among them.

    The rover's own files are run from their own folder, and so by the rovercheck of that revision.
    """

    folder: Path
    model: str = ""

    def run(self, module: str, *words: str, given: str = "") -> subprocess.CompletedProcess[str]:
        """What a module of rovercheck does as a program; its messages go where ours go."""
        here = {name: value for name, value in os.environ.items() if name != "PYTHONSAFEPATH"}
        return subprocess.run(
            [sys.executable, "-m", module, *words], cwd=self.folder, env=here, input=given,
            stdout=subprocess.PIPE, encoding="utf-8", errors="replace", check=False,
        )  # fmt: skip


def tree_of(model: Path | None, root: Path, folder: Path) -> RevisionTree | None:
    """The rover, or a model of a user's own, among the files in a folder; None where these have it not.

    ``root`` is the repository that the model is in.
    """
    if model is None:
        return RevisionTree(folder) if (folder / "rovercheck").is_dir() else None
    path = folder / model.absolute().resolve().relative_to(root.resolve())
    return RevisionTree(Path.cwd(), str(path)) if path.exists() else None


def repository(model: Path | None) -> Path:
    """The folder of the git repository of a model, None: of the rover.  Raises ``UsageError``."""
    path = _OWN if model is None else model.absolute()
    folder = path if path.is_dir() else path.parent
    found = _git(folder, "rev-parse", "--show-toplevel")
    if found is None:
        raise UsageError(f"{whole(folder)} is in no git repository: there is no earlier revision of it.")
    return Path(found)


def commit(root: Path, revision: str) -> str:
    """The short name of the commit that a revision means.  Raises ``UsageError``."""
    found = _git(root, "rev-parse", "--verify", "--quiet", "--short=10", f"{revision}^{{commit}}")
    if found is None:
        raise UsageError(
            f"git knows no revision {revision!r} of {whole(root)}; write a branch, a tag, HEAD~1 or a commit."
        )
    return found


def commit_of(path: Path) -> str:
    """The commit of a file or folder that git keeps, and whether it has changed since; empty if none does."""
    folder = path if path.is_dir() else path.parent
    try:
        kept = _git(folder, "ls-files", "--error-unmatch", "--", str(path.absolute()))
        name = None if kept is None else _git(folder, "rev-parse", "--short=10", "HEAD")
        changed = _git(folder, "status", "--porcelain", "--", str(path.absolute())) if name else None
    except UsageError:
        return ""
    return f"{name}, with changes that are not committed" if name and changed else name or ""


@contextmanager
def exported(root: Path, revision: str) -> Iterator[Path]:
    """The files of a revision, in a folder that is removed at the end.  Raises ``UsageError``."""
    name = commit(root, revision)
    with TemporaryDirectory(prefix="rovercheck-") as folder:
        with subprocess.Popen(
            ["git", "-C", str(root), "archive", "--format=tar", name], stdout=subprocess.PIPE
        ) as process:
            assert process.stdout is not None
            try:
                with tarfile.open(fileobj=process.stdout, mode="r|") as archive:
                    archive.extractall(folder, filter="data")
            except tarfile.TarError as error:
                raise UsageError(f"The files of {revision} cannot be read: {error}.") from error
        yield Path(folder)


def _git(folder: Path, *words: str) -> str | None:
    """What git says; None if it refuses.  Raises ``UsageError`` where there is no git."""
    try:
        done = subprocess.run(
            ["git", "-C", str(folder), *words], capture_output=True, text=True, check=False, errors="replace"
        )
    except FileNotFoundError as error:
        raise UsageError("Earlier revisions are read with git, which is not installed here.") from error
    return done.stdout.strip() if done.returncode == 0 else None
