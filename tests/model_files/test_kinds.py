"""Things of the wrong kind in a user's model, and all that is wrong with it at once.

Each was found out by some part of the checker and told as an internal error, or not found out at all.
"""

import re
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit

HEAD = """
from rovercheck.properties.forms import Always, Property, always, leads_to, never, recoverable, responds
from rovercheck.spec_model.lang.action import assign, send, when
from rovercheck.spec_model.lang.chart import Block, Chart, Enabled, State, Transition, to
from rovercheck.spec_model.lang.domain import enumeration, integer
from rovercheck.spec_model.lang.expr import const, flag, member, var
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.lang.time import ms, sec, ticks
from rovercheck.spec_model.lang.words import absolute, after, duration, held, previous, quotient, rising
hot, on, minutes = flag("hot"), flag("on"), var("minutes", integer(0, 9, "min"))
off = State("Off", entry=[assign(on, False)], transitions=[to("On", when=hot)])
oven = Chart("Oven", [off, State("On", entry=[assign(on, True)])], default="Off")
"""
FIRST = len(HEAD.splitlines()) + 1


def always(that: str = "on", about: str = '"Oven"', covers: str = '["R"]', more: str = "") -> str:
    return f'P = always("P-1", "A sentence.", that={that}, covers={covers}, on={about}{more})'


def responds(within: str) -> str:
    form = f"trigger=on, response=hot, within={within}"
    return f'P = responds("P-1", "A sentence.", {form}, covers=["R"], on="Oven")'


def chart(state: str) -> str:
    return f'C = Chart("C", [{state}], default="A")'


def system(components: str) -> str:
    return f'S = in_order("S", {components})\nQ = always("Q", "t", that=on, covers=["R"], on=S)'


COUNTS = system('Block("B", [assign(on, minutes > 3)])')

