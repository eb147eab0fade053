"""What a review page shows, as plain data: it knows no rover, no engine and no property form.

``checker.commands.report.run`` makes it of the rover's verdicts; whoever checks a model of his own makes
it of that.  Whatever is empty is left out of the page, or said to be missing.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from rovercheck.checker.results.trace import Trace
from rovercheck.spec_model.lang.chart import Chart

PROVED, VIOLATED, UNKNOWN = "proved", "violated", "unknown"


@dataclass(frozen=True)
class ReviewedProperty:
    """A property and its verdict.

    ``english`` is what is checked in words, ``formula`` the same as written, part by part with its name.
    ``record`` is the expected verdict ("" for none), ``certificate`` what came of checking the proof again
    ("" where that was not asked for or there is no proof), ``premise`` whether the case it speaks of
    occurs at all ("" where that was not examined), ``vacuous`` that it does not.  ``trace`` is the
    counterexample or the witness.
    """

    id: str
    text: str
    area: str
    verdict: str
    system: str
    engine: str
    evidence: str
    form: str
    english: tuple[str, ...] = ()
    formula: tuple[tuple[str, str], ...] = ()
    in_part: bool = False
    record: str = ""
    as_expected: bool = True
    certificate: str = ""
    certified: bool | None = None
    premise: str = ""
    vacuous: bool = False
    because: str = ""
    no_repair: str = ""
    cause: str = ""
    """The id of the finding whose cause this one has too; its own where the cause is its own."""
    requirements: tuple[str, ...] = ()
    interpretations: tuple[str, ...] = ()
    assumptions: tuple[str, ...] = ()
    """The interpretations and assumptions that the verdict can depend on."""
    besides: tuple[str, ...] = ()
    """Interpretations that the property reads and of which another choice leaves the verdict as it is."""
    effect: str = ""
    """What goes wrong, in one sentence, as far as that is on record."""
    severity: str = "unrated"
    hazard: str = ""
    """How bad it would be if it were broken: the id of the gravest hazard ("" if none is known)."""
    place: int = 0
    """Its place among all properties, the gravest first."""
    since: str = ""
    decision: str = ""
    accepted: bool = False
    lapsed: bool = False
    """Since when a finding is known, who lives with it, whether that holds or its time is over."""
    on: str = ""
    """The system it is stated of, where the verdict is about another one."""
    quiet: bool = False
    """Whether states after quiet ticks were visited and not stored."""
    again: str = ""
    """The command that decides it again."""
    trace: Trace | None = None

    @property
    def finding(self) -> bool:
        """Whether a reviewer has to look at it: violated, undecided, not as expected, or vacuous."""
        return self.verdict != PROVED or not self.as_expected or self.vacuous

    @property
    def undecided(self) -> bool:
        """Whether it is violated, and nobody has accepted it."""
        return self.verdict == VIOLATED and not self.accepted

    @property
    def says(self) -> str:
        """What goes wrong, if that is on record, else what is demanded."""
        return self.effect or self.text

    @property
    def word(self) -> str:
        """The verdict for people."""
        return f"{self.verdict} for a restricted model" if self.in_part else self.verdict


@dataclass(frozen=True)
class RequirementRow:
    """A row of the requirement matrix: ``state`` is the worst verdict, or why there is none."""

    id: str
    text: str
    source: str
    state: str
    reason: str = ""
    properties: tuple[str, ...] = ()
    covered: bool = True


@dataclass(frozen=True)
class HazardRow:
    """What may come of a broken requirement, how bad that is, and why it is rated so."""

    id: str
    text: str
    severity: str
    because: str


@dataclass(frozen=True)
class SystemSummary:
    """A system: what it is, how its runs compare with those of what it stands for, what it assumes."""

    name: str
    text: str
    tick_ms: int
    charts: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    assumptions: tuple[str, ...] = ()
    over: bool = False
    under: bool = False
    concrete: str = ""

    @property
    def runs(self) -> str:
        """How its runs compare with those of what it stands for; empty for the same runs."""
        words = {
            (True, False): "more runs than the real system",
            (False, True): "fewer runs than the real system",
            (True, True): "some runs more and some fewer than the real system",
        }
        return words.get((self.over, self.under), "")


@dataclass(frozen=True)
class InterpretationRow:
    """A sentence that can be read in several ways, the choices and the one that is taken."""

    id: str
    about: str
    says: str
    taken: str
    choices: tuple[tuple[str, str], ...]
    scenario: str = ""
    because: str = ""


@dataclass(frozen=True)
class ReviewAssumption:
    """Something taken for granted of the environment, and the systems that do."""

    id: str
    text: str
    systems: tuple[str, ...]


@dataclass(frozen=True)
class Edit:
    """A place of a chart that a repair changes: the lines before and after."""

    part: str
    place: str
    before: tuple[str, ...]
    after: tuple[str, ...]


@dataclass(frozen=True)
class Remedy:
    """A proposed repair: what it changes, what it repairs with which evidence, what it gives up."""

    name: str
    text: str
    edits: tuple[Edit, ...]
    proofs: tuple[tuple[str, str, str], ...]
    """Id, verdict and evidence of each property that it repairs."""
    gives_up: tuple[tuple[str, str], ...]
    again: str
    """The command that decides all that it concerns."""


@dataclass(frozen=True)
class Covered:
    """How much of one kind of goal a set of tests reaches."""

    board: str
    kind: str
    goals: int
    reached: int
    unreachable: int
    unknown: int


@dataclass(frozen=True)
class StateGraphView:
    """The reachable states of a system, seen through some variables, as texts and HTML.

    ``picture``, ``trusted`` and ``shows`` are the bodies of the parts of ``render.stategraph.fragment``.
    ``asked`` are the properties whose breaking is marked, ``unmarked`` those for which that would take too
    much.  ``again`` is the command that says what else can be seen of it.
    """

    system: str
    variables: tuple[str, ...]
    size: str
    kind: str
    picture: str
    trusted: str
    shows: str
    asked: tuple[str, ...] = ()
    again: str = ""
    unmarked: tuple[str, ...] = ()

    @property
    def charts(self) -> tuple[str, ...]:
        """The charts whose states are seen."""
        return tuple(dict.fromkeys(name.partition(".")[0] for name in self.variables))


@dataclass(frozen=True)
class ReviewOrigin:
    """How the page was made: enough to make it again and to compare it.

    ``document`` is the revision of the document, ``commit`` that of what was checked, as far as they are
    known.
    """

    command: str
    code: int
    meaning: str
    versions: tuple[tuple[str, str], ...] = ()
    digests: tuple[tuple[str, str], ...] = ()
    date: str = ""
    variant: str = ""
    document: str = ""
    commit: str = ""
    reviewer: str = ""
    options: str = ""
    """What a command needs to be about the same model."""
    at_once: bool = False
    """Causes, repairs and state graphs that nobody had looked for are left out."""
    without_cause: int = 0
    """Findings of which the cause is left out."""


@dataclass(frozen=True)
class Review:
    """Everything on the page."""

    title: str
    subject: str
    properties: tuple[ReviewedProperty, ...]
    origin: ReviewOrigin
    systems: Mapping[str, SystemSummary]
    charts: Mapping[str, Chart]
    demands: tuple[RequirementRow, ...] = ()
    interpretations: tuple[InterpretationRow, ...] = ()
    assumptions: tuple[ReviewAssumption, ...] = ()
    repairs: tuple[Remedy, ...] = ()
    coverage: tuple[Covered, ...] = ()
    graphs: tuple[StateGraphView, ...] = ()
    undrawn: tuple[tuple[str, str], ...] = ()
    """Systems with charts that have no state graph here, and why."""
    how_to_read: str = ""
    """How the sentences on what is checked are meant."""
    left_out: tuple[tuple[str, str], ...] = ()
    """Properties that were not decided, and why."""
    hazards: Mapping[str, HazardRow] = field(default_factory=dict)

    @property
    def findings(self) -> tuple[ReviewedProperty, ...]:
        """What a reviewer has to look at, the gravest first."""
        return tuple(sorted((p for p in self.properties if p.finding), key=lambda p: p.place))
