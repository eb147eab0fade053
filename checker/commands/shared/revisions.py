"""Earlier revisions of what is checked, as git has them: their files, in a folder for as long as it takes."""

import subprocess
import tarfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.commands.shared.text_wrap import whole


def repository(path: Path) -> Path:
    """The folder of the git repository that a file or folder is in.  Raises ``UsageError``."""
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