WRONG = {
    "a text in a formula": (always('on | "x > 1"'), "'x > 1' has no meaning beside a boolean"),
    "a text for a formula": (always("'on'"), "P-1: that is 'on', a text; write a formula, such as"),
    "a truth value": (always("True"), "P-1: that is True, a truth value; write a formula"),
    "a chart for a formula": (always("oven"), "P-1: that is Chart('Oven'), a Chart; write a formula"),
    "about a number": (always(about="5"), "P-1: on is 5, a number; write a system, its name, or a chart"),
    "about nothing": (always(about="None"), "P-1: on is None, nothing; write a system"),
    "a number for a time": (responds("3"), "P-1: within is 3, a number; write a length of time, such as"),
    "a part of a tick": (responds("3 * ms"), "P-1: within=3 ms is not a whole number of ticks of 20 ms"),
    "a time before": (responds("-3 * sec"), "P-1: within=-3 s is not a whole number of ticks of 20 ms"),
    "a text for a tick": (always(more=', from_tick="2"'), "P-1: from_tick is '2', a text; write a whole"),
    "one interpretation": (
        always(more=', interpretations="S1"'),
        "interpretations='S1' is one text; write interpretations=['S1'].",
    ),
    "a number for a requirement": (always(covers="[1]"), "P-1: covers holds 1, a number; write a text"),
    "one formula for several": (
        'P = leads_to("P-1", "t", trigger=on, response=hot, fair=on, covers=["R"], on="Oven")',
        "P-1: fair=on is no list; write fair=[on].",
    ),
    "a number for a time of a chart": (
        chart('State("A", transitions=[to("A", when=after(3))])'),
        "the transition to 'A': span is 3, a number; write a length of time, such as `3 * sec`",
    ),
    "a number for a held time": (
        chart('State("A", transitions=[to("A", when=held(hot, 3))])'),
        "the transition to 'A': span is 3, a number; write a length of time",
    ),
    "the past of a number": (
        chart('State("A", transitions=[to("A", when=previous(3))])'),
        "the transition to 'A': the condition is 3, a number; write a formula",
    ),
    "a label that is a name alone": (
        chart('State("A", transitions=[to("A", when="hot")])'),
        "C: transition 1 of A waits for the event hot, which is never sent to A.",
    ),
    "a text for a transition": (
        chart('State("A", transitions=["B"])'),
        "State 'A': transitions holds 'B', a text; write a transition, to(...) there.",
    ),
    "one transition for several": (
        chart('State("A", transitions=to("A"))'),
        "m.py:13: State 'A': transitions is a Transition, no list; write transitions=[...].",
    ),
    "a text for a state": (chart('"A"'), "State 'C': states holds 'A', a text; write a state, State(...)"),
    "a transition to a number": (
        chart('State("A", transitions=[to(3)])'),
        "target is 3, a number; write a text.",
    ),
    "no component": (system("None"), "System 'S': components holds None, nothing; write a chart, a block"),
    "a list of components": (system("[oven]"), "System 'S': components holds [Chart('Oven')], a list; write"),
    "a text for an assumption": (system('oven, assume="x"'), "System 'S': assume is 'x', a text; write a"),
    "a condition for an action": (
        system('Block("B", [on == hot])'),
        "Block 'B': do holds on == hot, a boolean",
    ),
    "a tick of no length": (system("oven, tick_ms=0"), "S: tick_ms=0 is no length of time; write whole"),
    "a span for a tick": (system("oven, tick_ms=20 * ms"), "System 'S': tick_ms is Span("),
    "half a tick": (
        system("oven, tick_ms=2.5"),
        "System 'S': tick_ms is 2.5, a number; write a whole number.",
    ),
    "one note": (system('oven, notes="n"'), "S: notes='n' is one text; write notes=['n']."),
    "about a chart in two systems": (
        f'{system("oven")}\nT = in_order("T", oven)\n{always()}',
        "P-1 is about 'Oven', no system of this model. It is a chart of S, T: write on='S'.",
    ),
    "another unit under one name": (
        f"{COUNTS}\n" + always('var("minutes", integer(0, 600, "s")) < 600', "S"),
        "P-1 and system S: two variables are named minutes: integer in 0..9 min from 0 and integer in 0..600",
    ),
    "another kind under one name": (
        always('var("on", integer(0, 3)) < 2'),
        "P-1 and system Oven: two variables are named on: boolean from false and integer in 0..3",
    ),
    "another range under one name": (
        f"{COUNTS}\n" + always('previous(var("minutes", integer(0, 3, "min"))) < 2', "S"),
        "P-1 and system S: two variables are named minutes: integer in 0..9 min from 0 and integer in 0..3",
    ),
    "another beginning under one name": (
        always('var("hot", hot.domain, init=1)'),
        "P-1 and system Oven: two variables are named hot: boolean from false and boolean from true; rename",
    ),
    "an id that is a chart's name": (
        always().replace('"P-1"', '"Oven"'),
        "Oven: its monitor has the name Oven, as a variable of system Oven has; give the property another",
    ),
    "an id that is a variable": (
        always().replace('"P-1"', '"on"'),
        "on: its monitor has the name on, as a variable of system Oven has; give",
    ),
    "an id that is another's counter": (
        f"{responds('3 * ticks')}\n{always().replace('P =', 'Q =').replace('P-1', 'P-1.waiting')}",
        "P-1.waiting: its monitor has the name P-1.waiting, as another property has; give",
    ),
    "about another chart of the name": (
        'S = in_order("S", oven)\nO = in_order("Oven", Chart("Oven", [off, State("On")], default="Off"))\n'
        + always(about="oven"),
        "P-1: on= is a chart named Oven, and the system of that name in the model is another; write the one",
    ),
    "about another system of the name": (
        f'S = in_order("S", oven)\n{always(about="in_order(" + repr("S") + ", oven, assume=hot)")}',
        "P-1: on= is a system named S, and the system of that name in the model is another; write the one",
    ),
    "one frozen variable twice": (
        system("oven, frozen=[minutes, minutes]"),
        "S: 2 frozen variables are named minutes; name each once.",
    ),
    "two assumptions of one id": (
        "from rovercheck.spec_model.lang.system import Assumption\n"
        + system('oven, assumptions=[Assumption("A", "a", hot)] * 2'),
        "S: 2 assumptions have the id A; name each once.",
    ),
    "a number among conditions": (
        always("on & hot & minutes > 0"),
        "`minutes` is an integer in min; `and` needs a condition, such as a comparison. Python reads "
        "`a & x > 0` as `(a & x) > 0`, and `~` and `|` alike: write `a & (x > 0)`.",
    ),
    "a condition before a number": (
        always("minutes > 3 & hot"),
        "3 has no meaning beside a boolean; write a value of that sort. Python reads `x > 0 & a` as "
        "`x > (0 & a)`, and `|` alike: write `(x > 0) & a`.",
    ),
    "a comparison before a disjunction": (always("minutes == 3 | hot"), "write `(x > 0) & a`."),
    "conditions compared with a number": (always("hot & on == 3"), "beside a boolean; write a value of that"),
    "the negation of a constant": (
        always("~const(3)"),
        "m.py:13: `3` is an integer; `not` needs a condition, such as a comparison.",
    ),
    "a number for a condition": (always("const(3)"), "P-1: `3` is an integer; write a condition, such as"),
    "an action for a formula": (always("assign(on, hot)"), "an Assign; write a formula"),
    "a text for data of states": (
        chart('State("A")').replace("default", 'local_to=[("hot", ["A"])], default'),
        "Chart 'C': local_to holds ('hot', ['A']); write pairs, (variable, [names of states]).",
    ),
    "one text for states": (
        chart('State("A")').replace("default", 'local_to=[(hot, "A")], default'),
        "the states of local_to='A' is one text; write the states of local_to=['A'].",
    ),
    "a part of a number for a member": (
        'E = enumeration("E", {"a": 1.5})',
        "The enumeration E has the number 1.5; write a whole number.",
    ),
    "a member twice": ('E = enumeration("E", ["a", "a"])', "The enumeration E has the member 'a' twice;"),
    "one text for members": (
        'E = enumeration("E", "abc")',
        "members='abc' is one text; write members=['abc']",
    ),
    "a remainder": ("x = minutes % 2", "`minutes % 2`: write modulo(minutes, 2)."),
    "a quotient": ("x = minutes // 2", "`minutes // 2`: write quotient(minutes, 2)."),
    "a distance": ("x = abs(minutes)", "`abs(minutes)`: write absolute(minutes)."),
    "the greater": ("x = max(minutes, 3)", "ite(), minimum(), maximum() for if, min, max;"),
    "every one of a formula": ("x = all(hot)", "A formula is no list; join conditions with & and |, or with"),
    "a sum of times": ("x = 3 * sec + 2 * ticks", "3 s and 2 ticks are not added: how long a tick is"),
    "a short duration": ("x = duration(hot) < 3 * sec", "not by <; write `~(duration(hot) >= ...)`."),
    "an exact duration": ("x = duration(hot) == 3 * sec", "not by ==; write `duration(hot) >= ...`."),
    "a text assigned to": (
        'x = assign("on", True)',
        "assign() takes a variable, made with var() or flag(), and",
    ),
    "a text that rises": (
        'x = rising("hot")',
        "`rising` takes a formula, such as a variable, and not 'hot'.",
    ),
    "a plain number": ("x = absolute(3)", "`absolute` takes a formula, such as a variable, and not 3."),
    "plain numbers": ("x = quotient(5, 2)", "`quotient` takes a formula, such as a variable, and not 5."),
    "a member of a number": ('x = member(5, "a")', "member() takes a domain, such as integer(0, 9) or"),
    "a variable of a number": ('x = var("x", 5)', "var('x', ...) takes a domain, such as integer(0, 9) or"),
    "a variable of a pair": ('x = var("x", (0, 9))', "takes a domain, such as integer(0, 9) or enumeration"),
    "a state with a number": ("x = oven.active(5)", "Oven has no state 5; write its name."),
    "no state": (
        always("~oven.active()"),
        "active() names no state of Oven; write the name of one at least.",
    ),
    "no entry": (
        chart('State("A", entry=None)'),
        "State 'A': entry=None is nothing; write entry=[], or leave",
    ),
    "a number to begin with": (
        'C = Chart("C", [State("A")], default=5)',
        "State 'C': default=5; write the name of a state, or",
    ),
    "a set of requirements": (always(covers='{"S", "R"}'), "is a set; write covers=['R', 'S']."),
    "requirements in a mapping": (
        always(covers='{"R": 1}'),
        "covers={'R': 1} is a dict; write covers=['R'].",
    ),
    "a requirement without a name": (always(covers='[""]'), "P-1: covers=[''] names no requirement; write"),
    "no requirement": (
        'P = Property("P-1", "t", Always(on), (), "Oven")',
        "P-1: covers=[] names no requirement; write the ids of some.",
    ),
    "before the first tick": (always(more=", from_tick=0"), "P-1: from_tick=0 is no tick; the first is 1."),
    "an interpretation of the rover": (
        always(more=', interpretations=["S43"]'),
        "interpretations=['S43'] are of the rover only;",
    ),
    "steps between ticks": (system("oven, step_ms=30"), "S: step_ms=30 is no multiple of tick_ms=20;"),
    "a chart without a name": ('C = Chart("", [State("A")], default="A")', "'' has an empty name, or a part"),
    "its own charts": (system('oven, concrete="S"'), "S names concrete='S', which leads back to S; name the"),
    "conditions compared": (
        always("minutes == on & hot"),
        "`minutes` is an integer in min and `on && hot` a boolean; compare values of one sort. Python reads",
    ),
}


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def refused(capfd: pytest.CaptureFixture[str], text: str, path: str = "m.py") -> list[str]:
    """The lines that are told of a model: one for each fault, and nothing else."""
    if path.endswith(".py"):
        Path(path).write_text(f"{HEAD}{text}\n", encoding="utf-8")
    assert run(["check", "--model", path]) is Exit.USAGE
    said = capfd.readouterr()
    assert said.out == "" and "Internal error" not in said.err
    return said.err.splitlines()


