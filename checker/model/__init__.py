"""What is checked: systems with properties, the expected verdicts and the requirements they cover.

The rover is one model (``checker.model.rover``), a file or folder of a user's own is another
(``checker.model.load``); commands do not care which.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from shlex import quote

from rovercheck.properties.expected import Expected
from rovercheck.properties.forms import Property
from rovercheck.properties.hazards import Hazard
from rovercheck.properties.requirements import Requirement
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.place import Place
from rovercheck.spec_model.lang.system import System, charts_of

SIMULINK = ".slx"
"""What the name of a model of Simulink ends with."""
SCXML = ".scxml"
"""What the name of a machine in SCXML ends with."""
XSTATE = ".json"
"""What the name of a machine of XState ends with."""
FOREIGN = (SIMULINK, SCXML, XSTATE)
EXAMPLE = "`rovercheck init FOLDER` writes an example."


class ForeignModel:
    """A model of another tool, which is read as a system."""

    @property
    def system(self) -> System:
        """The system that properties are about."""
        raise TypeError(f"{type(self).__name__} says no system.")


def beside_caller(path: str | Path, caller: Place | None) -> Path:
    """A path as a file writes it that asks for it: from its own folder, if something is there."""
    whole = Path(path)
    beside = whole if caller is None else Path(caller.file).parent / whole  # an absolute one stays as it is
    return beside if beside.exists() else whole


@dataclass(frozen=True)
class Model:
    """Systems and properties by name; ``on_record`` holds the verdicts expected not to be "proved".

    ``path`` is where a user's own model was read from, None for the rover.  ``first`` are the requirements
    whose violation is gravest; the others follow in the order of the register.  ``hazards`` say what may come
    of breaking them, the gravest first.
    """

    systems: Mapping[str, System]
    properties: Mapping[str, Property]
    on_record: Mapping[str, Expected] = field(default_factory=dict)
    requirements: Mapping[str, Requirement] = field(default_factory=dict)
    path: Path | None = None
    first: tuple[str, ...] = ()
    hazards: Mapping[str, Hazard] = field(default_factory=dict)

    @property
    def by_gravity(self) -> tuple[str, ...]:
        """The requirements, by id, in the order in which their violations are told."""
        return tuple(dict.fromkeys((*self.first, *self.requirements)))

    @property
    def name(self) -> str:
        """What messages call it."""
        return "the rover" if self.path is None else shown(self.path)

    @property
    def options(self) -> str:
        """What a command needs to be about this model."""
        return "" if self.path is None else f"--model {quote(shown(self.path))}"

    @property
    def charts(self) -> dict[str, Chart]:
        """Every chart by name."""
        return charts_of(self.systems)

    def stated(self) -> Mapping[str, Property]:
        """The properties, of which there is one at least.  Raises ``ModelError`` if there is none."""
        if not self.properties:
            forms = "Write one with a form of rovercheck, such as always(...)"
            if self.path is not None and self.path.suffix in FOREIGN:
                page = {SIMULINK: "simulink", SCXML: "scxml"}.get(self.path.suffix, "xstate")
                forms += f", in {self.path.stem}_properties.py beside it (docs/{page}.md)"
            elif self.path is not None and self.path.with_name(f"{self.path.stem}_properties.py").exists():
                folder = quote(shown(self.path.absolute().parent))
                raise ModelError(
                    f"{self.name} holds no property: {self.path.stem}_properties.py beside it is read with "
                    f"the folder, --model {folder}"
                )
            raise ModelError(f"{self.name} holds no property: there is nothing to check. {forms}; {EXAMPLE}")
        return self.properties

    def expected(self, id: str) -> Expected:
        """The verdict expected of a property."""
        return self.on_record.get(id, Expected())


def names_of(system: System) -> set[str]:
    """What a property of the system may speak of: states, what is written, what is frozen, inputs."""
    places = {v.name for chart in system.charts for v in (*chart.locations, chart.entered)}
    return places | {v.name for v in system.frozen} | system.written.keys() | system.inputs.keys()


def shown(file: Path) -> str:
    """A path as short as it can be written from here."""
    whole, here = file.absolute(), Path.cwd()
    return str(whole.relative_to(here)) if whole.is_relative_to(here) and whole != here else str(file)
