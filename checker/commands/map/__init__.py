"""The verb ``map``: the mapping file of a firmware."""

from rovercheck.checker.commands.map.verbs import map_

__all__ = ["map_"]
