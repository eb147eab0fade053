"""A run as messages between boards or charts, in the manner of a UML sequence diagram: time flows down."""

from rovercheck.checker.render.sequence.picture import picture
from rovercheck.checker.render.sequence.steps import message_sequence

__all__ = ["message_sequence", "picture"]
