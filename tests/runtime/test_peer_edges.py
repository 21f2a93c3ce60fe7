# SPDX-License-Identifier: Apache-2.0
"""Links with other boards: several tasks, links of different sizes, many lines, and the end of a session."""

from __future__ import annotations

import subprocess
from contextlib import ExitStack
from functools import partial
from pathlib import Path

from tests.support.components.rendered import program_of, rendered
from tests.support.patience import seconds
from tests.support.runtime import peers
from tests.support.runtime.peers import APPLICATION, HOST, PAIR, Relay, board_program, started, system
from tests.support.runtime.plugs import Plugs
from tests.support.runtime.reading_agent import ReadingAgent
from tests.support.runtime.udp import UdpAgent

BEST, SURE = 0, 1


def own_ports(count: int) -> list[int]:
    """Return ports that nobody has now."""
    with ExitStack() as stack:
        return [port for _ in range(count) for port in stack.enter_context(Relay()).ports[:1]]


until = partial(peers.until, at_most_s=20)


def test_a_publish_wakes_a_task_that_waits_if_the_link_then_has_work_to_do(tmp_path: Path) -> None:
    """A HEARTBEAT becomes due; a best-effort message leaves at once and needs nothing more."""
    ports = own_ports(2)
    ends = system(f"{HOST}:{ports[0]}", f"{HOST}:{ports[1]}")
    tasks = APPLICATION + "components: [+multithread]\n"
    first = board_program(tmp_path, "a", ends, tasks, waits_here=True)
    with started(first) as a, started(board_program(tmp_path, "b", ends)) as b:
        until(lambda: not a.publish(SURE, 0), a, b)
        until(lambda: b.values[SURE] == [0] and not b.publish(BEST, 0), a, b)
        until(lambda: len(a.values[BEST]) == 1, a, b)
        a.spin(20)  # the acknowledgement is there
        assert a.wakes(BEST, 1) == 0
        assert a.wakes(SURE, 1) == 1
        assert a.wakes(SURE, 2) == 0  # the HEARTBEAT is due anyway
        until(lambda: b.values == ([1], [0, 1, 2]), a, b)


SMALL = 64
BODY, ENCAPSULATION = SMALL - 12, 4
THREE = """\
version: 1
boards:
  a: {{application: a/microros.yaml}}
  b: {{application: b/microros.yaml}}
  c: {{application: c/microros.yaml}}
links:
  - {{type: udp, ends: {{a: "{host}:{ports[0]}", b: "{host}:{ports[1]}"}}}}
  - {{type: udp, mtu: {small}, ends: {{a: "{host}:{ports[2]}", c: "{host}:{ports[3]}"}}}}
"""


def test_a_serialized_message_is_too_large_for_one_of_two_links(tmp_path: Path) -> None:
    folder = tmp_path / "boards"
    texts = {own: APPLICATION.replace("OWN", own).replace("OTHER", "a") for own in ("b", "c")}
    texts["a"] = APPLICATION.replace("OWN", "a").replace("OTHER", "b")
    for topic in ("best", "sure"):
        line = next(line for line in texts["a"].splitlines() if f"topic: /a/{topic}" in line)
        reader = line.replace(f"/a/{topic}", f"/c/{topic}")
        texts["a"] += f"{reader}\n"
    for own, text in texts.items():
        (folder / own).mkdir(parents=True)
        (folder / own / "microros.yaml").write_text(text)
    (folder / "system.yaml").write_text(THREE.format(host=HOST, ports=own_ports(4), small=SMALL))
    with ExitStack() as stack:
        a, b, c = (
            stack.enter_context(started(_program(folder / own, own, texts[own]))) for own in ("a", "b", "c")
        )
        until(lambda: not a.publish(BEST, 0) and not a.publish(SURE, 0), a, b, c)
        assert a.publish_serialized(BEST, ENCAPSULATION + BODY) == ""
        assert f"{BODY + 4} bytes above {BODY}" in a.publish_serialized(BEST, ENCAPSULATION + BODY + 4)
        assert "12 bytes above 8" in a.publish_serialized(SURE, ENCAPSULATION + 8)  # the slots hold an Int32


def _program(home: Path, own: str, text: str) -> Path:
    flags = (f'-DOWN="{own}"', f'-DOTHER="{"b" if own == "a" else "a"}"')
    return program_of(rendered(home, text), "peer_board.c", ("port_posix_time.c",), flags)


LINES = 3


def test_as_many_serial_lines_as_links_and_the_two_of_the_agent(tmp_path: Path) -> None:
    names = [f"b{i}" for i in range(LINES)]
    boards = "".join(f"  {name}: {{application: {name}/microros.yaml}}\n" for name in ("a", *names))
    links = "".join(
        f'  - {{type: serial, ends: {{a: "/dev/a{i}", {n}: "/dev/b"}}}}\n' for i, n in enumerate(names)
    )
    head = "version: 1\nprofiles: [pure_sender, pure_reader]\ntransport: {type: serial}\n"

    def end(kind: str, topic: str) -> str:
        return f"    {kind}:\n      - {{topic: {topic}, type: std_msgs/msg/Int32, peer: only}}\n"

    def board(own: str, ends: str) -> str:
        return f"{head}system: {{file: ../system.yaml, board: {own}}}\nnodes:\n  - name: n\n{ends}"

    for name in names:
        (tmp_path / name).mkdir()
        (tmp_path / name / "microros.yaml").write_text(board(name, end("subscriptions", "/all")))
    (tmp_path / "a").mkdir()
    (tmp_path / "system.yaml").write_text(f"version: 1\nboards:\n{boards}links:\n{links}")
    out = rendered(tmp_path / "a", board("a", end("publishers", "/all")))
    program = program_of(out, "many_lines.c")
    with ExitStack() as stack:
        pairs = [stack.enter_context(Plugs([tmp_path / f"{i}{own}" for own in PAIR])) for i in range(LINES)]
        paths = [path for pair in pairs for path in pair.names]
        done = subprocess.run(
            [program, *paths], capture_output=True, text=True, timeout=seconds(60), check=False
        )
    assert (done.returncode, done.stdout) == (0, f"{LINES + 2}\n")


def test_no_other_session_begins_before_a_link_has_sent_everything(tmp_path: Path) -> None:
    """The session with the agent ends first; then the link waits for an acknowledgement."""
    agent = UdpAgent()
    agent.agent = ReadingAgent()
    agent.start()
    ports = own_ports(2)
    ends = system(f"{HOST}:{ports[0]}", f"{HOST}:{ports[1]}")
    besides = APPLICATION.replace(
        "/sure, type: std_msgs/msg/Int32, peer: only", "/sure, type: std_msgs/msg/Int32, peer: also"
    )
    besides = besides.replace("round_trip", "close_timeout: 300 ms, round_trip")
    besides += f'transport: {{type: udp, agent: "{HOST}:{agent.port}"}}\n'
    first = board_program(tmp_path, "a", ends, besides)
    second = board_program(tmp_path, "b", ends, others=besides)
    with started(first) as a, started(second) as b:
        until(lambda: not a.publish(BEST, 0), a, b)
        b.kill()
        until(lambda: not a.publish(SURE, 0), a)
        a.end()
    agent.stop()
