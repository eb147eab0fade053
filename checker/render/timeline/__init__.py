"""A run over time as lanes: what changed when, limits and timers, and the tick in which a part is false."""

from rovercheck.checker.render.timeline.build import timeline
from rovercheck.checker.render.timeline.fragment import part
from rovercheck.checker.render.timeline.picture import picture
from rovercheck.checker.render.timeline.story_table import story_part

__all__ = ["part", "picture", "story_part", "timeline"]
