"""Compiled code kept on disk: sealed with a secret of the user's, checked when it is read, never needed.

What is read is native code that will be run, and what a verdict rests on.  So an entry is believed only
if this user's rovercheck wrote it, under that name: whoever can write to the folder but does not know the
secret can make entries go missing, nothing else.  The same holds for a folder from another machine.
"""

from rovercheck.checker.cache.entries import ENDING, MOST_BYTES, opened, read, remove, sealed, write
from rovercheck.checker.cache.listeners import CachedCodeUse, CacheRefused, listening
from rovercheck.checker.cache.places import VARIABLE, UnsafePlace, chosen, usable
from rovercheck.checker.cache.secret_file import SECRET, secret, secret_place

__all__ = [
    "ENDING",
    "MOST_BYTES",
    "SECRET",
    "VARIABLE",
    "CacheRefused",
    "CachedCodeUse",
    "UnsafePlace",
    "chosen",
    "listening",
    "opened",
    "read",
    "remove",
    "sealed",
    "secret",
    "secret_place",
    "usable",
    "write",
]
