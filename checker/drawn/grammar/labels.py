"""Labels of states and of transitions, split into their parts."""

from dataclasses import dataclass, field
from enum import Enum

from rovercheck.checker.drawn.grammar.actions import (
    ActionStatement,
    Evaluated,
)
from rovercheck.checker.drawn.grammar.cursor import Cursor, read_whole
from rovercheck.checker.drawn.grammar.expressions import argument_list, expression
from rovercheck.checker.drawn.grammar.statements import statements
from rovercheck.checker.drawn.grammar.syntax import (
    ActionLanguage,
    Applied,
    Expression,
    Member,
    Name,
)
from rovercheck.checker.drawn.grammar.tokens import Token, TokenKind

__all__ = [
    "LabelSection",
    "SectionKind",
    "StateLabel",
    "TransitionLabel",
    "parse_state_label",
    "parse_transition_label",
]


class SectionKind(Enum):
    """When the actions of a section of a state run; ``bind`` has names instead.

    ``STATE`` are those without a keyword of a Moore chart.
    """

    ENTRY = "entry"
    DURING = "during"
    EXIT = "exit"
    BIND = "bind"
    ON = "on"
    STATE = "state"


_MOST_KINDS = 20
"""So many kinds may stand before a colon, which bounds how far is looked ahead."""
_KINDS = {
    "entry": SectionKind.ENTRY,
    "en": SectionKind.ENTRY,
    "during": SectionKind.DURING,
    "du": SectionKind.DURING,
    "exit": SectionKind.EXIT,
    "ex": SectionKind.EXIT,
    "bind": SectionKind.BIND,
    "on": SectionKind.ON,
}


@dataclass(frozen=True, slots=True)
class LabelSection:
    """``kinds: statements``, with the events of each ``on``.

    ``implied``: it stands before the first keyword, and counts as an entry action.
    """

    kinds: tuple[SectionKind, ...]
    events: tuple[Expression, ...]
    statements: tuple[ActionStatement, ...]
    implied: bool = False
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class StateLabel:
    """The name of a state and its sections, in the order in which they are written."""

    name: str
    sections: tuple[LabelSection, ...] = ()


@dataclass(frozen=True, slots=True)
class TransitionLabel:
    """The events of which one must be there, the guard, and the actions of both kinds; each may be missing.

    An event is a name, ``S.E``, or an operator applied, such as ``after(3, sec)`` or ``enter(S)``.
    """

    events: tuple[Expression, ...] = ()
    guard: Expression | None = None
    condition_actions: tuple[ActionStatement, ...] = ()
    transition_actions: tuple[ActionStatement, ...] = ()


def parse_state_label(text: str, language: ActionLanguage) -> StateLabel:
    """The name and sections of a state's label; raises ``GrammarError``."""
    return read_whole(text, language, _state_label, "the label")


def parse_transition_label(text: str, language: ActionLanguage) -> TransitionLabel:
    """The parts of a transition's label, ``events [guard] {actions} / actions``; raises ``GrammarError``."""
    return read_whole(text, language, _transition_label, "the label")


# --- states -----------------------------------------------------------------------------------------------


def _state_label(cursor: Cursor) -> StateLabel:
    cursor.skip_lines()
    name = cursor.name("the state").text
    if not cursor.take("/") and cursor.token.kind not in (TokenKind.LINE, TokenKind.END):
        cursor.fail(
            f"{cursor.shown()} stands behind the name '{name}': end the line, or write '/', before it"
        )
    sections = []
    at = cursor.behind_lines().at
    implied = statements(cursor, _at_section)
    if implied:
        sections.append(LabelSection((SectionKind.ENTRY,), (), implied, True, at))
    while not cursor.at_end():
        sections.append(_section(cursor))
    return StateLabel(name, tuple(sections))


