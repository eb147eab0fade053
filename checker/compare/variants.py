"""Boards whose charts are changed: other interpretations, a proposed repair, or a model of one's own."""

from collections.abc import Mapping
from dataclasses import replace

from rovercheck.checker.model import Model
from rovercheck.checker.model.variant import Variant
from rovercheck.spec_model.abstraction import Board, boards
from rovercheck.spec_model.abstraction.of_system import board_of
from rovercheck.spec_model.ambiguity import ANY, fixed
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean
from rovercheck.spec_model.lang.system import chart_alone, charts_of
from rovercheck.spec_model.repairs import Repair, repaired


def varied(choices: Mapping[str, str], repair: Repair | None = None) -> Mapping[str, Board]:
    """Every board under chosen interpretations, with a repair.

    Raises ``ModelError`` for interpretations that are left open or that boards cannot follow.
    """
    for id, choice in choices.items():
        if choice == ANY:
            raise ModelError(
                f"{id}={ANY} leaves the sentence open, and what a board did is compared with charts that "
                "read it in one way; write one of the choices that `rovercheck list interpretations` shows."
            )
    found = boards(choices)
    if repair is None:
        return found
    fixing = fixed(choices)
    return {n: replace(b, system=fixing.system(repaired(b.system, repair))) for n, b in found.items()}


def boards_of(variant: Variant, name: str | None = None) -> Mapping[str, Board]:
    """Every board of the rover, or of a model of one's own, as a variant has it.

    ``name``: only this one of a model.  Raises ``ModelError`` as ``varied`` and ``boards_of_model`` do.
    """
    own = variant.own
    found = varied(variant.choices, variant.repair) if own is None else boards_of_model(own, name)
    return {name: with_changes(board, variant) for name, board in found.items()}


def board_named(variant: Variant, name: str | None) -> Board:
    """A board of the rover, or the system of a model of one's own, as a variant has it; as ``boards_of``."""
    if variant.own is not None:
        return with_changes(of_model(variant.own, name), variant)
    known = boards_of(variant)
    if name is None or name not in known:
        raise ModelError(f"No board {name!r}. {did_you_mean(name or '', known)}")
    return known[name]


def with_changes(board: Board, variant: Variant) -> Board:
    """A board with the changes of a variant that are of it; stamps taken otherwise are among these."""
    return board if variant.changes is None else variant.changes.applied(board)


def of_model(model: Model, name: str | None = None) -> Board:
    """A system of a model, or one of its charts alone, as a board; without a name its only system.

    Raises ``ModelError`` for an unknown name, none where there are several systems, and a system that no
    implementation can be executed beside.
    """
    if name is None and len(model.systems) != 1:
        some = ", ".join(model.systems)
        raise ModelError(f"{model.name} has {len(model.systems)} systems: {some}; name one with --system.")
    name = name or next(iter(model.systems))
    charts = charts_of(model.systems)
    if name not in model.systems and name not in charts:
        known = [*model.systems, *charts]
        raise ModelError(f"{model.name} has no system and no chart {name!r}. {did_you_mean(name, known)}")
    system = model.systems.get(name) or chart_alone(charts[name], model.systems)
    assert model.path is not None, "a model of one's own is read from somewhere"
    return board_of(system, str(model.path.absolute()))


def boards_of_model(model: Model, name: str | None = None) -> Mapping[str, Board]:
    """The systems of a model that an implementation can be executed beside, or the one of a name.

    Raises ``ModelError`` for an unknown name, and where there is none.
    """
    if name is not None or len(model.systems) == 1:
        board = of_model(model, name)
        return {board.name: board}
    found, problems = dict[str, Board](), list[ModelError]()
    for one in model.systems:
        try:
            found[one] = of_model(model, one)
        except ModelError as error:
            problems.append(error)
    if not found:
        raise problems[0]
    return found
