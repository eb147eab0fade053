"""The server of the live page: who is let in, what bad requests come to, and that nothing saved is lost."""

import http.client
import json
import shutil
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from time import sleep
from urllib.parse import urlsplit

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.serve import server as page_server
from rovercheck.checker.commands.serve import workspace as keeping
from rovercheck.checker.commands.serve.api import Api
from rovercheck.checker.commands.shared.codes import Exit
from tests.cli.terminal import Terminal
from tests.serving import LAMP, PATIENCE, Served, eventually, serving_model

COMMAND = [sys.executable, "-m", "rovercheck", "serve"]


@pytest.fixture
def served(tmp_path: Path) -> Iterator[Served]:
    with serving_model(tmp_path / "model") as one:
        yield one


# --- who is let in --------------------------------------------------------------------------------------


def test_the_page_is_there_for_who_knows_its_token(served: Served) -> None:
    status, headers, body = served.send("GET", "/a-token/")
    assert status == 200 and "<title>rovercheck</title>" in body
    assert "connect-src &#39;self&#39;" in body and "http://" not in body
    assert headers["Referrer-Policy"] == "no-referrer" and headers["Cache-Control"] == "no-store"
    assert headers["X-Frame-Options"] == "DENY"


@pytest.mark.parametrize("path", ["/", "/other/", "/a-toke/", "/a-tokenn/", "/%00/", "/a-token%2F"])
def test_without_the_token_nothing_is_told(served: Served, path: str) -> None:
    status, _, body = served.send("GET", path)
    assert status == 403 and "token in this address is not valid" in body


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:80", "127.0.0.1.evil.example", "", "[::1", "a b"]
)
def test_another_name_of_the_machine_is_refused(served: Served, host: str) -> None:
    status, _, body = served.send("GET", "/a-token/", Host=host)
    assert status == 421 and "This server is not called" in body


@pytest.mark.parametrize("host", ["127.0.0.1:1", "localhost:1", "LOCALHOST", "[::1]:5"])
def test_its_own_names_are_fine(served: Served, host: str) -> None:
    assert served.send("GET", "/a-token/", Host=host)[0] == 200


def test_a_page_of_another_origin_may_not_ask(served: Served) -> None:
    status, told = served.post("overview", {}, Origin="http://evil.example")
    assert status == 403 and told["error"] == "Only the page itself may ask for this."
    path = "/a-token/api/overview"
    assert served.send("POST", path, "{}", Content_Type="text/plain")[0] == 403, "as a form could"
    own = f"127.0.0.1:{served.server.server_port}"
    assert served.post("overview", {}, Origin=f"http://{own}", Host=own)[0] == 200


@pytest.mark.parametrize("path", ["x", "../etc/passwd", "api/overview", "trace/x", "api/"])
def test_there_is_nothing_else_to_get(served: Served, path: str) -> None:
    assert served.send("GET", f"/a-token/{path}")[0] == 404


# --- requests without meaning ---------------------------------------------------------------------------


@pytest.mark.parametrize("body", [b"", b"[]", b"1", b"{", b"\xff\xfe", b"[" * 100_000])
def test_what_is_no_json_object_is_said_to_be_none(served: Served, body: bytes) -> None:
    path = "/a-token/api/open"
    status, _, said = served.send("POST", path, body, Content_Type="application/json")
    assert status == 400 and "error" in json.loads(said)


@pytest.mark.parametrize("length", ["-1", "x", "99999999"])
def test_a_length_that_cannot_be_is_refused(served: Served, length: str) -> None:
    path = "/a-token/api/open"
    sent = {"Content_Type": "application/json", "Content_Length": length}
    assert served.send("POST", path, None, **sent)[0] == 400


@pytest.mark.parametrize(
    "name", ["nothing", "__init__", "call", "workspace", "job_document", "do_open", "open/x"]
)
def test_only_what_is_a_request_can_be_asked(served: Served, name: str) -> None:
    assert served.post(name, {})[0] == 404


@pytest.mark.parametrize(
    ("name", "given", "said"),
    [
        ("open", {}, "The request has no name."),
        ("open", {"name": 7}, "The request has no name."),
        ("open", {"name": "Lamb"}, "no system and no chart 'Lamb'"),
        ("state", {"session": "x"}, "This session is over"),
        ("load", {"property": "LAMP-1"}, "LAMP-1 was not decided here"),
        ("decide", {"property": "LAMP-2"}, "LAMP-1"),
        ("job", {"job": "x"}, "There is no such search any more."),
        ("cancel", {"job": "x"}, "There is no such search any more."),
    ],
)
def test_a_request_without_meaning_is_told_why(served: Served, name: str, given: object, said: str) -> None:
    status, told = served.post(name, given)
    assert status == 400 and said in told["error"]


