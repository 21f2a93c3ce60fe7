# SPDX-License-Identifier: Apache-2.0
"""`microros-gen agent --policy`: what the command checks before it starts, and when the file has changed."""

from __future__ import annotations

import io
from pathlib import Path

import pytest

from microros_gen.agent.configuration.model import SocketChoice
from microros_gen.agent.log import EventLog
from microros_gen.cli.agent.options import AgentOptions
from microros_gen.cli.agent.policy import read_policy, reloading
from microros_gen.diagnostics import Diagnostics
from tests.support.agent.fakes import Bench
from tests.support.agent.newcomers import hello
from tests.support.agent.policies import DENIED, OK, policy_of
from tests.support.command_line import Runner

RIGHT = "version: 1\nclients:\n  - {name: a, keys: [0x1], publish: [/a]}\n"
WRONG = "version: 1\nclients:\n  - {name: a, keys: [0x0], publish: [a], domain: 3}\n"


def test_a_check_reports_all_faults_of_all_files(run: Runner, tmp_path: Path) -> None:
    (tmp_path / "policy.yaml").write_text(WRONG)
    (tmp_path / "agent.yaml").write_text("version: 1\npolicy: policy.yaml\nentities: [none.json]\n")
    result = run("agent", "--config", str(tmp_path / "agent.yaml"), "--check")
    assert (result.status, result.out) == (2, "")
    assert [name for name in ("MG-9503", "MG-9507", "MG-9703") if name not in result.err] == []
    assert "policy.yaml:3:22: error" in result.err


def test_a_check_starts_nothing(run: Runner, tmp_path: Path) -> None:
    file = tmp_path / "policy.yaml"
    file.write_text(RIGHT)
    for transport in ((), ("udp4", "--port", "1")):
        result = run("agent", *transport, "--policy", str(file), "--check")
        assert (result.status, result.out, result.err) == (0, "no faults\n", "")


def test_a_warning_is_shown_and_is_no_fault(run: Runner, tmp_path: Path) -> None:
    file = tmp_path / "policy.yaml"
    file.write_text("version: 1\nclients:\n  - name: a\n")
    result = run("agent", "--policy", str(file), "--check")
    assert (result.status, result.out) == (0, "no faults\n")
    assert "MG-9513" in result.err


@pytest.mark.parametrize(("domain", "status"), [("3", 0), ("4", 2)])
def test_the_domain_of_the_command_contradicts_that_of_a_rule(
    run: Runner, tmp_path: Path, domain: str, status: int
) -> None:
    file = tmp_path / "policy.yaml"
    file.write_text(RIGHT.replace("publish", "domain: 3, publish"))
    result = run("agent", "--policy", str(file), "--domain", domain, "--check")
    assert result.status == status
    assert ("MG-9510" in result.err) == (status == 2)


def test_without_a_file_there_is_nothing_to_reload() -> None:
    options, log = AgentOptions((SocketChoice("udp4"),)), EventLog(io.StringIO())
    assert read_policy(options, Diagnostics()) is None
    assert reloading(options, Bench().agent, log) is None


def test_a_faulty_or_missing_file_leaves_the_policy_in_force(tmp_path: Path) -> None:
    file, text = tmp_path / "policy.yaml", io.StringIO()
    bench = Bench(policy=policy_of("name: a, keys: [0x1], publish: [/a]"))
    reload = reloading(AgentOptions(policy=file), bench.agent, EventLog(text))
    assert reload is not None
    reload()
    assert "cannot be read" in text.getvalue()
    file.write_text(WRONG)
    reload()
    assert "MG-9503" in text.getvalue()
    assert text.getvalue().count("the one before stays in force") == 2
    assert [status_of(bench, key) for key in (1, 2)] == [OK, DENIED]
    file.write_text(RIGHT.replace("0x1", "0x2"))
    reload()
    assert "policy: 1 rules" in text.getvalue()
    assert [status_of(bench, key) for key in (1, 2)] == [DENIED, OK]


def status_of(bench: Bench, key: int) -> int:
    (answer,) = bench.say(hello(key), f"10.0.0.{key}")
    return int(answer.split()[8], 16)