def _at_section(cursor: Cursor) -> bool:
    """Whether keywords and a colon are next, without reading what stands between them."""
    position = cursor.position
    tokens = cursor.tokens
    for _ in range(_MOST_KINDS):
        word = tokens[position]
        if word.kind is not TokenKind.NAME or word.text not in _KINDS:
            return False
        position += 1
        if word.text == "on":
            while tokens[position].kind is TokenKind.NAME or tokens[position].text in (".", "|", "||"):
                position += 1
            if tokens[position].text == "(":
                position = tokens[position].partner + 1
        if tokens[position].text == ":":
            return True
        if tokens[position].text != ",":
            if tokens[position].kind in (TokenKind.NAME, TokenKind.NUMBER):
                cursor.fail(f"'{word.text}' begins a section only with a colon before its actions", word.at)
            return False
        position += 1
    return False


def _section(cursor: Cursor) -> LabelSection:
    at = cursor.token.at
    kinds: list[SectionKind] = []
    events: list[Expression] = []
    while True:
        kind = _KINDS[cursor.advance().text]
        kinds.append(kind)
        if kind is SectionKind.ON:
            events += _events(cursor)
        if cursor.take(":"):
            break
        cursor.expect(",", "kinds of actions are separated by commas and end with ':'")
    actions = statements(cursor, _at_section)
    if SectionKind.BIND in kinds:
        _check_bound(cursor, actions)
    return LabelSection(tuple(kinds), tuple(events), actions, at=at)


def _check_bound(cursor: Cursor, actions: tuple[ActionStatement, ...]) -> None:
    for action in actions:
        match action:
            case Evaluated(Name() | Member()):
                pass
            case _:
                cursor.fail("only names of data and events can be bound, as in bind: a, b", action.at)


# --- transitions ------------------------------------------------------------------------------------------


def _transition_label(cursor: Cursor) -> TransitionLabel:
    cursor.skip_lines()
    if cursor.at_sign("?"):
        cursor.advance()
        return TransitionLabel()
    events = () if cursor.at_end() or cursor.at_sign("[", "{", "/") else _events(cursor)
    cursor.skip_lines()
    guard = _guard(cursor) if cursor.at_sign("[") else None
    conditional = _braces(cursor)
    following: tuple[ActionStatement, ...] = ()
    if cursor.take("/"):
        cursor.skip_lines()
        following = _braces(cursor) + statements(cursor)
    elif not cursor.at_end():
        _misplaced(cursor)
    return TransitionLabel(events, guard, conditional, following)


def _misplaced(cursor: Cursor) -> None:
    """Say why what is next cannot stand in a label."""
    if cursor.at_sign("["):
        cursor.fail("a transition has one guard, before its actions: join conditions with '&&'")
    cursor.fail(
        f"{cursor.shown()} has no meaning here: a transition is written "
        "EVENT [guard] {condition action} / transition action"
    )


def _guard(cursor: Cursor) -> Expression | None:
    cursor.advance()
    with cursor.inside("brackets"):
        if cursor.take("]"):
            return None
        guard = expression(cursor)
        cursor.expect("]", "a guard is one condition, whose parts are joined with '&&' or '||'")
    return guard


def _braces(cursor: Cursor) -> tuple[ActionStatement, ...]:
    """The actions of all the braces that are next."""
    found: tuple[ActionStatement, ...] = ()
    cursor.skip_lines()
    while cursor.take("{"):
        found += statements(cursor, lambda here: here.at_sign("}"))
        cursor.advance()
        cursor.skip_separators()
    return found


def _events(cursor: Cursor) -> tuple[Expression, ...]:
    """Events separated by ``|``."""
    found = [_event(cursor)]
    while cursor.behind_lines().text in ("|", "||"):
        cursor.skip_lines()
        cursor.advance()
        cursor.skip_lines()
        found.append(_event(cursor))
    return tuple(found)


def _event(cursor: Cursor) -> Expression:
    first: Token = cursor.name("an event")
    found: Expression = Name(first.text, first.at)
    while cursor.take("."):
        found = Member(found, cursor.name("an event").text, at=first.at)
    if cursor.at_sign("("):
        found = Applied(found, argument_list(cursor), first.at)
    return found
