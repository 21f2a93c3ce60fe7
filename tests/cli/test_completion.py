# SPDX-License-Identifier: Apache-2.0
"""Completion in a shell: what is offered, in a real bash too, and what a press of Tab imports."""

from __future__ import annotations

import os
import select
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest
from click.shell_completion import ShellComplete

from microros_gen.cli.main import _COMMANDS, cli
from microros_gen.platform.find import builtin_targets
from microros_gen.selection.find_components import components_folder
from microros_gen.selection.find_profiles import load_builtin_profiles
from tests.support.command_line import Runner
from tests.support.environments import clean_environ
from tests.support.patience import deadline
from tests.support.slices import spread

NOT_NEEDED = (
    *("lark", "elftools", "squarify", "rclpy", "asyncio", "jsonschema", "microros_gen.agent.core"),
    *("microros_gen.agent.server", "microros_gen.client.plan.project", "microros_gen.compiler.pipeline"),
    *(
        "microros_gen.image.folder",
        "microros_gen.image.report",
        "microros_gen.migrate",
        "microros_gen.ros.peer",
    ),
    "microros_gen.mode_manager.orchestrator",
    *("microros_gen.toolchain.compile", "microros_gen.typesupport.plan.types"),
)
"""What takes long to import; with any of them a press of Tab takes more than 150 ms."""
LINES = [*((name, "--") for name in _COMMANDS), ("build", "--profile", "p"), ("init", "--target", "c")]
LINES += [("build", "--component", "+p"), ("build", "--interface", "std_msgs/msg/"), ("explain", "MG-1")]
LINES += [("schema", ""), ("modes", "manage", "--"), ("agent", "udp4", "--")]

BASH = """\
source <(microros-gen completion bash)
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
_microros_gen_completion microros-gen
printf '%s\\n' "${COMPREPLY[@]}"
complete -p microros-gen
"""

ZSH = """\
autoload -Uz compinit
compinit -u -D
source <(microros-gen completion zsh)
write_line() { print -r -- "$BUFFER" > "$LINE_FILE"; print -r -- writ""ten }
zle -N write_line
bindkey '^X' write_line
PROMPT='> '
print -r -- typ""ing
"""
SEARCHED = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])


def offered(*words: str) -> list[str]:
    """Return what is offered for the last of `words`."""
    *before, last = words
    return [item.value for item in ShellComplete(cli, {}, "microros-gen", "X").get_completions(before, last)]


def test_commands() -> None:
    assert offered("") == list(_COMMANDS)
    assert offered("sch") == ["schedule", "schema"]
    assert {"--version", "--help"} <= set(offered("--"))
    assert offered("modes", "m") == ["manage", "mine", "monitor"]
    assert offered("agent", "udp") == ["udp4", "udp6"]


@pytest.mark.parametrize("command", _COMMANDS)
def test_options(command: str) -> None:
    found = offered(command, "--")
    assert "--help" in found
    assert all(name.startswith("--") for name in found)


def test_names_are_those_that_the_tool_knows(folder: Path) -> None:
    profiles = sorted(load_builtin_profiles())
    targets = list(builtin_targets())
    components = sorted(p.parent.name for p in components_folder().glob("*/component.yaml"))
    for command in ("build", "generate", "check", "resolve"):
        assert offered(command, "--profile", "") == profiles
        assert offered(command, "--target", "") == targets
        assert offered(command, "--component", "") == components
        assert offered(command, "--component", "+") == [f"+{name}" for name in components]
    assert offered("profiles", "") == offered("init", "--profile", "") == profiles
    assert offered("targets", "cortex-m4") == ["cortex-m4", "cortex-m4f"]
    assert offered("init", "--target", "") == targets
    assert offered("build", "--component", "+time_s") == ["+time_source", "+time_sync"]


def test_types_of_included_and_of_own_packages(folder: Path) -> None:
    (folder / "src/robot/msg").mkdir(parents=True)
    (folder / "src/robot/msg/Wheel.msg").write_text("int32 x\n")
    (folder / "src/robot_more/srv").mkdir(parents=True)
    (folder / "src/robot_more/srv/Go.srv").write_text("---\n")
    assert offered("build", "--interface", "std_") == ["std_msgs", "std_srvs"]
    assert offered("build", "--interface", "robot") == []
    own = ("--interface-path", "src")
    assert offered("build", *own, "--interface", "robot") == ["robot", "robot_more"]
    assert offered("build", *own, "--interface", "robot/") == ["robot/msg/Wheel"]
    assert offered("interfaces", *own, "robot_m") == ["robot_more", "robot_more/srv/Go"]
    assert offered("interfaces", "std_srvs/srv/T") == ["std_srvs/srv/Trigger"]
    assert offered("build", "--interface-path", "no such", "--interface", "std_s")[0] == "std_srvs"


