"""What the live page and ``rovercheck serve`` say to each other, as JSON: no published format."""

from typing import Literal

from typing_extensions import TypedDict


class ModelRow(TypedDict):
    """The model as it was last read: ``version`` counts how often, ``problem`` says why not again."""

    name: str
    version: int
    problem: str
    watched: bool
    """Whether it is read again when it is saved."""


class SystemChoice(TypedDict):
    """A system, or a chart alone, that can be explored."""

    name: str
    text: str
    charts: list[str]


class VerdictRow(TypedDict):
    """A property with the verdict on record, and the one that was decided since the page was opened.

    ``decided`` is empty for one that was not decided; ``evidence`` says what the decided verdict rests on.
    """

    id: str
    text: str
    system: str
    charts: list[str]
    """Those that it speaks of."""
    expected: str
    because: str
    decided: str
    evidence: str
    has_run: bool


class OpenSession(TypedDict):
    """A session that is open, as after a page was closed."""

    id: str
    system: str
    tick: int


class OverviewDocument(TypedDict):
    """What there is."""

    model: ModelRow
    systems: list[SystemChoice]
    charts: list[SystemChoice]
    properties: list[VerdictRow]
    sessions: list[OpenSession]


class TransitionItem(TypedDict):
    """A transition that is or may be taken; ``drawn`` names the pieces of it in the picture of its chart."""

    chart: str
    way: str
    label: str
    drawn: list[str]
    moves: bool
    """It leads to another state."""


class StepRow(TypedDict):
    """What a chart can do in the next tick."""

    key: str
    of: str
    title: str
    moves: bool
    standing: bool
    transitions: list[TransitionItem]
    by: list[str]
    also: list[TransitionItem]


class NextRows(TypedDict):
    """The possible next steps; ``problems`` and ``bounded`` say what is not among them."""

    steps: list[StepRow]
    anyway: list[TransitionItem]
    bounded: list[str]
    problems: list[str]
    ms: int
    """How long it took to find them."""


class ValueRow(TypedDict):
    """A variable with its value, as people write it; ``choices`` are all values, where these are few."""

    name: str
    value: str
    doc: str
    domain: str
    choices: list[str]
    changed: bool
    free: bool


class TimerRow(TypedDict):
    """A timer that runs, and how much of it is over, from 0 to 1."""

    name: str
    value: str
    limit: str
    share: float


class PastRow(TypedDict):
    """A tick of the run in which a transition led to another state."""

    tick: int
    ms: int
    text: str


class SessionDocument(TypedDict):
    """A session at the tick that is looked at."""

    session: str
    system: str
    version: int
    tick: int
    ticks: int
    ms: int
    said: list[str]
    """What the last command has to say."""
    active: dict[str, list[str]]
    fired: list[TransitionItem]
    inputs: list[ValueRow]
    frozen: list[ValueRow]
    values: list[ValueRow]
    timers: list[TimerRow]
    breaks: list[str]
    past: list[PastRow]
    past_left: int
    """How many earlier rows of the past are not listed."""
    next: NextRows
    script: str
    """Commands of ``rovercheck explore`` that make the run again."""


class ChartPicture(TypedDict):
    """A chart as drawn."""

    name: str
    text: str
    picture: str
    width: int
    height: int


class PicturesDocument(TypedDict):
    """The charts of a system, and how to read them."""

    charts: list[ChartPicture]
    legend: list[str]


JobState = Literal["searching", "done", "cancelled", "failed"]


class JobDocument(TypedDict):
    """A search: what it does, and at last what came of it; ``session`` is shown then, if it has moved."""

    job: str
    about: str
    state: JobState
    line: str
    seconds: float
    answer: str
    session: SessionDocument | None
    verdict: VerdictRow | None


class ProblemDocument(TypedDict):
    """Why something was not done."""

    error: str
