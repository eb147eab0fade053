"""The published schemas, for whoever validates a document."""

import json
from pathlib import Path
from typing import Any

from rovercheck import checker

FOLDER = Path(checker.__file__).parent / "schemas"


def published(name: str) -> Any:
    """A schema by its name and version: ``published("check-1")``."""
    return json.loads((FOLDER / f"{name}.json").read_text("utf-8"))
