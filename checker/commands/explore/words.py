"""The words behind a command of ``rovercheck explore``: numbers of ticks, names, assignments."""

import shlex

from rovercheck.checker.explore.by_hand.value_syntax import RefusedInput


def count(rest: str, default: int) -> int:
    if not rest:
        return default
    if not rest.isdecimal() or int(rest) < 1:
        raise RefusedInput(f"{rest!r} is no number of ticks; write a whole number from 1.")
    return int(rest)


def split(rest: str) -> list[str]:
    try:
        return shlex.split(rest)
    except ValueError:
        raise RefusedInput(f"A quotation mark is not closed in {rest!r}.") from None


def pairs(rest: str) -> list[tuple[str, str]]:
    pairs = [word.partition("=") for word in split(rest)]
    if not pairs:
        raise RefusedInput("Write NAME=VALUE, without blanks around the equals sign.")
    for name, equals, written in pairs:
        if not (name and equals and written):
            raise RefusedInput(
                f"{name + equals + written!r} is no NAME=VALUE; write no blanks around the equals sign."
            )
    return [(name, written) for name, _, written in pairs]
