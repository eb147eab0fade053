"""What a promise is: a sentence of the document, the bound that it requires, and the bound that is proved."""

from dataclasses import dataclass

from properties.forms import Property

ORDER = ("STOP", "CRITICAL", "RELAY", "LIMITS", "LOSS", "SHOWN")
"""The ids of the promises as the page shows them: the user's own three first."""


@dataclass(frozen=True)
class Promise:
    """A sentence of the document, made precise twice.

    ``required`` are the properties as the document has them, ``holds`` the strongest that are true of whole
    boards, each with its bound in words.  ``source`` is a section, table or figure of the document.
    ``chains`` lead from a datum of one board over the link to the other: ids of properties in order, of which
    each begins where the one before ends.
    """

    id: str
    title: str
    sentence: str
    source: str
    bound: str
    true_bound: str
    required: tuple[str, ...]
    holds: tuple[Property, ...]
    chains: tuple[tuple[str, ...], ...] = ()
