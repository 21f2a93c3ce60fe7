# SPDX-License-Identifier: Apache-2.0
"""docs/howto/init.md, check.md and idl.md: their commands run, and what they say of files is so."""

from __future__ import annotations

import shlex
from pathlib import Path

import pytest
import yaml

from microros_gen.cli import main as cli
from tests.support.console import blocks
from tests.support.paths import ROOT

PAGES = {
    name: (ROOT / f"docs/howto/{name}.md").read_text(encoding="utf-8") for name in ("init", "check", "idl")
}
META = '{"names": {"rmw_microxrcedds": {"cmake-args": ["-DRMW_UXRCE_MAX_PUBLISHERS=2"]}}}'


def texts(page: str, kind: str) -> list[str]:
    return [block.text for block in blocks(PAGES[page]) if block.language == kind]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    (tmp_path / "app-colcon.meta").write_text(META)
    return tmp_path


def call(line: str) -> int:
    with pytest.raises(SystemExit) as end:
        cli.main(shlex.split(line, comments=True)[1:])
    assert isinstance(end.value.code, int)
    return end.value.code


def test_the_commands_of_init(folder: Path, capfd: pytest.CaptureFixture[str]) -> None:
    lines = [line for block in texts("init", "sh") for line in block.splitlines()]
    lines.remove("microros-gen size my_robot/build")  # of an image that is not built here
    own = [line for line in lines if line.startswith("microros-gen ")]
    assert len(own) == 3
    for line in own:
        assert call(line) == 0, line
        # What remains of the page's commands is what the tool itself says comes next.
        output = capfd.readouterr().out.splitlines()[-1]
        name = shlex.split(line)[2]
        assert output == f"cmake -S {name} -B {name}/build && cmake --build {name}/build"
    assert " && ".join(line for line in lines if line not in own) == output.replace(
        "old_settings", "my_robot"
    )


def test_the_commands_of_check(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert call("microros-gen init app --ci") == 0
    monkeypatch.chdir(folder / "app")
    (lines,) = (block.splitlines() for block in texts("check", "sh"))
    (folder / "app/golden/sources.txt").write_text("")
    assert [call(line) for line in reversed(lines)] == [1, 0]
    assert call(lines[1]) == 0


def test_what_check_says_of_the_action_and_the_hook() -> None:
    workflow, hooks = (yaml.safe_load(block) for block in texts("check", "yaml"))
    action = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))
    (used,) = (step for step in workflow["steps"] if "microros_gen" in step["uses"])
    assert set(used["with"]) <= set(action["inputs"])
    for name in action["inputs"]:
        assert f"`{name}`" in PAGES["check"] or name in used["with"]
    (hook,) = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
    assert hooks["repos"][0]["hooks"] == [{"id": hook["id"]}]
    assert f"`[{', '.join(hook['args'])}]`" in PAGES["check"]


def test_the_commands_of_idl(folder: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (lines,) = (block.splitlines() for block in texts("idl", "sh"))
    assert [call(line) for line in lines] == [0, 0, 0, 0]
    assert "struct Imu {" in capfd.readouterr().out
    for path in (
        "idl/sensor_msgs/msg/Imu.idl",
        "idl/std_msgs/msg/Header.idl",
        "portable/std_msgs/msg/Header.idl",
    ):
        assert (folder / path).is_file()
    assert (folder / "descriptions/sensor_msgs/msg/Imu.json").is_file()
