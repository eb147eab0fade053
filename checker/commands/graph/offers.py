"""How to project: the variables of a system, and projections with their predicted sizes."""

from checker.commands.shared.output import text_width
from checker.commands.shared.wrapping import whole
from checker.explore.graphs.suggesting import Offer, Suggestions
from spec_model.lang.expr import Var

NAMED = 14
"""Variables that are listed one by one."""


def offered(system: str, found: Suggestions, options: str = "") -> str:
    """What can be projected on, as lines of text; ``options`` is what each command needs besides."""
    at_least = "at least " if found.cut else ""
    lines = [f"{system}: {at_least}{found.valuations:,} reachable valuations of the variables below."]
    if found.cut:
        lines.append(f"The exploration is cut, so all counts are lower bounds: {found.cut}.")
    wide = max((len(r.var.name) for r in found.variables[:NAMED]), default=0)
    lines += ["", f"{'variable':<{wide}}  values reached"]
    for one in found.variables[:NAMED]:
        lines.append(f"{one.var.name:<{wide}}  {one.values} of {len(one.var.domain)}{_doc(one.var, wide)}")
    if len(found.variables) > NAMED:
        lines.append(f"and {len(found.variables) - NAMED} more")
    return "\n".join([*lines, *projections(system, found, options), ""])


def projections(system: str, found: Suggestions, options: str = "") -> list[str]:
    """The projections that are worth a look, each with the command to type."""
    if not found.offers:
        return ["", "No projection on few variables has more than one node and few enough."]
    rows = [(f"{o.nodes:,}", _runs(o, found), ",".join(o.names)) for o in found.offers]
    lines = ["", "nodes  paths that are runs  command"]
    for nodes, runs, names in rows:
        command = whole(f"rovercheck graph {system} --project {names}{options}")
        lines.append(f"{nodes:>5}  {runs:<19}  {command}")
    return lines


def _runs(offer: Offer, found: Suggestions) -> str:
    """Which paths of a projection are runs of the system."""
    return "not known" if found.cut else "some" if offer.mixed else "all"


def _doc(var: Var, wide: int) -> str:
    """What the variable is, where that fits into a line of a terminal."""
    doc = var.doc.split("\n")[0]
    fits = wide + len("  00 of 00") + 4 + len(doc) <= text_width()
    return f"    {doc}" if doc and fits and not doc.startswith("active state of") else ""
