# SPDX-License-Identifier: Apache-2.0
"""`agent status` and its socket, without ROS: the answer, who is found, who may ask, what is stale."""

from __future__ import annotations

import copy
import json
import os
import socket
import stat
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from microros_gen.agent.monitoring import asking, sockets
from microros_gen.agent.monitoring.asking import NoAnswerError, ask, ask_status
from microros_gen.agent.monitoring.document import PATH, text_of
from microros_gen.agent.monitoring.serving import StatusSocket, status_routes
from microros_gen.agent.monitoring.shape import fault_of
from microros_gen.agent.monitoring.sockets import SocketError, default_path, known_sockets, listen
from microros_gen.agent.monitoring.status import AgentStatus, StatusBoard
from microros_gen.cli.agent.background import in_background
from microros_gen.cli.agent.status_table import status_table
from microros_gen.cli.main import cli
from microros_gen.diagnostics import UserError
from tests.support.agent.monitored import STATUS, Loop, many, running
from tests.support.patience import deadline, seconds


@contextmanager
def asked_at(path: Path, status: AgentStatus = STATUS) -> Iterator[Loop]:
    with running(status) as loop:
        answering = StatusSocket(path, status_routes(loop.board))
        with in_background("status", answering.run, answering.stop):
            yield loop


@pytest.fixture
def folder(monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder of this user's sockets, and no agents of other users; paths of sockets are short."""
    with tempfile.TemporaryDirectory() as session:
        monkeypatch.setenv("XDG_RUNTIME_DIR", session)
        monkeypatch.delenv("RUNTIME_DIRECTORY", raising=False)
        monkeypatch.setattr(sockets, "LISTED", Path(session) / "no table")
        yield default_path().parent


def status(*arguments: str) -> Result:
    return CliRunner().invoke(cli, ["agent", "status", *arguments], standalone_mode=False)


def reported(result: Result) -> list[tuple[str, str, str | None]]:
    assert isinstance(result.exception, UserError), result.output
    assert result.exception.status == 2
    return [(each.id, each.message, each.hint) for each in result.exception.diagnostics]


def test_the_table_of_the_only_agent(folder: Path) -> None:
    with asked_at(folder / "microros-agent-77.sock"):
        result = status()
    assert result.exception is None
    assert result.output == (
        "agent 77 (microros-gen 1.2.3), up 0:01:30\n"
        "transports: udp4 127.0.0.1:8888, serial /dev/ttyUSB0 (not ready)\n"
        "clients: 1 of at most 256; samples: 900 from clients, 400 to clients; faults of input: 4\n"
        "\n"
        "NAME  KEY       STATE      TRANSPORT             ROUND TRIP  IN                       OUT               "
        " LOST  RESENT  REPEATED  QUEUE  RECONNECTS  LAST WARNING\n"
        "/arm  A1B2C3D4  connected  udp4 127.0.0.1:40312  1.5 ms      100/s 6.4 kB/s, 64.0 kB  0/s 0 B/s, 8.0 kB"
        "  2     3       4         50%    2           late\n"
    )


def test_the_json(folder: Path) -> None:
    with asked_at(folder / "microros-agent-77.sock"):
        document = json.loads(status("--format", "json").output)
    assert document["version"] == 1
    assert document["agent"]["transports"][1] == {"kind": "serial", "address": "/dev/ttyUSB0", "ready": False}
    (client,) = document["clients"]
    assert client == {
        "name": "/arm",
        "key": "A1B2C3D4",
        "state": "connected",
        "transport": "udp4 127.0.0.1:8888",
        "address": "127.0.0.1:40312",
        "nodes": ["/arm"],
        "silent_s": 0.25,
        "round_trip_s": 0.0015,
        "received": {"messages": 1000, "bytes": 64000, "messages_per_s": 100.0, "bytes_per_s": 6400.0},
        "sent": {"messages": 500, "bytes": 8000, "messages_per_s": 0.0, "bytes_per_s": 0.0},
        "lost": 2,
        "resent": 3,
        "repeated": 4,
        "queue": {"fill": 0.5, "messages": 8, "bytes": 512, "input_bytes": 100},
        "sessions": 3,
        "reconnects": 2,
        "silences": 1,
        "denied": 0,
        "last_error": "late",
        "worker": None,
    }
    assert document["agent"]["workers"] == []


def test_a_thousand_clients_are_bounded_in_time_and_size(tmp_path: Path) -> None:
    """Neither the size of an answer nor its time grows more than the number of clients; many askers share one."""
    size = len(text_of(many(1000)))
    assert size < 1000 * 1000
    began = time.process_time()
    text_of(many(1000))
    assert time.process_time() - began < 1.0  # 25 ms on an idle machine
    answers: list[int] = []
    with asked_at(tmp_path / "s", many(1000)) as loop:
        askers = [
            threading.Thread(target=lambda: answers.append(len(ask_status(tmp_path / "s", PATH)["clients"])))
            for _ in range(20)
        ]
        for asker in askers:
            asker.start()
        for asker in askers:
            asker.join(seconds(30))
        assert answers == [1000] * 20
        assert loop.taken < 20


def test_only_this_user_may_ask(folder: Path) -> None:
    path = folder / "microros-agent-77.sock"
    before = os.umask(0)
    try:
        with asked_at(path):
            assert stat.S_IMODE(path.stat().st_mode) == 0o600
            assert stat.S_IMODE(folder.stat().st_mode) == 0o700
    finally:
        os.umask(before)
    assert not path.exists()


def test_an_agent_of_another_user(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: Any) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(asking, "ask_status", refuse)
    with asked_at(folder / "microros-agent-77.sock"):
        ((name, message, hint),) = reported(status())
    assert name == "MG-9790"
    assert message.endswith("microros-agent-77.sock belongs to user root") or os.getuid() != 0
    assert hint is not None
    assert hint.startswith("sudo -u ")


@pytest.mark.skipif(os.getuid() != 0, reason="only root can be another user")
def test_another_user_finds_the_agent_and_is_refused(tmp_path: Path) -> None:
    for parent in (tmp_path, *tmp_path.parents[:2]):
        parent.chmod(0o755)
    path = tmp_path / "microros-agent-77.sock"
    code = (
        "import os, sys; from microros_gen.agent.monitoring.asking import ask\n"
        "from pathlib import Path\n"
        "os.setgid(65534); os.setuid(65534)\n"
        "try:\n  ask(Path(sys.argv[1]), '/status.json')\n"
        "except PermissionError: print('refused')"
    )
    with asked_at(path):
        run = subprocess.run(
            [sys.executable, "-c", code, str(path)], capture_output=True, text=True, check=False
        )
    assert run.stdout == "refused\n", run.stderr


def test_sockets_of_all_users_are_found_where_this_one_has_none(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    table = folder / "table"
    table.write_text(
        "Num       RefCount Protocol Flags    Type St Inode Path\n"
        "0000: 00000002 00000000 00010000 0001 01 100 /run/microros-agent/microros-agent-5.sock\n"
        "0000: 00000002 00000000 00010000 0001 01 101 @/tmp/other\n"
        "0000: 00000003 00000000 00000000 0001 03 102\n"
    )
    monkeypatch.setattr(sockets, "LISTED", table)
    service = Path("/run/microros-agent/microros-agent-5.sock")
    assert known_sockets() == [service]
    assert known_sockets(pid=6) == []
    with asked_at(folder / "microros-agent-77.sock"):
        assert known_sockets() == [folder / "microros-agent-77.sock"]
        assert known_sockets(pid=5) == [service]


def test_of_several_agents_one_is_chosen(folder: Path) -> None:
    with asked_at(folder / "microros-agent-77.sock"), asked_at(folder / "microros-agent-1234.sock"):
        assert reported(status()) == [("MG-9784", "several agents run: 77, 1234", "Choose one: --pid 77")]
        assert "agent 77 " in status("--pid", "1234").output
        assert "agent 77 " in status("--socket", str(folder / "microros-agent-77.sock")).output
        assert reported(status("--pid", "5"))[0][:2] == (
            "MG-9785",
            "process 5 is no agent with a status socket",
        )


def test_no_agent(folder: Path) -> None:
    assert reported(status())[0][:2] == ("MG-9783", "no agent with a status socket runs")
    ((name, message, _),) = reported(status("--socket", str(folder / "s")))
    assert (name, message) == ("MG-9787", f"no agent listens at {folder / 's'}: No such file or directory")


def test_a_stale_socket_is_no_agent_and_is_removed(folder: Path) -> None:
    stale, other = folder / "microros-agent-999999.sock", folder / "microros-agent-1.txt"
    listen(stale).close()
    other.touch()
    assert reported(status())[0][0] == "MG-9783"
    assert not stale.exists()
    listen(stale).close()
    default_path()
    assert sorted(folder.iterdir()) == [other]


def test_a_running_agent_keeps_its_socket(folder: Path) -> None:
    path = folder / "microros-agent-999999.sock"
    with asked_at(path):
        default_path()
        assert status("--pid", "999999").exception is None
        with pytest.raises(SocketError, match="another process listens there"):
            listen(path)
    assert not path.exists()


def test_a_socket_that_was_replaced_is_left_to_its_new_owner(folder: Path) -> None:
    path = folder / "s"
    with asked_at(path):
        path.unlink()
        listen(path).close()
    assert path.exists()


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("x" * 108, "the path has more than 107 bytes"),
        ("missing/s", "No such file or directory"),
        ("file", "another file has this name"),
    ],
)
def test_places_without_a_socket(
    name: str, reason: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("file").touch()
    with pytest.raises(SocketError, match=reason):
        listen(Path(name))
    assert Path("file").exists()


def test_folders(tmp_path: Path) -> None:
    assert sockets.own_folder({"RUNTIME_DIRECTORY": "/run/a:/run/b", "XDG_RUNTIME_DIR": "/"}) == Path(
        "/run/a"
    )
    assert sockets.own_folder({"XDG_RUNTIME_DIR": str(tmp_path)}) == tmp_path / "microros-gen"
    assert sockets.own_folder({"XDG_RUNTIME_DIR": "/missing"}) == Path(f"/tmp/microros-gen-{os.getuid()}")
    (tmp_path / "microros-gen").symlink_to("/")
    with pytest.raises(SocketError, match="belongs to another user"):
        default_path({"XDG_RUNTIME_DIR": str(tmp_path)})


def test_an_agent_that_does_not_respond(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("microros_gen.agent.monitoring.status.StatusBoard.ask.__defaults__", (0.05,))
    with asked_at(folder / "s") as loop:
        loop.runs.clear()
        assert reported(status("--socket", str(folder / "s"))) == [
            (
                "MG-9786",
                f"the agent at {folder / 's'} does not answer: the agent does not respond",
                "Look into the log of the agent",
            )
        ]
        loop.runs.set()
        assert status("--socket", str(folder / "s")).exception is None


def test_another_version_of_the_protocol(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("microros_gen.agent.monitoring.document.VERSION", 2)
    monkeypatch.setattr(asking, "ask_status", lambda *_: {"version": 3})
    ((name, message, _),) = reported(status("--socket", "s"))
    assert (name, message) == ("MG-9789", "the agent at s speaks version 3 of the protocol, not 2")


@pytest.mark.parametrize("answer", [b"", b"nonsense\r\n\r\n", b"HTTP/1.0 200 OK\r\n\r\n[1]"])
def test_what_is_no_agent(tmp_path: Path, answer: bytes) -> None:
    path = tmp_path / "s"
    listener = listen(path)

    def speak() -> None:
        connection, _ = listener.accept()
        connection.recv(1000)
        connection.sendall(answer)
        connection.close()

    thread = threading.Thread(target=speak)
    thread.start()
    with pytest.raises(NoAnswerError):
        ask_status(path, PATH)
    thread.join()
    with pytest.raises(NoAnswerError, match=r"no answer within 0\.1 s"):
        ask(path, PATH, 0.1)
    listener.close()


@contextmanager
def foreign(path: Path, speak: Callable[[socket.socket], object]) -> Iterator[None]:
    """Let another program than an agent answer the first question at a socket, until nobody listens to it."""
    listener = listen(path)

    def answer() -> None:
        connection, _ = listener.accept()
        with connection, suppress(OSError):
            connection.recv(1000)
            speak(connection)

    thread = threading.Thread(target=answer)
    thread.start()
    try:
        yield
    finally:
        thread.join()
        listener.close()


def endless(connection: socket.socket) -> None:
    connection.sendall(b"HTTP/1.0 200 OK\r\n\r\n")
    while True:
        connection.sendall(b"[" * 65_536)


def slow(connection: socket.socket) -> None:
    connection.sendall(b"HTTP/1.0 200 OK\r\nX: ")
    while True:
        connection.sendall(b"x")
        time.sleep(0.02)


def continued(connection: socket.socket) -> None:
    while True:
        connection.sendall(b"HTTP/1.1 100 Continue\r\n\r\n" * 1000)


def test_an_answer_without_end_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(asking, "LARGEST_BYTES", 1 << 20)
    with foreign(tmp_path / "s", endless), pytest.raises(NoAnswerError, match="more than 1 MiB"):
        ask_status(tmp_path / "s", PATH)


@pytest.mark.parametrize("speak", [slow, continued])
def test_an_answer_that_takes_too_long_is_refused(
    tmp_path: Path, speak: Callable[[socket.socket], object]
) -> None:
    """Each part comes in time, the whole answer never."""
    with foreign(tmp_path / "s", speak), pytest.raises(NoAnswerError, match=r"no answer within 0\.5 s"):
        ask_status(tmp_path / "s", PATH, 0.5)


def places(value: Any, place: tuple[str | int, ...] = ()) -> Iterator[tuple[str | int, ...]]:
    """Yield the place of each value in a document."""
    inner = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, part in inner:
        yield (*place, key)
        yield from places(part, (*place, key))


def test_an_answer_that_lacks_a_key_or_has_another_value(folder: Path, tmp_path: Path) -> None:
    """Each value of a real answer is removed and replaced in turn: the command says what is wrong."""
    with asked_at(tmp_path / "real"):
        document = ask_status(tmp_path / "real", PATH)
    assert document["clients"]
    assert fault_of(document) == ""
    found = list(places(document))
    assert len(found) > 40
    others: tuple[Any, ...] = (None, "1e999", {}, [None], 1 << 90, float("inf"), True)
    for place in found:
        for wrong in others:
            broken = copy.deepcopy(document)
            holder: Any = broken
            for step in place[:-1]:
                holder = holder[step]
            before, holder[place[-1]] = holder[place[-1]], wrong
            if not fault_of(broken):
                assert type(wrong) is type(before) or wrong is None or wrong == {}, place
                status_table(broken)
        if isinstance(place[-1], str) and place[:-1] != ("agent", "faults"):
            holder.pop(place[-1])
            assert fault_of(broken).startswith("it lacks "), place


@pytest.mark.parametrize(
    ("document", "fault"),
    [
        (b'{"version": 1}', "the answer is no status: it lacks agent"),
        (b'{"version": 1, "agent": [], "clients": []}', "the answer is no status: agent is no object"),
        (b'{"version": true}', "the answer is no status"),
        (b"[" * 100_000, "the answer is no status"),
        (b'{"version": 1, "agent": 1e999, "clients": {}}', "the answer is no status: agent is no object"),
    ],
)
def test_an_answer_of_another_program_is_a_diagnostic(
    folder: Path, tmp_path: Path, document: bytes, fault: str
) -> None:
    path = tmp_path / "s"
    with foreign(path, lambda c: c.sendall(b"HTTP/1.0 200 OK\r\n\r\n" + document)):
        ((name, message, _),) = reported(status("--socket", str(path)))
    assert (name, message) == ("MG-9786", f"the agent at {path} does not answer: {fault}")


def test_a_silent_asker_delays_no_other(tmp_path: Path) -> None:
    path = tmp_path / "s"
    with asked_at(path), socket.socket(socket.AF_UNIX) as silent:
        silent.connect(str(path))
        assert ask(path, "/other")[0] == 404
        assert ask_status(path, PATH)["agent"]["pid"] == 77


def test_checks_of_health_and_readiness(folder: Path) -> None:
    path = folder / "microros-agent-77.sock"
    with asked_at(path):
        assert ask(path, "/healthz") == (200, b"ok\n")
        assert ask(path, "/readyz") == (503, b"serial /dev/ttyUSB0 is not ready\n")
        assert checked() == (1, "serial /dev/ttyUSB0 is not ready\n")
    with asked_at(path, replace(STATUS, transports=STATUS.transports[:1])):
        assert ask(path, "/readyz") == (200, b"ok\n")
        assert checked() == (0, "ok\n")
    assert reported(status("--check"))[0][0] == "MG-9783"
    assert "not both" in str(status("--check", "--watch").exception)


def test_an_agent_that_does_not_respond_is_not_healthy(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("microros_gen.agent.monitoring.status.StatusBoard.ask.__defaults__", (0.05,))
    with asked_at(folder / "s") as loop:
        loop.runs.clear()
        for question in ("/healthz", "/readyz", PATH):
            assert ask(folder / "s", question) == (503, b"the agent does not respond\n")


def checked() -> tuple[int, str]:
    result = CliRunner().invoke(cli, ["agent", "status", "--check"])
    return result.exit_code, result.output


def test_options_that_exclude_each_other() -> None:
    assert "not both" in str(status("--socket", "s", "--pid", "1").exception)
    for arguments in (
        ["agent", "udp4", "status"],
        ["agent", "status", "udp4"],
        ["agent", "--domain", "1", "status"],
    ):
        result = CliRunner().invoke(cli, arguments)
        assert result.exit_code == 2
        assert "'status' asks a running agent" in result.output or "unexpected" in result.output.lower()


def test_it_is_shown_again_until_a_signal(folder: Path) -> None:
    with asked_at(folder / "microros-agent-77.sock"):
        process = subprocess.Popen(
            [*(sys.executable, "-m", "microros_gen", "agent", "status"), "--watch", "--format", "json"],
            stdout=subprocess.PIPE,
            text=True,
        )
        assert process.stdout is not None
        lines = [json.loads(process.stdout.readline()) for _ in range(2)]
        process.send_signal(2)
        assert process.wait(seconds(10)) == 0
    assert [line["agent"]["pid"] for line in lines] == [77, 77]


def test_a_question_is_answered_from_a_status_that_is_younger() -> None:
    now = [10.0]
    taken: list[float] = []

    def take() -> AgentStatus:
        taken.append(now[0])
        return STATUS

    board = StatusBoard(take, lambda: now[0])
    board.look(0)
    assert taken == []
    assert board.ask(0.0) is None
    board.look(0)
    now[0] += 0.2
    assert board.ask(0.0) is STATUS
    now[0] += 0.1
    assert board.ask(0.0) is None
    assert taken == [10.0]


def test_the_thread_ends_at_once_without_a_question(tmp_path: Path) -> None:
    end = deadline(5)
    with asked_at(tmp_path / "s"):
        pass
    assert time.monotonic() < end


def test_an_answer_without_a_length_that_does_not_end(tmp_path: Path) -> None:
    def drip(connection: socket.socket) -> None:
        connection.sendall(b"HTTP/1.0 200 OK\r\n\r\n")
        while True:  # until the asker closes the connection
            connection.sendall(b" ")
            time.sleep(0.02)

    began = time.monotonic()
    with foreign(tmp_path / "s", drip), pytest.raises(NoAnswerError):
        ask(tmp_path / "s", PATH, 0.2)
    assert time.monotonic() - began < seconds(10)
