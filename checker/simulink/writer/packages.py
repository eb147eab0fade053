"""Packages: models as ZIP files of XML parts, in the layouts of old and new releases."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal, TypeAlias
from xml.etree.ElementTree import Element
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from rovercheck.checker.simulink.writer.chart_parts import ChartXml
from rovercheck.checker.simulink.writer.charts import WrittenChart
from rovercheck.checker.simulink.writer.elements import Values, below, made, put, xml_of
from rovercheck.checker.simulink.writer.systems import Parts, WrittenSystem

Layout = Literal["parts", "single", "inline"]
"""One part for each chart and system, one for all charts, or everything in that of the diagram."""
Files: TypeAlias = dict[str, bytes]
OPEN = "http://schemas.openxmlformats.org/package/2006/"
MATHWORKS = "http://schemas.mathworks.com/"
DIAGRAM = "simulink/blockdiagram.xml"


@dataclass
class WrittenModel:
    """A model with its diagram; ``charts`` are those of its blocks, ``machine`` data of all together."""

    name: str
    step: str = "0.1"
    release: str = "R2024b"
    layout: Layout = "parts"
    dictionary: str = ""
    machine: Mapping[str, Values] = field(default_factory=dict)
    charts: list[WrittenChart] = field(default_factory=list)
    last: int = 0

    def __post_init__(self) -> None:
        self.root = WrittenSystem(self._next, self.charts)

    def _next(self) -> str:
        self.last += 1
        return str(self.last)

    def save(self, path: Path) -> Path:
        """Write the package; the same model gives the same bytes."""
        packed(path, self.files())
        return path

    def files(self) -> Files:
        """The parts of the package by their names."""
        parts: Parts | None = {} if self.layout == "parts" else None
        root = self.root.element(parts, self.last)
        diagram = made("ModelInformation", {"Version": "1.0"})
        model = below(diagram, "Model")
        if parts is not None:
            put(model, {"ModelUUID": "00000000-0000-4000-8000-00000000000a"})
        put(model, {"DataDictionary": self.dictionary or None})
        if parts is not None:
            put(model, {"LastSavedArchitecture": "glnxa64"})
            below(model, "System", None, Ref="system_root")
            parts["system_root"] = root
        else:
            model.append(root)
        every = {f"simulink/systems/{name}.xml": one for name, one in (parts or {}).items()}
        machine, charts = self._machine()
        if self.layout == "inline":
            model.append(self._configuration())
            diagram.append(machine)
        else:
            every["simulink/configSet0.xml"] = made("ConfigSet")
            every["simulink/configSet0.xml"].append(self._configuration())
            every["simulink/configSetInfo.xml"] = made("ConfigSetInfo")
            active = {"PartName": "/simulink/configSet0.xml", "Active": "true"}
            below(every["simulink/configSetInfo.xml"], "ConfigSet", None, **active).text = "Configuration"
            machine_part = "stateflow/machine" if self.layout == "parts" else "stateflow"
            every[f"simulink/{machine_part}.xml"] = machine
            every |= charts
        every[DIAGRAM] = diagram
        files = {name: xml_of(one) for name, one in every.items()}
        return files | self._metadata() | _relations(files)

    def _configuration(self) -> Element:
        root = made("Object", {"Version": "24.1.0", "ClassName": "Simulink.ConfigSet"})
        array = below(root, "Array", None, PropName="Components", Type="Handle", Dimension="1*1")
        solver = {
            "StartTime": "0.0", "StopTime": "10.0", "FixedStep": self.step, "SolverName": "FixedStepDiscrete",
            "SampleTimeConstraint": "Unconstrained",
        }  # fmt: skip
        below(array, "Object", solver, ObjectID="2", ClassName="Simulink.SolverCC")
        put(root, {"Name": "Configuration"})
        return root

    def _machine(self) -> tuple[Element, Mapping[str, Element]]:
        """The machine, and charts in parts of their own where the layout has them."""
        first = max(self.last, 20) + 1
        ids, number = [], first + 1
        for chart in self.charts:
            ids.append(number)
            number += chart.last + 11
        root = made("Stateflow")
        machine = below(root, "machine", None, id=str(first))
        put(machine, {"isLibrary": None if self.layout == "parts" else 0, "sfVersion": "82450000"})
        children = below(machine, "Children")
        described = {"description": "Default Simulink S-Function Target."}
        below(children, "target", described, id=str(number), name="sfun")
        for offset, (name, values) in enumerate(self.machine.items(), 500):
            below(children, "data", values, id=str(number + offset), name=name)
        own = {}
        for id_, chart in zip(ids, self.charts, strict=True):
            element = ChartXml(chart, id_).element()
            if self.layout == "parts":
                own[f"simulink/stateflow/chart_{id_}.xml"] = element
                below(children, "chart", None, Ref=f"chart_{id_}")
            else:
                children.append(element)
        for id_, (shift, chart) in zip(ids, enumerate(self.charts, 1), strict=True):
            values = {"machine": first, "name": chart.path, "chart": id_}
            below(root, "instance", values, id=str(number + shift))
        return root, own

    def _metadata(self) -> Files:
        core = made("cp:coreProperties", {"xmlns:cp": f"{OPEN}metadata/core-properties"})
        below(core, "cp:version").text = self.release
        own = made("mwcoreProperties", {"xmlns": f"{MATHWORKS}package/2012/coreProperties"})
        below(own, "contentType").text = "application/vnd.mathworks.simulink.model"
        below(own, "matlabRelease").text = self.release
        return {"metadata/coreProperties.xml": xml_of(core), "metadata/mwcoreProperties.xml": xml_of(own)}


def _relations(names: Iterable[str]) -> Files:
    """What leads to the parts, and says of what type they are."""
    root = made("Relationships", {"xmlns": f"{OPEN}relationships"})
    types = made("Types", {"xmlns": f"{OPEN}content-types"})
    for number, name in enumerate(sorted(names), 1):
        type_ = f"{MATHWORKS}simulink/2010/relationships/{Path(name).stem}"
        below(root, "Relationship", None, Id=f"rId{number}", Target=name, Type=type_)
    for extension in ("rels", "xml"):
        type_ = f"application/vnd.mathworks.simulink.mdl+{extension}"
        below(types, "Default", None, ContentType=type_, Extension=extension)
    return {"_rels/.rels": xml_of(root), "[Content_Types].xml": xml_of(types)}


def packed(path: Path, files: Mapping[str, bytes | str], method: int = ZIP_DEFLATED) -> None:
    """A ZIP file of parts, which is the same whenever it is written."""
    with ZipFile(path, "w", method) as package:
        for name in sorted(files):
            info = ZipInfo(name, (2024, 1, 1, 0, 0, 0))
            info.compress_type = method
            package.writestr(info, files[name])


__all__ = ["DIAGRAM", "Files", "Layout", "WrittenModel", "packed"]