@pytest.mark.parametrize(
    ("name", "given", "said"),
    [
        ("take", {"keys": []}, "names no step"),
        ("take", {"keys": "x"}, "has no list keys"),
        ("take", {"keys": ["Lamp:99"]}, "cannot happen together"),
        ("step", {"ticks": "3"}, "has no number ticks"),
        ("step", {"ticks": -3}, "has no number ticks"),
        ("goto", {"tick": 5}, "There is no tick 5"),
        ("set", {"name": "lamp", "value": "1"}, "There is no input 'lamp'"),
        ("set", {"name": "switch", "value": "2"}, "switch is a boolean"),
        ("break", {"condition": "switch +"}, "is no condition"),
        ("break", {"condition": "__import__('os')"}, "has no meaning in a condition"),
        ("reach", {"condition": "nowhere"}, "There is no variable or state 'nowhere'"),
        ("until", {"condition": " "}, "has no condition"),
        ("unbreak", {"number": 0}, "no such break"),
    ],
)
def test_a_session_says_what_is_wrong_and_stays_as_it_was(
    served: Served, name: str, given: dict[str, object], said: str
) -> None:
    session = served.ask("open", name="Lamp")["session"]
    before = served.ask("step", session=session, ticks=2)
    assert said in served.refused(name, session=session, **given)
    after = served.ask("state", session=session)
    assert (after["tick"], after["ticks"], after["active"]) == (2, 2, before["active"])


# --- exploring ------------------------------------------------------------------------------------------


def test_steps_are_listed_and_taken(served: Served) -> None:
    told = served.ask("open", name="Lamp")
    told = served.ask("step", session=told["session"], ticks=1)
    [rise] = [s for s in told["next"]["steps"] if s["moves"]]
    assert (rise["title"], rise["by"]) == ("Lamp: Off → On", ["switch = true"])
    assert rise["transitions"][0]["drawn"] == ["Off#1"]
    told = served.ask("take", session=told["session"], keys=[rise["key"]])
    assert told["active"] == {"Lamp": ["On"]} and told["tick"] == 2
    told = served.ask("goto", session=told["session"], tick=1)
    assert told["active"] == {"Lamp": ["Off"]} and (told["tick"], told["ticks"]) == (1, 2)
    told = served.ask("step", session=told["session"], ticks=1)
    assert told["said"] == ["A new branch: 1 tick after tick 1 forgotten."]


def test_a_run_to_a_condition_is_found_by_an_engine(served: Served) -> None:
    session = served.ask("open", name="Lamp")["session"]
    job = served.done(served.ask("reach", session=session, condition="Lamp.On"))
    assert job["state"] == "done" and "Reached in 2 ticks by a run that explicit found" in job["answer"]
    assert job["session"]["active"] == {"Lamp": ["On"]}
    job = served.done(served.ask("reach", session=session, condition="Lamp.On and Lamp.Off"))
    assert job["answer"].startswith("Never, from tick 2 on: ") and "no certificate" in job["answer"]


def test_until_and_breaks_run_with_the_inputs_as_they_stand(served: Served) -> None:
    session = served.ask("open", name="Lamp")["session"]
    served.ask("set", session=session, name="switch", value="true")
    assert served.ask("break", session=session, condition="Lamp.On")["breaks"] == ["Lamp.On"]
    assert served.ask("step", session=session, ticks=50)["said"] == ["Tick 2: break: Lamp.On"]
    job = served.done(served.ask("until", session=session, condition="Lamp.Off"))
    assert job["answer"] == "True after tick 52." and job["session"]["tick"] == 52


def test_a_verdict_is_decided_here_and_its_run_explored(served: Served) -> None:
    [before] = served.ask("overview")["properties"]
    assert (before["expected"], before["decided"], before["charts"]) == ("proved", "", ["Lamp"])
    job = served.done(served.ask("decide", property="LAMP-1"))
    assert job["verdict"]["decided"] == "violated" and job["verdict"]["has_run"]
    told = served.ask("load", property="LAMP-1")
    assert told["active"] == {"Lamp": ["On"]} and "The run of LAMP-1 is loaded" in told["said"][0]
    status, _, body = served.send("GET", "/a-token/trace?property=LAMP-1")
    assert status == 200 and "LAMP-1: counterexample" in body
    assert served.send("GET", "/a-token/trace?property=LAMP-9")[0] == 400


