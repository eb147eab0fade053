"""Wheels: a wheel with feedback is OK, whatever the motion coherence says of the rover as a whole."""

from rovercheck.spec_model.repairs import Repair
from rovercheck.spec_model.signals.board1 import WHEELS

by_feedback = Repair(
    name="wheel-by-feedback",
    text="A wheel with feedback and inconsistent motion, which no row of Table 2 covers, is OK (S27).",
    fixes=tuple(f"PB1-30c-{wheel}" for wheel in WHEELS),
    interpretations={"S27": "OK"},
)
