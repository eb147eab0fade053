"""Properties with and without a bound in one task: each is decided as what it is."""

from rovercheck.checker.engines import AUTO, Limits
from rovercheck.checker.results.verdict import Violated
from rovercheck.checker.verify.decide import Task, decide
from rovercheck.properties.catalogue import catalogue
from rovercheck.spec_model.rover import systems


def test_a_bounded_property_is_never_searched_as_a_loop() -> None:
    """One of two was expected to be violated and came out proved: no loop closes on a finite run."""
    unbounded, violated = (catalogue()[id] for id in ("PB1-25-turned", "PSY-12"))
    assert unbounded.on == violated.on
    task = Task(systems()[violated.on], (unbounded, violated))
    found = {r.property.id: r.verdict for r in decide(task, systems(), AUTO, Limits())}
    assert found.keys() == {unbounded.id, violated.id}
    assert isinstance(found[violated.id], Violated)
