"""What a promise is: a sentence of the document, the bound that it requires, and the bound that is proved."""

from collections.abc import Mapping
from dataclasses import dataclass

from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.expr import TRUE, Expr

ORDER = ("STOP", "CRITICAL", "RELAY", "LIMITS", "LOSS", "RESUME", "SHOWN")
"""The ids of the promises as the page shows them: the user's own three first."""


@dataclass(frozen=True)
class Chain:
    """A proof across the link: a property of a chain of tasks, whose contracts are properties of the boards.

    ``across`` is that property, a ``HoldsAfter``.  ``by`` names for each contract of its system the property
    that proves it, ``stands`` says of the variables of that system what they are on the boards.  ``first``, a
    property that demands something of every step with ``cause``, leads to the premise of ``across``; ``last``
    leads from what arrives to its conclusion.  A chain without contracts needs both.  What the promise takes
    for granted beside that is in ``assuming``.  ``under`` names the repair with which the links hold, if they
    do not hold as specified.
    """

    across: str
    stands: Mapping[str, Expr]
    by: Mapping[str, str]
    first: str = ""
    cause: Expr = TRUE
    last: str = ""
    assuming: Expr = TRUE
    under: str = ""

    @property
    def properties(self) -> tuple[str, ...]:
        """The ids of all of them, in the order of data flow."""
        return tuple(
            dict.fromkeys(id for id in (self.first, self.across, *self.by.values(), self.last) if id)
        )


@dataclass(frozen=True)
class Promise:
    """A sentence of the document, made precise twice.

    ``required`` are the properties as the document has them, ``holds`` the strongest that are true of whole
    boards, each with its bound in words.  ``source`` is a section, table or figure of the document.
    ``chains`` lead from a datum of one board over the link to the other.
    """

    id: str
    title: str
    sentence: str
    source: str
    bound: str
    true_bound: str
    required: tuple[str, ...]
    holds: tuple[Property, ...]
    chains: tuple[Chain, ...] = ()
