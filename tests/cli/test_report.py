"""The verb ``report``: the same verdicts and exit codes as ``check``, and a page that says so, or none."""

import json
import re
from dataclasses import replace
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.check.premises import premise_case
from rovercheck.checker.commands.report import command
from rovercheck.checker.commands.report import graphs as reviewing_graphs
from rovercheck.checker.commands.report import report as verb
from rovercheck.checker.commands.report import rover as of_the_rover
from rovercheck.checker.commands.report import run as reviewing
from rovercheck.checker.commands.report.data import by_number, cause, drawn, named, written
from rovercheck.checker.commands.report.graphs import LEFT_OUT, state_graphs
from rovercheck.checker.commands.report.rover import coverage
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.engines import Limits
from rovercheck.checker.model.rover import rover
from rovercheck.checker.render.review import inside
from rovercheck.checker.render.review.model import StateGraphView
from rovercheck.checker.results.verdict import Unknown, Violated
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.checker.verify.result import Result
from rovercheck.properties.catalogue import catalogue, expected
from rovercheck.properties.expected import Expected
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.repairs import Repair
from rovercheck.spec_model.rover import systems
from tests.render.test_page import Reader
from tests.render.test_review import unpacked
from tests.render.zoo import long_trace
from tests.traces import changed

ROOT = Path(__file__).parents[2]
CHEAP = ["PB1-15", "PB1-11"]


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> tuple[Exit, str]:
    """The page on two cheap properties, one violated and one proved and certified."""
    file = tmp_path_factory.mktemp("report") / "review.html"
    code = run(["report", *CHEAP, "--certify", "--no-repairs", "-o", str(file)])
    return code, file.read_text(encoding="utf-8")


def entry(document: str, id: str) -> str:
    """The section of a property, with what a proof keeps packed."""
    return shown(document, id) + unpacked(document).get(inside(id), "")


def shown(document: str, id: str) -> str:
    start = document.index(f'<details class="entry property{"" if id == "PB1-11" else " finding"}" id="{id}"')
    return document[start : document.index("</details>", start)]


def test_a_violation_on_record_is_as_expected(made: tuple[Exit, str]) -> None:
    code, document = made
    assert code == Exit.AS_EXPECTED
    assert "Exit code 0: every verdict is as expected, what is violated being on record" in document


def test_a_finding_has_reason_formula_requirement_and_readings(made: tuple[Exit, str]) -> None:
    finding = entry(made[1], "PB1-15")
    assert expected("PB1-15").because.replace(">", "&gt;") in finding
    assert "in every step in which rx_status is RX_OK and b2_sup_status is SUP_OK" in finding
    assert "!(rx_status == RX_OK &amp;&amp; b2_sup_status == SUP_OK) || !give_b2_actuation" in finding
    assert 'href="#requirement-B1-REL-04"' in finding
    assert 'href="#reading-S45"' in finding
    assert "B1_actuating → B2_actuating (transition 1)" in finding
    assert 'stated of <a href="#system-relay">relay</a>' in finding
    assert "told-reasons" in finding


def test_the_states_of_its_chart_are_there_with_where_it_is_broken(made: tuple[Exit, str]) -> None:
    start = made[1].index('id="graph-relay"')
    graph = made[1][start : made[1].index("</section>", start)]
    assert "3 nodes and 5 edges for 305 states; marked: where PB1-15 is broken" in graph
    assert "PB1-15 is broken in 151 states behind 1 node: B2_actuating." in graph
    assert '<a href="#system-board1">board1</a> (12 charts)' in graph


def test_a_proof_says_who_checked_it_again(made: tuple[Exit, str]) -> None:
    proof = entry(made[1], "PB1-11")
    assert "<dt>Certificate</dt>" in proof and "accepted: " in proof


def test_a_selection_shows_only_what_concerns_it(made: tuple[Exit, str]) -> None:
    ids = {a.get("id") or "" for _, a in Reader(made[1]).elements}
    asked = {covered for id in CHEAP for covered in catalogue()[id].covers}
    assert {id.removeprefix("requirement-") for id in ids if id.startswith("requirement-")} == asked
    assert "chart-Relay" in ids and "chart-Obstacles" not in ids
    assert "not decided here" not in made[1]


def test_the_page_shows_how_it_was_made_but_no_place_and_no_time(made: tuple[Exit, str]) -> None:
    document = made[1]
    assert "rovercheck report PB1-15 PB1-11 --output FILE --certify --no-repairs" in document
    assert "z3-solver" in document and "sha256 " in document
    assert "pytest" not in document and "Made on" not in document


def test_the_command_holds_what_differs_from_the_defaults() -> None:
    line = [
        "B-1",
        "-o",
        "x.html",
        "--interpret",
        "S43=AND",
        "--interpret",
        "S44=any",
        "--timeout",
        "5",
        "--full",
        "--no-explain",
        "--pdf",
        "x.pdf",
    ]
    with verb.make_context("report", line) as context:
        shown = command(context)
    assert shown == (
        "rovercheck report B-1 --full --output FILE --pdf FILE --no-explain --interpret S43=AND "
        "--interpret S44=any --timeout 5.0"
    )


