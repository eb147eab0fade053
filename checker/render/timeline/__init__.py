"""A run over time as lanes: what changed when, limits and timers, and the tick in which a part is false."""

from rovercheck.checker.render.timeline.build import forced_by, timeline
from rovercheck.checker.render.timeline.fragment import part
from rovercheck.checker.render.timeline.picture import picture
from rovercheck.checker.render.timeline.told import told

__all__ = ["forced_by", "part", "picture", "timeline", "told"]
