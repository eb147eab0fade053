"""The grammar of labels: a text becomes a tree, or an error that says what was expected where."""

import re
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path
from typing import Literal

from lark import Lark, Token, Tree
from lark.exceptions import UnexpectedCharacters, UnexpectedInput, UnexpectedToken

from rovercheck.spec_model.lang.stateflow.blocks import Blocks
from rovercheck.spec_model.lang.stateflow.message import Extent, LabelError

Node = Tree[Token]
Start = Literal["transition", "state", "actions", "formula"]

LONGEST = 20_000
"""Signs of a label at most."""
DEEPEST = 100
"""Brackets inside each other at most."""

_HIDDEN = re.compile(r"[^\S \t\r\n]|[\x00-\x08\x0b-\x1f\x7f-\x9f\u200b-\u200f\u202a-\u202e\u2060-\u206f]"
                     "|[\ue000-\uf8ff\ud800-\udfff\ufeff]")  # fmt: skip
"""What no screen shows, or what makes a text look other than it is."""
_SECTIONS = re.compile(
    r"(?:^|(?<=[\n;]))[ \t]*(?P<words>(?:entry|en|during|du|exit|ex|bind)"
    r"(?:[ \t]*,[ \t]*(?:entry|en|during|du|exit|ex|bind))*)[ \t]*:(?!=)"
)
_ON = re.compile(r"(?:^|(?<=[\n;]))[ \t]*(?P<words>on)[ \t]+[^\n=:;]*:(?!=)")
_WORD = re.compile(r"\w+")

WORDS: Mapping[str, str] = {
    "LSQB": "`[`", "RSQB": "`]`", "LPAR": "`(`", "RPAR": "`)`", "LBRACE": "`{`", "RBRACE": "`}`",
    "SLASH": "`/`", "DIVIDED": "`/`", "COMMA": "`,`", "COLON": "`:`", "QMARK": "`?`", "SEMICOLON": "`;`",
    "ASSIGN": "`=`", "ELSE": "`else`", "ELSEIF": "`elseif`", "SECTION": "`entry:`, `during:` or `exit:`",
    "$END": "the end of the label",
}  # fmt: skip
_VALUES = {"NUMBER", "NAME", "STRANGE", "QUANTITY", "LPAR"}
_OPERATORS = {"__ANON_0", "__ANON_1", "COMPARISON", "TIMES", "DIVIDED", "ADDED", "VBAR", "AMPERSAND", "QMARK"}
_HINTS = {
    "^": "a power has no meaning here: write a product",
    "<<": "shifts have no meaning here: multiply by a power of 2",
    ">>": "shifts have no meaning here: write `div` and a power of 2",
    "'": "texts have no meaning here: write the member of an enumeration without quotes",
    '"': "texts have no meaning here: write the member of an enumeration without quotes",
    "→": "this is how traces join the labels of several transitions: write each on its own",
    "≤": "write `<=`", "≥": "write `>=`", "≠": "write `!=`", "∧": "write `&&`", "∨": "write `||`",
    "¬": "write `!`", "−": "write `-`", "×": "write `*`", "·": "write `*`", "÷": "write `/`",
}  # fmt: skip


REFUSED = {
    "before": "write `!after(...)`",
    "temporalCount": "compare with after(...) or duration(...)",
    "elapsed": "compare with after(...) or duration(...)",
    "count": "write `duration(c) >= n ticks`",
    "at": "count in a datum", "every": "count in a datum",
    "falling": "write `rising(!x)` of a condition",
    "crossing": "write `rising(x)` or `rising(!x)` of a condition",
    "hasChanged": "keep the value before in a datum", "hasChangedTo": "keep the value before in a datum",
    "hasChangedFrom": "keep the value before in a datum",
    "pow": "write a product", "sqrt": "compare squares", "floor": "use quotient",
}  # fmt: skip
"""Functions of Stateflow that have no meaning here, and what to write."""


@cache
def _parser(start: Start, ended: bool) -> Lark:
    grammar = Path(__file__).with_name("labels.lark").read_text(encoding="utf-8")
    return Lark(
        grammar, parser="lalr", lexer="contextual", start=start, propagate_positions=True,
        maybe_placeholders=False, postlex=Blocks(ended),
    )  # fmt: skip


def parsed(text: str, start: Start, masked: str | None = None) -> Node:
    """The tree of a text.  ``masked`` is as long, with what stands for a name in place of the name.

    Raises ``LabelError`` where the text does not follow the grammar.
    """
    check_text(text)
    masked = text if masked is None else masked
    if start == "state":
        masked = _with_sections(masked)
    try:
        return _parser(start, re.search(r"\bend\b", masked) is not None).parse(masked)
    except UnexpectedInput as error:
        raise _unexpected(error, text) from None