def test_nowhere_to_write_is_said_before_anything_is_searched(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(reviewing, "results", None)
    assert run(["report", "PB1-15", "-o", str(tmp_path / "missing" / "x.html")]) == Exit.USAGE
    assert run(["report", "PB1-15", "-o", str(tmp_path)]) == Exit.USAGE
    assert capsys.readouterr().err.count("Choose another --output.") == 2


def test_without_a_file_nothing_is_done(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["report", "PB1-15"]) == Exit.USAGE
    assert "--output" in capsys.readouterr().err


def test_nothing_selected_is_nothing_to_report_on(tmp_path: Path) -> None:
    file = tmp_path / "x.html"
    assert run(["report", "PB1-15", "--system", "obstacles", "-o", str(file)]) == Exit.NOTHING
    assert not file.exists()


def test_after_an_interruption_nothing_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def interrupted(*_: object, **__: object) -> list[Result]:
        raise KeyboardInterrupt

    monkeypatch.setattr(reviewing, "results", interrupted)
    file = tmp_path / "x.html"
    assert run(["report", "PB1-15", "-o", str(file)]) == Exit.INTERRUPTED
    assert not file.exists()
    assert "0 of 1 properties decided; nothing was written" in capsys.readouterr().err


def test_a_repair_that_does_not_fit_an_edited_chart_is_told_on_the_page(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def gone(chart: Chart) -> Chart:
        raise ModelError("Relay has no state Gone.")

    repair = Repair("gone", "Nothing.", ("PB1-15",), charts={"Relay": gone})
    monkeypatch.setattr(of_the_rover, "repairs", lambda: {"gone": repair})
    file = tmp_path / "review.html"
    assert run(["report", "PB1-15", "-o", str(file)]) == Exit.AS_EXPECTED
    said = "does not fit the charts"
    assert f"The repair gone {said}, and is not decided. " in " ".join(capsys.readouterr().err.split())
    section = entry(file.read_text(encoding="utf-8"), "PB1-15")
    assert "not decided" in section and said in section and "Relay has no state Gone." in section


def test_an_interpretation_that_does_not_fit_an_edited_chart_is_told_before_anything_is_searched(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def unfit(name: str) -> System:
        raise ModelError(f"S01=AT-ONCE does not fit {name}.")

    monkeypatch.setattr(reviewing, "results", None)
    monkeypatch.setattr(reviewing, "left_to_read", unfit)
    file = tmp_path / "review.html"
    assert run(["report", "PB1-15", "-o", str(file)]) == Exit.USAGE
    assert "S01=AT-ONCE does not fit relay" in capsys.readouterr().err and not file.exists()


def test_at_once_nothing_is_looked_for_that_is_not_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROVERCHECK_CACHE", str(tmp_path / "cache"))
    monkeypatch.setenv("ROVERCHECK_SECRET", str(tmp_path / "secret"))
    monkeypatch.delenv("ROVERCHECK_STORE", raising=False)
    file = tmp_path / "review.html"

    def page(*options: str) -> str:
        assert run(["report", "PB1-15", "-o", str(file), *options]) == Exit.AS_EXPECTED
        return file.read_text(encoding="utf-8")

    forced = "inputs that determine"
    early = page("--at-once")
    assert "the inputs that force 1 finding, and repairs" in early
    assert "not decided" in entry(early, "PB1-15") and LEFT_OUT in early
    assert LEFT_OUT not in (whole := page()) and "not decided" not in entry(whole, "PB1-15")
    late = page("--at-once")
    assert "Left out" in late and "force 1 finding" not in late and LEFT_OUT not in late
    assert (forced in entry(early, "PB1-15"), forced in entry(late, "PB1-15")) == (False, True)


def test_an_unfinished_search_is_a_finding_and_no_pass(tmp_path: Path) -> None:
    file = tmp_path / "x.html"
    code = run(["report", "PB1-15", "--engine", "bmc", "--depth", "2", "--no-repairs", "-o", str(file)])
    document = file.read_text(encoding="utf-8")
    assert code == Exit.INCONCLUSIVE
    assert "Not as expected" in document
    assert "Expected: <b>violated after 8 ticks</b>" in entry(document, "PB1-15")


def test_of_a_case_that_nobody_reproduced_the_limits_are_not_listed() -> None:
    reason = "reached after 2 ticks on x_free; not reproduced on x: bmc: the time limit of 11.9 s is reached"
    case = Result(catalogue()["PB1-11"], Unknown(reason, 3, "bmc"), "x")
    assert (
        premise_case(case, {}).said
        == "not known: reached after 2 ticks on x_free; not reproduced on x within the limits"
    )
    gave_up = replace(case, verdict=Unknown("gave up", 3, "bmc"))
    assert premise_case(gave_up, {}).said == "not known: gave up"


def test_the_finding_with_the_same_cause_is_followed_to_the_first() -> None:
    said = {"A-1": "", "A-2b": "A-1", "A-3": "A-2b", "A-4": "A-5", "A-5": "A-4"}
    known = {id: Expected("violated", because="So.", same_cause=of) for id, of in said.items()}
    assert [cause(id, known) for id in (*known, "B-1")] == ["A-1", "A-1", "A-1", "A-5", "A-4", "B-1"]


def test_a_model_of_the_user_gets_the_same_page(tmp_path: Path) -> None:
    file, model = tmp_path / "x.html", ROOT / "examples" / "models" / "lift"
    code = run(["report", "--model", str(model), "-o", str(file)])
    document = file.read_text(encoding="utf-8")
    assert code in (Exit.AS_EXPECTED, Exit.FAILED)
    ids = {a.get("id") or "" for _, a in Reader(document).elements}
    assert {"section-summary", "section-requirements", "section-charts", "chart-Drive", "graph-lift"} <= ids
    assert not [id for id in ids if id.startswith(("reading-", "repair-"))]
    assert "B1-" not in document and "rover" not in document.replace("rovercheck", "")


def test_a_chart_is_shown_whole_where_only_a_region_of_it_was_checked() -> None:
    [chart] = drawn([systems()["monitors_2_BLE"]], rover()).values()
    assert len(systems()["monitors_2_BLE"].charts[0].states) < len(chart.states) == 17


def test_ids_are_sorted_by_their_numbers() -> None:
    ids = ["PB1-15", "PB1-2", "PB1-15-b", "REACH", "PB1-2a"]
    assert sorted(ids, key=by_number) == ["PB1-2", "PB1-2a", "PB1-15", "PB1-15-b", "REACH"]


def test_a_property_is_written_part_by_part() -> None:
    prop = replace(catalogue()["PB1-16a"], from_tick=2)
    assert [name for name, _ in written(prop)] == ["that", "from"]
    assert dict(named(prop.form))["Board 1 actuates ="] == "!give_b2_actuation"


def test_the_figures_of_the_covering_tests_add_up() -> None:
    rows = list(coverage())
    assert {(r.board, r.kind) for r in rows} == {
        (b, k) for b in ("board1", "board2") for k in ("transitions", "boundaries", "pairs")
    }
    assert all(r.goals == r.reached + r.unreachable + r.unknown for r in rows)


EMPTY = """
from rovercheck.properties.forms import always
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.expr import flag, implies
from rovercheck.spec_model.lang.system import in_order

button, lamp = flag("button"), flag("lamp")
on = State("On", entry=[assign(lamp, True)], transitions=[to("Off", when=button)])
off = State("Off", entry=[assign(lamp, False)], transitions=[to("On", when=button)])
chart = Chart("Lamp", [off, on], default="Off")
hall = in_order("hall", chart, text="A lamp & a button.")
EMPTY = always("EMPTY", "Nothing.", that=implies(chart.active("On") & ~lamp, button), covers=["R"], on="hall")
FULL = always("FULL", "Something.", that=implies(chart.active("On"), lamp), covers=["R"], on="hall")
"""


def test_a_proof_about_nothing_is_a_finding(tmp_path: Path) -> None:
    model, file = tmp_path / "hall.py", tmp_path / "x.html"
    model.write_text(EMPTY, encoding="utf-8")
    run(["report", "--model", str(model), "-o", str(file)])
    document = file.read_text(encoding="utf-8")
    assert "it NEVER occurs, so the proof is vacuous" in entry(document, "EMPTY")
    assert "it occurs: " in unpacked(document)[inside("FULL")]
    assert 'It never does for <a class="violated" href="#EMPTY">EMPTY</a>.' in document


def on_relay(limits: Limits) -> tuple[list[StateGraphView], dict[str, str]]:
    """The state graphs of two systems, one of them with a finding whose run is of neither."""
    finding = Result(catalogue()["PB1-15"], Violated(changed(long_trace(), variables={}), "bmc"), "relay")
    both = [systems()["relay"], systems()["board1"]]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(reviewing_graphs, "LIMITS", limits)
        graphs, undrawn = state_graphs([CheckedProperty(finding, expected("PB1-15"))], both, " --x")
    return list(graphs), dict(undrawn)


def test_a_state_graph_is_marked_where_a_finding_is_broken() -> None:
    [relay], undrawn = on_relay(Limits(memory=1 << 20))
    assert relay.asked == ("PB1-15",) and relay.unmarked == ()
    [data] = re.findall(r'class="stategraph-data">(.*?)</script>', relay.picture)
    seen = json.loads(data)
    assert seen["runs"] == {}
    marked = [(node["values"][0][1], node["wanted"]) for node in seen["nodes"] if node["wanted"]]
    assert marked == [("B2_actuating", 151)]
    assert relay.again == "rovercheck graph relay --x" and undrawn == {"board1": "12 charts"}


def test_what_is_too_much_for_a_state_graph_is_said() -> None:
    [relay], _ = on_relay(Limits(memory=90_000))
    assert relay.asked == () and relay.unmarked == ("PB1-15",) and "for 154 states" in relay.size
    graphs, undrawn = on_relay(Limits(memory=10_000))
    assert not graphs and undrawn["relay"].startswith("more than ") and "state" in undrawn["relay"]
    _, undrawn = on_relay(Limits(seconds=0.0))
    assert undrawn["relay"] == "the time limit of 0 s is reached"
