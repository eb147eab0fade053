"""Types as they are written, in the plain names that both readings know."""

import re

_FIXED = re.compile(
    r"fixdt\(\s*(?P<signed>[01]|true|false)\s*,\s*(?P<bits>8|16|32|64)\s*,\s*"
    r"(?:-?0(?:\.0*)?|(?:1(?:\.0*)?|2\^0)\s*,\s*-?0(?:\.0*)?)\s*\)"
)
_NAMED = re.compile(r"fixdt\(\s*['\"](\w+)['\"]\s*\)")
_SHORT = re.compile(r"([su])fix(8|16|32|64)")


def plain_type(written: str) -> str:
    """The type of integers that a fixed-point type without a fraction is; any other as it is written.

    >>> plain_type("fixdt(0, 8, 0)"), plain_type("sfix16"), plain_type("fixdt(1,16,4)")
    ('uint8', 'int16', 'fixdt(1,16,4)')
    """
    text = written.strip()
    if found := _NAMED.fullmatch(text):
        text = found[1]
    if found := _FIXED.fullmatch(text):
        return f"{'' if found['signed'] in ('1', 'true') else 'u'}int{found['bits']}"
    if found := _SHORT.fullmatch(text):
        return f"{'' if found[1] == 's' else 'u'}int{found[2]}"
    return text


__all__ = ["plain_type"]
