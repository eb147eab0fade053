"""The lift: in each step the leaves move, then the door decides, then the drive."""

from door import door, leaves
from drive import drive

from rovercheck import in_order

lift = in_order("lift", leaves, door, drive, text="The door of a lift and its drive, with free inputs.")
