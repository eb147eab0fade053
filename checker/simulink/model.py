"""A model of Simulink: its package, and the types and values beside it."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from rovercheck.checker.drawn.activity import NONE, activity_members
from rovercheck.checker.drawn.atomic import drawn_in_place
from rovercheck.checker.drawn.parameters import rate_of
from rovercheck.checker.drawn.records import DrawnChart, DrawnEnumeration, DrawnModel
from rovercheck.checker.simulink.blocks import DiagramReader
from rovercheck.checker.simulink.chart_blocks import in_order_of_ports, without
from rovercheck.checker.simulink.dictionary import Definitions, files_beside, is_file
from rovercheck.checker.simulink.libraries import Libraries
from rovercheck.checker.simulink.masks import in_mask
from rovercheck.checker.simulink.opened import DIAGRAM, OpenedFile
from rovercheck.checker.simulink.package import SimulinkPackage
from rovercheck.checker.simulink.xml import XmlElement

ENUM = "Enum:"


def read_model(path: Path, beside: Sequence[Path] = ()) -> DrawnModel:
    """The model in a file ``.slx``, with the files that a user names ``beside`` it.

    Its data dictionary, and the classes of enumerations that its charts use, are found in its folder.
    Raises ``ModelError``, with the part and the line, for what cannot be read.
    """
    file, libraries = OpenedFile.of(path), Libraries(path.parent, beside)
    diagrams = DiagramReader(file, libraries)
    system = diagrams.root(file.model, DIAGRAM)
    charts = without(file.charts, [*diagrams.commented, *diagrams.linked])
    for own, link in diagrams.linked.items():
        charts += without(link.library.charts_at(link.path, own), diagrams.commented)
    data = tuple(one for some in (file, *libraries.used) for one in some.data)
    charts = drawn_in_place(in_order_of_ports(charts, system))
    charts = tuple(in_mask(one, diagrams.scopes.get(one.path, {}), file.place(one.part)) for one in charts)
    types = [one.type for one in data]
    types += (one.type for chart in charts for level in chart.content.every_level() for one in level.data)
    types += (block.parameters.get("OutDataTypeStr", "") for block in system.every_block())
    named_in = [one.model for one in (file, *libraries.used)]
    definitions = _definitions(path, named_in, types, beside)
    for made in _made_of_activities(charts):
        definitions.enumerations.setdefault(made.name, made)
    solver = _solver(file.package, file.model)
    named = {name: one.value for name, one in definitions.parameters.items()}
    return DrawnModel(
        name=path.stem,
        format="simulink",
        release=_release(file.package),
        step=rate_of(solver.get("FixedStep", ""), named),
        solver=solver.get("SolverName", solver.get("Solver", "")),
        system=system,
        charts=charts,
        enumerations=tuple(definitions.enumerations[name] for name in sorted(definitions.enumerations)),
        buses=tuple(definitions.buses[name] for name in sorted(definitions.buses)),
        parameters=tuple(definitions.parameters[name] for name in sorted(definitions.parameters)),
        data=data,
        files=(str(path), *(str(one.path) for one in libraries.used), *definitions.files),
    )


def _made_of_activities(charts: Iterable[DrawnChart]) -> Iterator[DrawnEnumeration]:
    """The enumerations that Stateflow makes of the names of states: 0 is none, the others by name."""
    for chart in charts:
        for one in chart.content.data:
            if one.activity_of is not None and one.activity != "self" and one.type.startswith(ENUM):
                names = [NONE, *sorted(activity_members(chart, one).values())]
                members = {name: number for number, name in enumerate(names)}
                yield DrawnEnumeration(one.type.removeprefix(ENUM).strip(), members, NONE, "", chart.path)


# --- beside the model --------------------------------------------------------------------------------------


def _definitions(
    path: Path, models: Iterable[XmlElement], types: Iterable[str], beside: Iterable[Path]
) -> Definitions:
    found = Definitions()
    for dictionary in dict.fromkeys(Path(one.property_of("DataDictionary")).name for one in models):
        if dictionary and is_file(path.parent / dictionary):
            found.read_dictionary(path.parent / dictionary)
    for file in beside:
        if file.suffix == ".slx":
            continue  # a library, which is read where there is a link to it
        if file.suffix == ".sldd":
            found.read_dictionary(file)
        else:
            found.read_text(file)
    missing = sorted(set(_enumerations(types, found)) - found.enumerations.keys())
    for file in files_beside(path, missing):
        found.read_text(file)
    return found


def _enumerations(types: Iterable[str], found: Definitions) -> Iterator[str]:
    """The names of the enumerations among the types of a model, and those of elements of buses."""
    elements = (one.type for bus in found.buses.values() for one in bus.elements)
    yield from (one.removeprefix(ENUM).strip() for one in (*types, *elements) if one.startswith(ENUM))


def _solver(package: SimulinkPackage, model: XmlElement) -> Mapping[str, str]:
    """The properties of the solver, from the configuration that is active."""
    info = "simulink/configSetInfo.xml"
    active = "simulink/configSet0.xml"
    if info in package:
        for one in package.xml(info).all("ConfigSet"):
            if one.attributes.get("Active") == "true" and (name := one.attributes.get("PartName")):
                active = name.lstrip("/")
    root = package.xml(active) if active in package else model
    for one in _active(root).every():
        if one.attributes.get("ClassName") == "Simulink.SolverCC":
            return {p.attributes.get("Name", ""): p.text.strip() for p in one.all("P")}
    return {}


def _active(root: XmlElement) -> XmlElement:
    """The configuration that is active of those inline in a model, else all of them."""
    names = (one for one in root.every() if one.attributes.get("PropName") == "ActiveConfigurationSet")
    numbers = {one.attributes.get("ObjectID") for one in names} - {None}
    sets = (one for one in root.every() if one.attributes.get("ClassName") == "Simulink.ConfigSet")
    return next((one for one in sets if one.attributes.get("ObjectID") in numbers), root)


def _release(package: SimulinkPackage) -> str:
    for part, tag in (("mwcoreProperties", "matlabRelease"), ("coreProperties", "cp:version")):
        name = f"metadata/{part}.xml"
        if name in package:
            for one in package.xml(name).every():
                if one.tag == tag:
                    return one.text.strip()
    return ""


__all__ = ["read_model"]
