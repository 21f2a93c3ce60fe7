# SPDX-License-Identifier: Apache-2.0
"""Command lines of micro_ros_agent: each option and its effect."""

from __future__ import annotations

import io
import os
import re
import termios
import time
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from microros_gen.agent.configuration.model import SocketChoice
from microros_gen.agent.log import EventLog, Level
from microros_gen.cli.agent.command import command
from microros_gen.cli.agent.compatible import translated
from microros_gen.cli.agent.options import AgentOptions
from microros_gen.diagnostics import UserError
from tests.support.agent import captured
from tests.support.agent.cable import Cable
from tests.support.agent.client import XrceClient
from tests.support.agent.command import DOMAIN, run
from tests.support.agent.process import READY, running_agent
from tests.support.agent.serial_link import SerialLink
from tests.support.e2e.can_bus import CanBus, record
from tests.support.free_ports import free_port
from tests.support.paths import ROOT
from tests.support.patience import deadline

REFERENCES = ROOT / "tests/agent/dialogues/references.xml"


@pytest.mark.parametrize(
    ("words", "wanted"),
    [
        ("udp4 -p 8888 -v6", "udp4 -p 8888 --verbosity=6"),
        ("udp4 --port 8888 -v 4", "udp4 --port 8888 --verbosity=4"),
        ("udp4 --verbose 5 --verbose=3", "udp4 --verbosity=5 --verbosity=3"),
        ("udp4 -v", "udp4 -v"),
        ("-vv udp4 -p8888", "-vv udp4 -p8888"),
        ("-v udp4 -d", "-v udp4 --discovery"),
        ("udp4 -d 7401 --discovery 7402", "udp4 --discovery-port=7401 --discovery-port=7402"),
        ("udp4 -d7403 --discovery=7404", "udp4 --discovery-port=7403 --discovery-port=7404"),
        ("udp4 --discovery -v", "udp4 --discovery -v"),
        ("udp4 -m dds -p 1", "udp4 -p 1"),
        ("udp4 --middleware rtps", "udp4"),
        ("udp4 -mdds", "udp4"),
        ("serial --dev /dev/a -b 9600", "serial --dev /dev/a -b 9600"),
    ],
)
def test_words(words: str, wanted: str) -> None:
    assert translated(words.split()) == wanted.split()


@given(
    st.lists(st.sampled_from(("udp4", "--port", "1", "--bind", "::", "-vv", "--manifest", "m", "--domain")))
)
def test_words_of_this_agent_stay(words: list[str]) -> None:
    assert translated(words) == words


@pytest.mark.parametrize(
    ("words", "named"),
    [
        ("udp4 -m ced", "-m ced"),
        ("udp4 --middleware=ced", "--middleware=ced"),
        ("udp4 -P 8889", "-P"),
        ("udp4 --p2p 8889", "--p2p"),
        ("canfd -D can0 -I 0x01", "-I"),
        ("canfd -D can0 --id=1", "--id=1"),
    ],
)
def test_what_it_cannot_do_is_refused_by_name(words: str, named: str) -> None:
    with pytest.raises(UserError) as caught:
        translated(words.split())
    (diagnostic,) = caught.value.diagnostics
    assert diagnostic.message.startswith(f"{named} of micro_ros_agent has no counterpart")
    assert (diagnostic.id, bool(diagnostic.hint)) == ("MG-9794", True)


def test_ros_arguments_are_named(capsys: pytest.CaptureFixture[str]) -> None:
    """As `ros2 launch` adds them for a node with a name."""
    words = ["udp4", "-p", "1", "--ros-args", "-r", "__node:=agent", "--", "-v4"]
    assert translated(words) == ["udp4", "-p", "1", "--verbosity=4"]
    assert translated(words[:6]) == ["udp4", "-p", "1"]
    shown = capsys.readouterr().err
    assert "warning: --ros-args -r __node:=agent -- is ignored" in shown
    assert shown.count("[MG-9795]") == 2


