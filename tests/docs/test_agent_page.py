# SPDX-License-Identifier: Apache-2.0
"""docs/howto/agent.md is true: its commands run, its file holds, and its tables have all options, limits and events."""

from __future__ import annotations

import ast
import inspect
import json
import os
import re
import shlex
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import asdict, fields
from pathlib import Path

import click
import pytest

from microros_gen.agent.configuration.entities_file import KINDS, parse_preconfigured
from microros_gen.agent.configuration.parser import parse_agent_file
from microros_gen.agent.limits import Limits
from microros_gen.agent.preconfigured import Preconfigured
from microros_gen.agent.processing import Processor
from microros_gen.agent.ros import reports
from microros_gen.agent.transport.tcp import TcpLimits
from microros_gen.cli.agent.command import command
from microros_gen.diagnostics import Diagnostics, Source
from tests.support.paths import ROOT
from tests.support.patience import seconds

PAGE = (ROOT / "docs/howto/agent.md").read_text(encoding="utf-8")
MONITORING = (ROOT / "docs/howto/monitoring.md").read_text(encoding="utf-8")
AGENT = ROOT / "microros_gen/agent"


def blocks(kind: str) -> list[str]:
    return re.findall(rf"^```{kind}\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)


def rows(head: str) -> dict[str, list[str]]:
    """Return the rows of the tables whose first column is `head`, by each name in their first column."""
    found: dict[str, list[str]] = {}
    for table in re.findall(rf"(?m)^\| {head} \|.*\n\|[-|]+\n((?:\|.*\n)+)", PAGE):
        for line in table.splitlines():
            cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
            for name in re.findall(r"`([^`]+)`", cells[0]):
                found[name] = cells
    return found


LINES = [line for block in blocks("sh") for line in block.splitlines()]


@pytest.mark.ros
@pytest.mark.parametrize("line", LINES)
def test_the_commands_run(line: str, tmp_path: Path) -> None:
    """Each until all that can be ready on this machine is, then SIGTERM; on free ports."""
    words = shlex.split(line)
    assert words[:2] == ["microros-gen", "agent"]
    text = " ".join(words[2:]).replace("/tmp/board", str(tmp_path / "board"))
    if "--config" in text:
        file = re.sub(r"port: \d+", "port: 0", (ROOT / "examples/agent/agent.yaml").read_text())
        (tmp_path / "agent.yaml").write_text(file)
        text = text.replace("examples/agent/agent.yaml", str(tmp_path / "agent.yaml"))
    text = re.sub(r"\b(udp4|tcp4)( --port \d+)?", r"\1 --port 0", text)
    environment = {**os.environ, "ROS_DOMAIN_ID": str(1 + os.getpid() % 100), "PYTHONUNBUFFERED": "1",
                   "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "PYTHONPATH": str(ROOT)}  # fmt: skip
    agent = subprocess.Popen(
        [sys.executable, "-m", "microros_gen", "agent", *text.split()],
        env=environment,
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert agent.stdout is not None
    first = agent.stdout.readline()
    time.sleep(0.3)
    agent.terminate()
    out, errors = agent.communicate(timeout=seconds(15))
    assert agent.returncode == 0, errors
    assert "ready" in first + out
    assert "agent stopped" in errors


def test_the_file_of_the_page_holds() -> None:
    (text,) = blocks("yaml")
    diagnostics = Diagnostics()
    options = parse_agent_file(Source("docs/howto/agent.md", text), diagnostics)
    diagnostics.check()
    assert len(options.transports) == 5
    assert options.discovery == 7400


def test_every_option_is_there() -> None:
    assert isinstance(command, click.Group)
    for each in (command, *command.commands.values()):
        for option in each.params:
            names = [name for name in option.opts if name not in ("--dev", "--verbose")]
            page = MONITORING if each.name == "status" else PAGE
            assert any(f"`{name}" in page for name in names), f"{each.name} {option.opts}"
            if not option.opts[0].startswith("-v"):
                assert all(f"{name}" in page for name in names)
    assert all(f"`{name}`" in PAGE for name in command.commands if name != "status")


def test_every_limit_is_there_with_its_default() -> None:
    reported = {
        name: float(cells[1]) for name, cells in rows("limit").items() if re.fullmatch(r"[\d.]+", cells[1])
    }
    assert reported == {**asdict(Limits()), **asdict(TcpLimits())}


def calls() -> Iterator[tuple[str, ast.Call]]:
    for path in sorted(AGENT.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call):
                name = (
                    node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
                )
                yield name, node


def texts(node: ast.Call) -> list[str]:
    return [a.value for a in node.args if isinstance(a, ast.Constant) and isinstance(a.value, str)]


def test_every_event_is_there_with_its_fields() -> None:
    table = rows("event")
    seen = set()
    for name, node in calls():
        if name not in ("emit", "_report") or not texts(node) or not re.fullmatch(r"[a-z_]+", texts(node)[0]):
            continue
        event = texts(node)[0]
        seen.add(event)
        assert event in table, event
        for keyword in node.keywords:
            if keyword.arg:
                assert f"`{keyword.arg}`" in table[event][2], f"{event}: {keyword.arg}"
    for report, (_level, event) in reports._EVENTS.items():
        seen.add(event)
        assert {field.name for field in fields(report)} == set(re.findall(r"`(\w+)`", table[event][2])), event
    cli = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "microros_gen/cli/agent").glob("*.py"))
    log = (AGENT / "log.py").read_text(encoding="utf-8")
    seen |= set(re.findall(r'Level\.\w+, "(\w+)"', cli + log))
    assert seen | {"bad_input"} == set(table)


def test_every_kind_of_fault_is_there() -> None:
    kinds = set(rows("kinds"))
    found = set()
    for name, node in calls():
        first = node.args[0] if node.args else None
        if name in ("count", "MalformedError", "_fault", "_fail") and isinstance(first, ast.Constant):
            found.add(str(first.value))
        if name == "_stop" and isinstance(node.args[-1], ast.Constant):
            found.add(str(node.args[-1].value))
        if name == "_fail" and len(node.args) > 1:
            found |= {
                str(n.value)
                for n in ast.walk(node.args[1])
                if isinstance(n, ast.Constant) and str(n.value)[:4] == "tcp_"
            }
    sources = (path.read_text(encoding="utf-8") for path in AGENT.rglob("*.py"))
    found |= {kind for text in sources for kind in re.findall(r'_log\.counters\["(\w+)"\] \+= 1', text)}
    found = {kind for kind in found if re.fullmatch(r"[a-z]+(_[a-z]+)*", kind)}
    found |= {"frame_too_large", "frame_empty", "log_lost", "client_STATUS", "internal_ERROR", "seal_KIND"}
    found |= {"no_server", "no_client", str(inspect.signature(Processor._stop).parameters["kind"].default)}
    assert '"history_full" if isinstance(error, HistoryFullError) else "publish"' in (
        AGENT / "operations.py"
    ).read_text(encoding="utf-8")
    found = (found | {"publish", "history_full"}) - {"client_resources", "client_denied"}  # of client_STATUS
    assert found == kinds


def test_the_fields_of_the_example_are_those_of_the_event() -> None:
    _, line = blocks("json")
    event = json.loads(line)
    own = set(event) - {"time", "level", "event", "message"}
    assert own == set(re.findall(r"`(\w+)`", rows("event")[event["event"]][2]))


def test_the_entities_file_has_every_kind_of_object() -> None:
    text, _ = blocks("json")
    diagnostics = Diagnostics()
    (client,) = parse_preconfigured([Source("entities.json", text)], diagnostics)
    diagnostics.check()
    assert [item.kind for item in client.objects] == list(KINDS)
    assert len(Preconfigured([client]).objects(client.key or b"")) == len(KINDS)


def test_linked_files_exist() -> None:
    for link in re.findall(r"\]\(([^)#]+)[^)]*\)", PAGE):
        assert (ROOT / "docs/howto" / link).exists(), link


def test_every_kind_of_refused_datagram_is_on_its_page() -> None:
    sources = [*(AGENT / "seal").glob("*.py"), AGENT / "transport" / "sealed.py"]
    kinds = {
        kind for path in sources for kind in re.findall(r'"(seal_[a-z_]+)"', path.read_text(encoding="utf-8"))
    }
    page = (ROOT / "docs/howto/seal.md").read_text(encoding="utf-8").partition("### What the agent counts")[2]
    assert kinds == set(re.findall(r"`(seal_[a-z_]+)`", page.partition("## ")[0]))
