"""A premise that is searched for on a system whose runs are reproduced on another one needs that one, too."""

from rovercheck.checker.commands.check.premises import cases
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.searches import SearchSettings, events
from rovercheck.properties.catalogue import catalogue, expected
from rovercheck.spec_model.rover import systems


def test_the_system_that_reproduces_runs_is_at_hand() -> None:
    prop = next(p for p in catalogue().values() if p.id == "PB1-11")
    assert systems()[prop.on].concrete
    [proved] = (one for one in events([prop], systems(), SearchSettings()) if isinstance(one, Result))
    found = cases([CheckedProperty(proved, expected(prop.id))], systems(), SearchSettings(), known={})
    assert found[prop.id].occurs