@pytest.mark.parametrize("words", [["udp4", "--ros-args"], ["--ros-args", "--", "udp4"]])
def test_no_ros_arguments_are_no_mistake(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    """`ros2 launch` adds the word for each node."""
    assert translated(words) == ["udp4"]
    assert capsys.readouterr().err == ""


def test_a_refused_option_ends_the_command() -> None:
    done = run("udp4", "-p", "0", "-P", "8889")
    assert (done.returncode, "[MG-9794]" in done.stderr) == (2, True)


@pytest.mark.parametrize("words", [("serial",), ("multiserial",), ("multiserial", "-b", "9600")])
def test_a_serial_transport_without_a_device(words: tuple[str, ...]) -> None:
    done = run(*words)
    assert done.returncode == 2
    assert "no serial device: give -D PATH, or -f FILE" in done.stderr


def test_a_file_of_devices_that_is_missing() -> None:
    done = run("multiserial", "-f", "/missing/devices.txt")
    assert (done.returncode, "[MG-9703]" in done.stderr) == (2, True)


@pytest.mark.builds
@pytest.mark.ros
@pytest.mark.system
@pytest.mark.parametrize(("level", "shown"), [(0, ""), (5, "IM"), (6, "IMB")])
def test_verbosity(level: int, shown: str) -> None:
    """Info, a line for each message, its bytes."""
    with running_agent(DOMAIN, f"-v{level}") as agent, XrceClient(agent.port) as client:
        assert client.connect() == 0
        assert client.leave() == 0
        assert agent.stop() == 0
        log = "\n".join(agent.rest())
        marks = {"I": "limits: ", "M": "CREATE_CLIENT", "B": "  0000  80 00"}
        assert "".join(mark for mark, text in marks.items() if text in log) == shown


@pytest.mark.builds
@pytest.mark.ros
@pytest.mark.system
def test_port_references_and_discovery() -> None:
    port, group = free_port(), free_port()
    options = ("-p", str(port), "-r", str(REFERENCES), "-d", str(group), "-v4")
    with running_agent(DOMAIN, transport=("udp4", *options)) as agent, XrceClient(port) as client:
        assert agent.wait_for(READY).endswith(f":{group}")
        assert client.connect() == 0
        assert client.create(0x0011, 1, b"peer_participant") in (0, 1)
        assert client.create(0x0021, 1, b"no_such_participant") == 0x80


@pytest.mark.builds
@pytest.mark.ros
@pytest.mark.system
@pytest.mark.parametrize("from_file", [False, True])
def test_several_serial_lines(tmp_path: Path, from_file: bool) -> None:
    cables = [Cable(), Cable()]
    named = " ".join(cable.device for cable in cables)
    listed = tmp_path / "devices.txt"
    listed.write_text("\n".join(cable.device for cable in cables) + "\n\n")
    options = ("--file", str(listed)) if from_file else ("--devs", named)
    with running_agent(DOMAIN, transport=("multiserial", *options, "-b", "57600")) as agent:
        places = [agent.device, agent.wait_for(READY).rpartition(" ")[2]]
        assert places == [cable.device for cable in cables]
        for cable in cables:
            assert termios.tcgetattr(cable._slave)[4] == termios.B57600


@pytest.mark.builds
@pytest.mark.ros
@pytest.mark.system
def test_a_pseudo_terminal_and_its_speed() -> None:
    with running_agent(DOMAIN, transport=("pseudoterminal", "--baudrate", "921600")) as agent:
        opened = os.open(agent.device, os.O_RDWR | os.O_NOCTTY)
        assert termios.tcgetattr(opened)[4] == termios.B921600
        os.close(opened)
        with XrceClient(SerialLink(agent.device)) as client:
            assert client.connect() == 0


@pytest.mark.builds
@pytest.mark.ros
def test_a_can_bus() -> None:
    with CanBus() as bus, running_agent(DOMAIN, transport=("canfd", "-D", bus.device)) as agent:
        create = bytes.fromhex(captured.CREATE_CLIENT)
        bus.put(record(0x7F, bytes((len(create),)) + create))
        end = deadline(10)
        while 0x7F not in bus.identifiers():
            assert time.monotonic() < end, "no answer to the client's identifier"
            time.sleep(0.01)
        assert agent.device == bus.device


def no_options() -> dict[str, object]:
    """Return the value of each option of a command line without any."""
    context = command.make_context("agent", [])
    return dict(context.params)


@pytest.mark.parametrize(("level", "shown"), list(enumerate(("", "E", "E", "EW", "EWI", "EWID", "EWIDT"))))
def test_every_verbosity(level: int, shown: str) -> None:
    options = AgentOptions.of([{**no_options(), "verbosity": level}], [SocketChoice("udp4")])
    text = io.StringIO()
    log = EventLog(text, verbosity=options.verbose)
    for each in Level:
        log.emit(each, each.name, each.name[0])
    assert "".join(line[-1] for line in text.getvalue().splitlines()) == shown


def test_a_speed_that_no_terminal_has() -> None:
    done = run("pseudoterminal", "-b", "12345")
    assert done.returncode == 2
    assert re.search(r"no serial speed of 12345 bit/s.*MG-9431", done.stderr)
