"""Old words of the command line, which work as before; each use names the new word on standard error."""

from collections.abc import Mapping, Sequence

ALIASES: Mapping[str, str] = {
    "conform": "check-log",
    "crosscheck": "compare",
    "testgen": "generate-tests",
    "generate-tests --cover arrows": "generate-tests --cover transitions",
    "list readings": "list interpretations",
    "trace --arrow": "trace --transition",
    "trace --by arrows": "trace --by transitions",
    "check --reading": "check --interpret",
    "check-log --reading": "check-log --interpret",
    "compare --reading": "compare --interpret",
    "explore --reading": "explore --interpret",
    "export --reading": "export --interpret",
    "graph --reading": "graph --interpret",
    "report --reading": "report --interpret",
    "trace --reading": "trace --interpret",
}
"""An old verb, option or value -> what is written now; of an option the verb as it is called now."""


def current(words: Sequence[str]) -> tuple[list[str], str]:
    """A verb and its arguments in the words of now, and what to say of the old ones among them, if any.

    >>> current(["trace", "--arrow", "Relay: A -> B"])
    (['trace', '--transition', 'Relay: A -> B'], 'trace --arrow is now trace --transition.')
    """
    verb = ALIASES.get(words[0], words[0])
    used = [words[0]] if verb != words[0] else []
    now = [verb]
    for word in words[1:]:
        option, sign, value = word.partition("=")
        for old in (f"{verb} {option}", f"{verb} {option} {value}", f"{verb} {now[-1]} {word}"):
            if "--" not in now and (new := ALIASES.get(old)) is not None:
                used.append(old)
                _, option, *values = new.split()
                word = (f"{option}={values[0]}" if sign else values[0]) if values else option + sign + value
        now.append(word)
    return now, "; ".join(f"{old} is now {ALIASES[old]}" for old in dict.fromkeys(used)) + "." * bool(used)