def test_other_arguments() -> None:
    assert {"application", "profile"} <= set(offered("schema", ""))
    assert offered("explain", "mg-924")[0] == "MG-9240"
    assert offered("completion", "") == ["bash", "zsh", "fish"]
    assert offered("size", "x", "--format", "") == ["table", "json", "html"]


@pytest.mark.parametrize("words", spread(LINES), ids=" ".join)
def test_a_press_of_tab_imports_little(words: tuple[str, ...]) -> None:
    environment = clean_environ(
        COMP_WORDS=" ".join(("microros-gen", *(w for w in words if w))),
        COMP_CWORD=str(len(words)),
        _MICROROS_GEN_COMPLETE="bash_complete",
    )
    code = (
        "import sys, atexit\n"
        "atexit.register(lambda: print(*sys.modules, file=sys.stderr))\n"
        "from microros_gen.cli.main import main\n"
        "main()\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True
    )
    assert done.stdout.startswith("plain,")
    imported = set(done.stderr.split())
    assert "click" in imported
    assert imported.isdisjoint(NOT_NEEDED), imported & set(NOT_NEEDED)


@pytest.mark.skipif(shutil.which("bash") is None, reason="no bash")
@pytest.mark.builds
def test_in_a_real_bash(tmp_path: Path) -> None:
    for words, expected in {
        ("res",): ["resolve"],
        ("build", "--profile", "pure_s"): ["pure_sender"],
        ("interfaces", "std_msgs/msg/Bo"): ["std_msgs/msg/Bool"],
    }.items():
        command = ["bash", "--norc", "-c", BASH, "bash", "microros-gen", *words]
        done = subprocess.run(
            command,
            env=clean_environ(PATH=SEARCHED),
            cwd=tmp_path,
            capture_output=True,
            text=True,
            check=True,
        )
        *found, registered = done.stdout.splitlines()
        assert found == expected
        assert registered == "complete -o nosort -F _microros_gen_completion microros-gen"
        assert done.stderr == ""


COMPLETED = {
    "microros-gen res": "microros-gen resolve",
    "microros-gen build --profile pure_s": "microros-gen build --profile pure_sender",
    "microros-gen interfaces std_msgs/msg/Bo": "microros-gen interfaces std_msgs/msg/Bool",
}


@pytest.mark.skipif(shutil.which("fish") is None, reason="no fish: apt-get install fish")
@pytest.mark.builds
def test_in_a_real_fish(tmp_path: Path) -> None:
    environment = clean_environ(PATH=SEARCHED, HOME=str(tmp_path), XDG_CONFIG_HOME=str(tmp_path))
    for typed, expected in COMPLETED.items():
        script = 'microros-gen completion fish | source; complete --do-complete "$argv[1]"'
        done = subprocess.run(
            ["fish", "--no-config", "-c", script, typed],
            env=environment,
            cwd=tmp_path,
            capture_output=True,
            text=True,
            check=True,
        )
        found = [line.partition("\t")[0] for line in done.stdout.splitlines() if line]
        assert (found, done.stderr) == ([expected.split()[-1]], "")


@pytest.mark.skipif(shutil.which("zsh") is None, reason="no zsh: apt-get install zsh")
@pytest.mark.builds
def test_in_a_real_zsh(tmp_path: Path) -> None:
    """Keys are typed at a terminal; the last one writes what the line then has."""
    result, start = tmp_path / "line", tmp_path / "start.zsh"
    start.write_text(ZSH)
    environment = clean_environ(PATH=SEARCHED, HOME=str(tmp_path), TERM="dumb", LINE_FILE=str(result))
    for typed, expected in COMPLETED.items():
        result.unlink(missing_ok=True)
        terminal, end = os.openpty()
        zsh = subprocess.Popen(
            ["zsh", "-f", "-i"], env=environment, cwd=tmp_path, stdin=end, stdout=end, stderr=end
        )
        try:
            os.close(end)
            os.write(terminal, f"source {start}\n".encode())
            _read_until(terminal, "typing")
            os.write(terminal, f"{typed}\t\x18".encode())
            _read_until(terminal, "written")
            assert result.read_text().strip() == expected
        finally:
            zsh.kill()
            zsh.wait()
            os.close(terminal)


def _read_until(terminal: int, text: str) -> None:
    """Read what a shell prints until it has printed `text`."""
    found, end = "", deadline(20)
    while text not in found:
        assert time.monotonic() < end, found
        if select.select([terminal], [], [], 0.5)[0]:
            found += os.read(terminal, 4096).decode(errors="replace")


@pytest.mark.parametrize(
    ("shell", "line"),
    [("zsh", "#compdef microros-gen"), ("fish", "complete --no-files --command microros-gen")],
)
def test_scripts_of_other_shells(run: Runner, shell: str, line: str) -> None:
    outcome = run("completion", shell)
    assert outcome.status == 0
    assert line in outcome.out
    assert f"_MICROROS_GEN_COMPLETE={shell}_complete" in outcome.out
