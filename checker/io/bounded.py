"""Files that are read whole, up to a size."""

from pathlib import Path

from rovercheck.spec_model.lang.errors import ModelError


def bounded_bytes(path: Path, most: int, advice: str) -> bytes:
    """What is in a file of no more than ``most`` bytes.

    Raises ``ModelError`` for a larger one, and for one that cannot be read, with ``advice``.
    """
    try:
        with path.open("rb") as file:
            data = file.read(most + 1)
    except OSError as error:
        raise ModelError(f"{path}: {error.strerror}. {advice}") from error
    if len(data) > most:
        raise ModelError(f"{path}: more than {most >> 20} MiB are not read.")
    return data


__all__ = ["bounded_bytes"]