def check_text(text: str) -> None:
    """Raises ``LabelError`` for signs that nobody sees, and for more signs or brackets than can be read."""
    if hidden := _HIDDEN.search(text):
        code = f"U+{ord(hidden.group()):04X}"
        raise LabelError(f"the sign {code} cannot be shown; leave it out.", Extent(*hidden.span()))
    if len(text) > LONGEST:
        raise LabelError(
            f"a label of {len(text):,} signs cannot be read; write {LONGEST:,} at most and name parts.",
            Extent(LONGEST, LONGEST + 1),
        )
    depth = 0
    for at, sign in enumerate(text):
        depth += (sign in "([{") - (sign in ")]}")
        if depth > DEEPEST:
            raise LabelError(
                f"brackets are nested more than {DEEPEST} deep; name a part with named().", Extent(at, at + 1)
            )


def span(node: Node | Token) -> Extent:
    """Where a part of the tree stands in the text."""
    if isinstance(node, Token):
        return Extent(node.start_pos or 0, node.end_pos or 0)
    if node.meta.empty:
        return Extent(0, 0)
    return Extent(node.meta.start_pos, node.meta.end_pos)


def _with_sections(text: str) -> str:
    """The text with a sign of its own where a section of a state begins."""
    signs = list(text)
    for pattern, sign in ((_SECTIONS, "\ue002"), (_ON, "\ue003")):
        for found in pattern.finditer(text):
            start = found.start("words")
            for word in _WORD.finditer(found.group("words")):
                signs[start + word.start()] = sign
    return "".join(signs)


def _unexpected(error: UnexpectedInput, text: str) -> LabelError:
    """What was found and what was expected there, in words."""
    if isinstance(error, UnexpectedCharacters):
        at = error.pos_in_stream or 0
        found, expected = Extent(at, at + 1), set(error.allowed or ())
    else:
        assert isinstance(error, UnexpectedToken)
        token, expected = error.token, set(error.accepts or error.expected)
        at = len(text.rstrip()) if token.type == "$END" else token.start_pos or 0
        found = Extent(at, at if token.type == "$END" else token.end_pos or at)
    shown = text[found.start : found.end].strip()
    hint = _hint(text, found, expected)
    unexpected = f"`{shown}` has no meaning here" if shown else "the label ends too early"
    return LabelError(f"{unexpected}; {hint or f'expected {_listed(expected)}'}.", found)


_SIGNS = {"and": "&&", "or": "||", "not": "!"}


def _hint(text: str, found: Extent, expected: Iterable[str]) -> str | None:
    """What is most often meant."""
    rest = text[found.start :]
    for written, said in _HINTS.items():
        if rest.startswith(written):
            return said
    if word := re.match(r"(and|or|not)\b", rest):
        return f"write `{_SIGNS[word[1]]}` for `{word[1]}`"
    before = text[: found.start]
    if rest.startswith("=") and "ASSIGN" not in expected and before.count("[") > before.count("]"):
        return "`=` assigns: compare with `==`"
    if rest.startswith("=") and re.search(r"[\w)\]][ \t]+[\w.]+[ \t]*$", before):
        return "write `;` between two actions"
    opened = "LSQB" in expected and "LBRACE" in expected and "[" not in before
    if opened and not re.search(r"[\[{/]", before) and re.match(r"[<>=!~&|+*-]", rest):
        return "a condition stands in brackets: `[level > 80]`; an action in braces or after `/`"
    if re.match(r"(for|while|switch|do|function|return|break)\b", before[before.rfind("\n") + 1 :].lstrip()):
        return "loops and jumps have no meaning here: write `if`, or a chart"
    if re.match(r"[\w(]", rest) and re.search(r"[\w)\]][ \t]*$", before) and {"RSQB", "RPAR"} & set(expected):
        return "expected an operator, such as `&&`, before it"
    if re.search(r"\bif\b[^{]*$", before) and "LBRACE" in expected:
        return "the actions of an `if` stand in braces: `if a {x = 1} else {x = 2}`"
    return None


def _listed(expected: Iterable[str]) -> str:
    """What would have been read, in words."""
    kinds, words = set(expected), list[str]()
    if kinds >= {"NUMBER", "LPAR"}:
        words.append("a value, such as a signal or a number")
        kinds -= _VALUES | {"NOT", "ADDED", "STEP"}
    elif "NAME" in kinds:
        words.append("a name")
    if len(kinds & _OPERATORS) > 1:
        words.append(
            "an operator, such as `&&` or `>`" if "COMPARISON" in kinds else "an operator, such as `&&`"
        )
        kinds -= _OPERATORS
    words += sorted({WORDS[kind] for kind in kinds if kind in WORDS})
    if not words:
        return "something else"
    return " or ".join(filter(None, (", ".join(words[:-1]), words[-1])))
