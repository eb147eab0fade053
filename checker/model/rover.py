"""The rover as a model: the charts of this repository under chosen interpretations."""

from collections.abc import Mapping
from functools import cache

from rovercheck.checker.model import Model
from rovercheck.properties.catalogue import baseline, under
from rovercheck.properties.hazards import hazards
from rovercheck.properties.requirements import PROMISES, requirements
from rovercheck.spec_model.rover import AS_READ, systems


def rover(choices: Mapping[str, str] = AS_READ) -> Model:
    """The rover; an interpretation not mentioned takes its default.

    Raises ``ModelError`` for an unknown interpretation or choice.
    """
    return _rover(tuple(sorted(choices.items())))


@cache
def _rover(chosen: tuple[tuple[str, str], ...]) -> Model:
    choices = dict(chosen)
    return Model(
        systems(choices), under(choices), baseline(), requirements(), first=PROMISES, hazards=hazards()
    )
