# SPDX-License-Identifier: Apache-2.0
"""Each wrong use ends in a diagnostic that a newcomer can act on, and leaves nothing half-written behind."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from tests.support.command_line import Runner

pytestmark = pytest.mark.builds

APPLICATION = """\
version: 1
profiles: [pure_sender]
nodes:
  - name: imu
    publishers:
      - {topic: imu/data, type: sensor_msgs/msg/Imu}
limits:
  "*": {string: 16, sequence: 4}
"""


def put(folder: Path, text: str, name: str = "microros.yaml") -> Path:
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


def remaining(folder: Path) -> list[str]:
    return sorted(p.name for p in folder.iterdir() if p.name != "microros.yaml")


ON_THE_COMMAND_LINE = {
    "profile": (["--profile", "pure_sendr"], "pure_sendr", "Did you mean 'pure_sender'?"),
    "package": (["--interface", "sensor_mgs"], "sensor_mgs", "Did you mean 'sensor_msgs'?"),
    "type": (["--interface", "sensor_msgs/msg/Imuu"], "Imuu", "Did you mean 'Imu'?"),
    "target": (["--target", "hots"], "hots", "Did you mean 'host'?"),
    "agent": (["--agent", "localhost:8888"], "localhost", "IPv4"),
    "config": (["-c", "nowhere.yaml"], "nowhere.yaml", "-c"),
    "interface path": (["--interface-path", "nowhere"], "nowhere", ""),
}


@pytest.mark.parametrize("case", ON_THE_COMMAND_LINE)
@pytest.mark.parametrize("command", ["build", "generate", "resolve"])
def test_a_wrong_name_on_the_command_line(run: Runner, folder: Path, command: str, case: str) -> None:
    arguments, named, hint = ON_THE_COMMAND_LINE[case]
    outcome = run(command, *(["--profile", "pure_sender"] if case != "profile" else []), *arguments)
    assert outcome.status == 2
    assert "error:" in outcome.err
    assert named in outcome.err
    assert hint in outcome.err
    assert remaining(folder) == []


@pytest.mark.parametrize("profile", ["pure_sender", "pure_reader"])
def test_a_message_that_does_not_fit_shows_the_option_that_named_it(run: Runner, profile: str) -> None:
    outcome = run("generate", "--profile", profile, "--interface", "sensor_msgs/msg/MultiDOFJointState")
    assert outcome.status == 2
    place = r"^<command line>:1:13: error: sensor_msgs/msg/MultiDOFJointState takes up to \d+ bytes"
    assert re.match(place, outcome.err), outcome.err


IN_THE_FILE = {
    "broken YAML": ("nodes:\n", "nodes: [\n", r"microros\.yaml:\d+:\d+: error: "),
    "a key": ("limits:", "limit:", r"microros\.yaml:7:1: error: .*limit.*Did you mean 'limits'\?"),
    "a profile": (
        "[pure_sender]",
        "[pure_sendre]",
        r"microros\.yaml:2:12: error: .*Did you mean 'pure_sender'",
    ),
    "a type": ("msg/Imu}", "msg/Imo}", r"microros\.yaml:6:33: error: .*Did you mean 'Imu'\?"),
    "a package": ("sensor_msgs", "sensors_msgs", r"microros\.yaml:6:33: error: .*'sensor_msgs'"),
    "a limit not set": (
        '"*": {string: 16, sequence: 4}',
        "std_msgs/msg/String: {data: 8}",
        r"microros\.yaml:6:\d+: error: .*has no limit for header\.frame_id.*string: \d+",
    ),
    "a message larger than its stream": (
        "type: sensor_msgs/msg/Imu}",
        "type: sensor_msgs/msg/Imu, qos: {reliability: best_effort}}\ntransport: {type: udp, mtu: 256}",
        r"microros\.yaml:6:\d+: error: .*takes up to \d+ bytes .*256\. Set transport\.mtu: \d+.* in fragments",
    ),
    "a budget that the streams exceed": (
        "profiles: [pure_sender]",
        "profiles: [pure_sender]\nmemory: {ram_budget: 512}",
        r"microros\.yaml:3:\d+: error: .*ram_budget is 512",
    ),
    "an RTOS without a port": (
        "profiles: [pure_sender]",
        "profiles: [pure_sender]\ntarget: {name: cortex-m4, rtos: frertos}",
        r"microros\.yaml:3:33: error: unknown os 'frertos'. Did you mean 'freertos'\?",
    ),
    "no RTOS on a machine that has one": (
        "profiles: [pure_sender]",
        "profiles: [pure_sender]\ntarget: {name: host, rtos: none}",
        r"microros\.yaml:3:\d+: error: the target host cannot do without an operating system.*`rtos: none`",
    ),
    "contradictory components": (
        "profiles: [pure_sender]",
        "profiles: [pure_sender]\ncomponents: [+timers, -timers]",
        r"microros\.yaml:3:\d+: error: .*timers",
    ),
    "liveliness that cannot work": (
        "imu/data, type: sensor_msgs/msg/Imu}",
        "imu/data, type: sensor_msgs/msg/Imu, qos: {reliability: best_effort}}\nliveliness: acknack",
        r"microros\.yaml:7:\d+: error: .*acknack",
    ),
}


@pytest.mark.parametrize("case", IN_THE_FILE)
def test_a_fault_in_the_application_file(run: Runner, folder: Path, case: str) -> None:
    old, new, pattern = IN_THE_FILE[case]
    assert old in APPLICATION
    put(folder, APPLICATION.replace(old, new))
    outcome = run("build", "-o", "out")
    assert outcome.status == 2
    assert re.search(pattern, outcome.err), outcome.err
    assert remaining(folder) == []


def test_an_interface_larger_than_a_message_is_shown_where_it_is_named(run: Runner, folder: Path) -> None:
    """By its type or by its package."""
    text = "version: 1\nprofiles: [pure_sender]\ninterfaces: [{}]\nlimits: {{'*': {{string: 9, sequence: 70000}}}}\n"
    for named in ("std_msgs/msg/ByteMultiArray", "std_msgs"):
        put(folder, text.format(named))
        outcome = run("generate", "-o", "out")
        assert outcome.status == 2
        assert "microros.yaml:3:14: error: std_msgs/msg/ByteMultiArray takes up to" in outcome.err


def test_several_faults_are_reported_in_one_run(run: Runner, folder: Path) -> None:
    put(folder, APPLICATION.replace("limits:", "limit:").replace("version: 1", "versoin: 1"))
    outcome = run("generate", "-o", "out")
    assert outcome.err.count(": error: ") >= 2


def test_profiles_that_contradict_each_other(run: Runner, folder: Path) -> None:
    put(folder, "profile: a\nsummary: A\nextends: [pure_sender]\nliveliness: none\n", "a.yaml")
    put(folder, "profile: b\nsummary: B\nextends: [pure_sender]\nliveliness: ping\n", "b.yaml")
    outcome = run("resolve", "--profile", "a", "--profile", "b")
    assert outcome.status == 2
    assert "a.yaml" in outcome.err
    assert "b.yaml" in outcome.err


def test_a_fault_in_an_interface_file_shows_its_line(run: Runner, folder: Path) -> None:
    put(folder, "<package><name>robot_msgs</name></package>\n", "robot_msgs/package.xml")
    put(folder, "int32 good\nint33 bad\nfloat64 Bad\n", "robot_msgs/msg/Arm.msg")
    outcome = run("build", "--profile", "pure_sender", "--interface-path", ".", "--interface", "robot_msgs")
    assert outcome.status == 2
    assert re.search(r"Arm\.msg:2:1: error: .*int33", outcome.err)
    assert re.search(r"Arm\.msg:3:9: error: .*Bad", outcome.err)
    assert "\n  int33 bad\n  ^~~~~" in outcome.err


def test_a_missing_compiler(run: Runner, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (folder / "empty").mkdir()
    monkeypatch.setenv("PATH", str(folder / "empty"))
    outcome = run("build", "--profile", "pure_sender")
    assert outcome.status == 2
    assert "C compiler" in outcome.err
    assert "apt-get install gcc" in outcome.err
    assert remaining(folder) == ["empty"]


def test_a_compiler_that_fails_shows_what_it_said(
    run: Runner, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    compiler = put(folder, "#!/bin/sh\necho 'cc: out of paper' >&2\nexit 1\n", "bin/paper-cc")
    compiler.chmod(0o755)
    monkeypatch.setenv("CC", str(compiler))
    outcome = run("build", "--profile", "pure_sender")
    assert outcome.status == 1
    assert "out of paper" in outcome.err
    assert not (folder / "build/pure_sender/lib/libmicroros.a").exists()


def test_an_output_folder_that_holds_something_else(run: Runner, folder: Path) -> None:
    put(folder, "mine", "out/thesis.tex")
    outcome = run("build", "--profile", "pure_sender", "-o", "out")
    assert outcome.status == 2
    assert "thesis.tex" in outcome.err
    assert "-o" in outcome.err
    assert [p.name for p in (folder / "out").iterdir()] == ["thesis.tex"]


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="a folder where not even root may write")
def test_an_output_folder_that_is_not_writable(run: Runner) -> None:
    outcome = run("generate", "--profile", "pure_sender", "-o", "/proc/microros")
    assert outcome.status == 2
    assert "cannot write the output folder /proc/microros" in outcome.err
    assert "-o" in outcome.err


def test_a_measured_budget_that_is_exceeded_names_the_largest(run: Runner, folder: Path) -> None:
    small = APPLICATION.replace("sensor_msgs/msg/Imu", "std_msgs/msg/Int32")
    put(folder, small + "memory: {flash_budget: 1 KiB}\n")
    outcome = run("build", "-o", "out")
    assert outcome.status == 1
    assert re.search(r"microros\.yaml:9:\d+: error: .*flash_budget is 1024 \(largest: \w+ \d+", outcome.err)


def test_an_unknown_command_names_the_nearest(run: Runner) -> None:
    outcome = run("biuld")
    assert outcome.status == 2
    assert "Did you mean 'build'?" in outcome.err


def test_run_needs_a_built_folder(run: Runner, folder: Path) -> None:
    (folder / "empty").mkdir()
    assert "is not an output folder" in run("run", "empty").err
    assert run("generate", "--profile", "pure_sender", "-o", "out").status == 0
    outcome = run("run", "out")
    assert outcome.status == 2
    assert "microros-gen build" in outcome.err


@pytest.mark.system
def test_a_failed_build_can_be_taken_up(run: Runner, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert run("build", "--profile", "pure_sender").status == 0
    built = folder / "build/pure_sender"
    before = {p: p.read_bytes() for p in built.rglob("*") if p.is_file() and ".build" not in p.parts}
    shutil.rmtree(built / ".build")
    outcome = run("build", "--profile", "pure_sender")
    assert outcome.status == 0
    after = {p: p.read_bytes() for p in built.rglob("*") if p.is_file() and ".build" not in p.parts}
    assert before == after