@pytest.mark.parametrize("wrong", WRONG)
def test_a_thing_of_the_wrong_kind(wrong: str, capfd: pytest.CaptureFixture[str]) -> None:
    text, message = WRONG[wrong]
    [line] = refused(capfd, text)
    assert message in line
    assert re.match(r"m\.py:\d+: ", line)


@pytest.mark.parametrize("about", ['"Oven"', "oven", "S", '"S"'])
def test_a_property_names_what_it_is_about_or_is_given_it(about: str, here: Path) -> None:
    """``on=oven``, the chart itself, was an internal error."""
    own = 'S = in_order("S", Block("B", [assign(on, hot)]))\n'
    (here / "m.py").write_text(f"{HEAD}{own}{always('on | ~on', about)}\n", encoding="utf-8")
    assert run(["check", "--model", "m.py", "--quiet"]) is Exit.AS_EXPECTED


def test_all_that_is_wrong_is_told(capfd: pytest.CaptureFixture[str]) -> None:
    """One fault was told, and the next one after it was mended."""
    faulty = [
        'A = always("P-1", "t", covers=["R"], on="Oven", that=flag("onn"))',
        'B = always("P-2", "t", covers=["R"], on="Owen", that=on)',
        'C = responds("P-3", "t", covers=["R"], on="Oven", trigger=on, response=on, within=3 * ms)',
        'D = always("P-4", "", covers=["R"], on="Oven", that=on)',
        'E = always("P-5", "t", covers=["R"], on="Oven", that=flag("x") & flag("y"))',
    ]
    text = "\n".join(faulty)
    assert lines_of(refused(capfd, text)) == [FIRST, FIRST + 1, FIRST + 2, FIRST + 3, FIRST + 4, FIRST + 4]


def lines_of(told: list[str]) -> list[int]:
    return [int(line.split(":")[1]) for line in told]


def test_the_errors_of_all_files_are_told(here: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (here / "model").mkdir()
    for name in ("a", "b"):
        (here / "model" / f"{name}.py").write_text("x = 1 / 0\n")
    (here / "model" / "c.py").write_text("from .a import x\n")
    assert [line.partition(":")[0] for line in refused(capfd, "", "model")] == ["model/a.py", "model/b.py"]


def test_a_tick_of_another_length_counts_the_times_of_charts(
    here: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """``after(100 * ms)`` was over after 50 ms where a tick is 10 ms."""
    states = 'State("A", transitions=[to("B", when=after(100 * ms))]), State("B")'
    lines = [
        chart(states),
        'S = in_order("S", C, tick_ms=10)',
        always('~C.active("B")', "S"),
    ]
    (here / "m.py").write_text("\n".join((HEAD, *lines)), encoding="utf-8")
    assert run(["check", "--model", "m.py"]) is Exit.FAILED
    assert "violated 11 ticks = 0.11 s of S" in capfd.readouterr().out
