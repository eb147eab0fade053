"""The reference interpreter: runs a system as drawn, state by state, sharing no code with lowering."""

from rovercheck.spec_model.lang.fired_transition import FiredTransition
from rovercheck.spec_model.lang.interpret.whole import Interpreter

__all__ = ["FiredTransition", "Interpreter"]
