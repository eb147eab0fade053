"""What a promise is: a sentence of the document, the bound that it requires, and the bound that is proved."""

from dataclasses import dataclass

from properties.forms import Property


@dataclass(frozen=True)
class Promise:
    """A sentence of the document, made precise twice.

    ``required`` are the properties as the document has them, ``holds`` the strongest that are true of whole
    boards, each with its bound in words.  ``source`` is a section, table or figure of the document.
    """

    id: str
    title: str
    sentence: str
    source: str
    bound: str
    true_bound: str
    required: tuple[str, ...]
    holds: tuple[Property, ...]
