"""Lowering: from charts executed in order to a transition system with explicit timers."""

from rovercheck.spec_model.lang.lower.whole import ByIdentity, lower

__all__ = ["ByIdentity", "lower"]
