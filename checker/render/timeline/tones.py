"""What a value means to the eye, told from the words in its name: fine, degraded, critical, or nothing."""

import re

from rovercheck.checker.render.lanes import Tone

WORDS = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")
CRITICAL = {"critical", "crit", "estop", "emergency", "fail", "failed", "failure", "fault", "lost", "error"}
DEGRADED = {"degraded", "deg", "degr", "stop", "warn", "warning", "late", "stale"}
FINE = {"ok", "okay", "safe", "normal", "nominal", "good", "healthy"}
NOTHING = {"-", "false", "no", "none", "off", "nobody", "nothing"}


def tone(value: str) -> Tone:
    """The tone of a member of an enumeration, a state or a truth value; the worst word in it counts."""
    if value.lower() in NOTHING:
        return Tone.IDLE
    if value == "true":
        return Tone.ACTION
    words = {word.lower() for word in WORDS.findall(value)}
    for told, meaning in ((CRITICAL, Tone.CRITICAL), (DEGRADED, Tone.DEGRADED), (FINE, Tone.OK)):
        if words & told:
            return meaning
    return Tone.FIRST
