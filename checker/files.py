"""Files that are never half-written: whoever reads one sees the old content or the new."""

import os
import tempfile
from pathlib import Path


def replaced(target: Path, data: bytes) -> None:
    """Write a file in one step.  Raises ``OSError``; the old file, if there is one, then stays as it was.

    A device or a pipe (``/dev/stdout``) is written to, never put out of the way.
    """
    if target.exists() and not target.is_file() and not target.is_dir():
        target.write_bytes(data)
        return
    handle, name = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        os.chmod(name, 0o644)
        os.replace(name, target)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise
