"""What is drawn and has no meaning when it is executed."""


class DrawnFault(Exception):
    """Something that a step does and that has no meaning: what, and where."""


BY_ZERO = "divides by 0"
"""What is said of a quotient of real numbers that has no value here, where MATLAB goes on with ``Inf``."""

__all__ = ["BY_ZERO", "DrawnFault"]
