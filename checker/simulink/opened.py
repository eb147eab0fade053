"""A model or a library that is opened: its diagram as it is written, and its charts."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path

from rovercheck.checker.drawn.records import DrawnChart, DrawnData
from rovercheck.checker.simulink.charts import chart_of, charts_in, data_of
from rovercheck.checker.simulink.package import SimulinkPackage
from rovercheck.checker.simulink.xml import XmlElement
from rovercheck.spec_model.lang.errors import ModelError

DIAGRAM = "simulink/blockdiagram.xml"
MACHINE = "simulink/stateflow/machine.xml"
ALL_CHARTS = "simulink/stateflow.xml"
DEFAULTS = "simulink/bddefaults.xml"


@dataclass
class OpenedFile:
    """A file ``.slx``: ``top`` is the root of its diagram, ``model`` the element of the model or library.

    Raises ``ModelError``, with the part and the line, for what cannot be read.
    """

    path: Path
    package: SimulinkPackage
    top: XmlElement
    model: XmlElement
    _parts: dict[str, XmlElement] = field(default_factory=dict)

    @staticmethod
    def of(path: Path) -> "OpenedFile":
        """The file at a path."""
        package = SimulinkPackage(path)
        if DIAGRAM not in package:
            raise ModelError(
                f"{path}: it has no part {DIAGRAM}, and so is no model of Simulink. Name a file .slx; a text "
                "file .mdl is saved as one with `save_system` or File, Save As."
            )
        top = package.xml(DIAGRAM)
        model = top if top.tag in ("Model", "Library") else top.child("Model", "Library")
        if model is None:
            raise ModelError(
                f"{package.place(DIAGRAM)}: it holds no model. Save the model again in Simulink."
            )
        return OpenedFile(path, package, top, model)

    def place(self, part: str) -> str:
        """How a part is named in a message."""
        return self.package.place(part)

    def xml(self, part: str) -> XmlElement:
        """The root element of a part, which is read once."""
        if part not in self._parts:
            self._parts[part] = self.package.xml(part)
        return self._parts[part]

    @cached_property
    def defaults(self) -> Mapping[str, Mapping[str, str]]:
        """The defaults of blocks, which newer releases write into a part of their own."""
        apart = self.xml(DEFAULTS).every() if DEFAULTS in self.package else ()
        listed = (one for m in (self.model, *apart) for one in m.all("BlockParameterDefaults"))
        every = (one for some in listed for one in some.all("Block"))
        return {one.attributes.get("BlockType", ""): one.properties() for one in every}

    @cached_property
    def _machine(self) -> tuple[str, XmlElement] | None:
        """The part and the element of the charts: parts of their own, one part, or the diagram."""
        for part in (MACHINE, ALL_CHARTS):
            if part in self.package:
                return part, self.xml(part)
        found = next((one for one in self.top.every() if one.tag == "Stateflow"), None)
        return None if found is None else (DIAGRAM, found)

    @cached_property
    def charts(self) -> tuple[DrawnChart, ...]:
        """The charts in the order of the file."""
        if self._machine is None:
            return ()
        part, root = self._machine
        paths = {one.property_of("chart"): one.property_of("name") for one in root.all("instance")}
        charts = []
        for one in charts_in(root):
            own, element = part, one
            if reference := one.attributes.get("Ref"):
                own = f"simulink/stateflow/{reference}.xml"
                element = self.xml(own)
            path = paths.get(element.attributes.get("id", "")) or element.property_of("name")
            charts.append(chart_of(element, own, path, self.place(own)))
        return tuple(charts)

    @cached_property
    def data(self) -> tuple[DrawnData, ...]:
        """The data of all charts together."""
        if self._machine is None:
            return ()
        part, root = self._machine
        data = (one for m in root.all("machine") for c in m.all("Children") for one in c.all("data"))
        return tuple(data_of(one, self.place(part)) for one in data)

    def charts_at(self, source: str, path: str) -> tuple[DrawnChart, ...]:
        """The charts in a block of a library, as they are in a link to it at a path."""
        return tuple(
            replace(one, path=path + one.path.removeprefix(source), part=f"{self.path.name}: {one.part}")
            for one in self.charts
            if one.path == source or one.path.startswith(f"{source}/")
        )


__all__ = ["DIAGRAM", "OpenedFile"]