def test_old_sessions_go_and_say_so(served: Served, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(keeping, "MOST_SESSIONS", 2)
    first, second, _ = (served.ask("open", name="Lamp")["session"] for _ in range(3))
    assert "This session is over" in served.refused("state", session=first)
    assert served.ask("state", session=second)["tick"] == 0


def test_searches_end_with_the_last_page(served: Served, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(page_server, "GONE", 0.05)
    monkeypatch.setattr(page_server, "BEAT", 0.05)
    listener = socket.create_connection(("127.0.0.1", served.server.server_port))
    listener.sendall(b"GET /a-token/news HTTP/1.1\r\nHost: localhost\r\n\r\n")
    assert b"200" in listener.recv(1000)

    def endless():
        while True:
            sleep(0.02)
            yield "searching"

    job = served.server.api.jobs.start("endless", endless())
    listener.close()
    eventually(lambda: job.state == "cancelled")


def test_a_bug_in_a_request_is_told_and_the_server_goes_on(
    served: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*_: object) -> None:
        raise AssertionError("a fault on purpose")

    session = served.ask("open", name="Lamp")["session"]
    with monkeypatch.context() as patch:
        patch.setattr(Api, "do_step", broken)
        status, told = served.post("step", {"session": session, "ticks": 1})
    assert status == 500 and "This is a bug of rovercheck" in told["error"]
    assert served.ask("step", session=session, ticks=1)["tick"] == 1


# --- the model is saved ---------------------------------------------------------------------------------


def test_a_saved_model_is_seen_and_the_run_executed_again(served: Served) -> None:
    session = served.ask("open", name="Lamp")["session"]
    served.ask("set", session=session, name="switch", value="true")
    served.ask("step", session=session, ticks=3)
    served.save(LAMP.replace('to("On", when=switch)', 'to("On", when=~switch)'))
    eventually(lambda: served.version() == 2)
    told = served.ask("state", session=session)
    assert told["said"] == ["The model was saved: 3 ticks are executed again on it."]
    assert (told["tick"], told["version"], told["active"]) == (3, 2, {"Lamp": ["Off"]})


def test_half_a_file_is_one_message_and_nothing_is_lost(served: Served) -> None:
    session = served.ask("open", name="Lamp")["session"]
    served.ask("step", session=session, ticks=2)
    served.save(LAMP[: len(LAMP) // 2])
    eventually(lambda: served.problem() != "")
    assert "lamp.py:" in served.problem() and "not Python" in served.problem()
    assert served.ask("step", session=session, ticks=1)["tick"] == 3, "the model before it is still there"
    served.save(LAMP)
    eventually(lambda: served.problem() == "")
    assert served.ask("state", session=session)["tick"] == 3


def test_a_run_that_the_saved_model_does_not_have_ends_where_it_must(served: Served) -> None:
    session = served.ask("open", name="Lamp")["session"]
    served.ask("step", session=session, ticks=2)
    served.save(LAMP.replace("switch", "button"))
    eventually(lambda: served.version() == 2)
    assert served.ask("state", session=session)["tick"] == 2, "inputs that are gone are left out"
    served.save(LAMP.replace('"Lamp"', '"Light"'))
    eventually(lambda: served.version() == 3)
    told = served.ask("state", session=session)
    assert "no system and no chart 'Lamp' any more" in told["said"][0] and told["tick"] == 2


def test_a_folder_that_vanishes_is_said_and_seen_when_it_is_back(served: Served) -> None:
    session = served.ask("open", name="Lamp")["session"]
    aside = served.file.parent.with_name("aside")
    shutil.move(served.file.parent, aside)
    eventually(lambda: "is gone" in served.problem())
    assert served.ask("step", session=session, ticks=1)["tick"] == 1
    shutil.move(aside, served.file.parent)
    eventually(lambda: served.problem() == "" and served.version() >= 2)
    before = served.version()
    served.save(LAMP + "\n# saved\n")
    eventually(lambda: served.version() > before)


# --- the command ----------------------------------------------------------------------------------------


def test_a_port_in_use_is_one_message(capsys: pytest.CaptureFixture[str]) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        assert run(["serve", "--port", str(port)]) is Exit.USAGE
    said = " ".join(capsys.readouterr().err.split())
    assert f"Port {port} of 127.0.0.1 is in use" in said and "--port 0" in said


@pytest.mark.parametrize("host", ["no.such.host.invalid", "203.0.113.7", "a b"])
def test_an_address_that_is_none_of_this_machine(host: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["serve", "--port", "0", "--host", host]) is Exit.USAGE
    assert f"--host {host}" in " ".join(capsys.readouterr().err.split())


def test_a_model_that_cannot_be_read_at_first(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "half.py"
    file.write_text("from rovercheck import (", encoding="utf-8")
    assert run(["serve", "--model", str(file)]) is Exit.USAGE
    assert "half.py:1" in "".join(capsys.readouterr().err.split("\n"))


def test_ctrl_c_ends_it(tmp_path: Path) -> None:
    file = tmp_path / "lamp.py"
    file.write_text(LAMP, encoding="utf-8")
    with Terminal([*COMMAND, "--port", "0", "--model", str(file)], columns=140) as terminal:
        terminal.until("The page is at http://127.0.0.1:")
        terminal.until("Ctrl-C ends it.")
        terminal.type("\x03")
        assert terminal.ended() == Exit.AS_EXPECTED


def test_for_others_it_warns_and_a_request_to_end_is_obeyed(tmp_path: Path) -> None:
    file = tmp_path / "lamp.py"
    file.write_text(LAMP, encoding="utf-8")
    command = [*COMMAND, "--port", "0", "--host", "0.0.0.0", "--model", str(file)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None and process.stderr is not None
        address = process.stdout.readline().split()[-1]
        port = urlsplit(address).port
        assert port is not None
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=PATIENCE)
        connection.request("GET", urlsplit(address).path)
        assert connection.getresponse().status == 200
        connection.close()
        process.terminate()
        assert "Whoever can reach 0.0.0.0" in process.stderr.read()
        assert process.wait(PATIENCE) == Exit.AS_EXPECTED
