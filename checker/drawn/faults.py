"""What is drawn and has no meaning when it is executed."""


class DrawnFault(Exception):
    """Something that a step does and that has no meaning: what, and where."""


__all__ = ["DrawnFault"]
