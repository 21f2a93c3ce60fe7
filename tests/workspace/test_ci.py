# SPDX-License-Identifier: Apache-2.0
"""The checks that users put into their CI: the workflow that `init` writes, the action, the pre-commit hook."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from tests.support.environments import clean_environ
from tests.support.installed import Installed, environment_with_dependencies
from tests.support.paths import ROOT
from tests.support.workflow import defaults_of, run_step, run_steps, steps_of

WORKFLOW = ".github/workflows/microros.yml"
ACTION = ROOT / "action.yml"
HOOKS = ROOT / ".pre-commit-hooks.yaml"
USED = ["actions/checkout@v4", "actions/setup-python@v5"]
PIP = '#!/bin/sh\nexec "{}" -m pip --python "{}" --disable-pip-version-check "$@"\n'


def git(*arguments: str, cwd: Path) -> str:
    identity = ("-c", "user.name=A User", "-c", "user.email=user@example.org")
    done = subprocess.run(["git", *identity, *arguments], cwd=cwd, capture_output=True, text=True, check=True)
    return done.stdout


def commit(folder: Path) -> None:
    git("init", "-q", cwd=folder)
    git("add", "-A", cwd=folder)
    git("commit", "-q", "-m", "An application", cwd=folder)


def check_schema(schema: str, path: Path) -> None:
    command = [sys.executable, "-m", "check_jsonschema", "--builtin-schema", f"vendor.{schema}", str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.fixture
def application(tmp_path: Path, installed: Installed) -> Path:
    """Return a new application folder under version control, with a name that a shell must quote."""
    folder = tmp_path / "An app"
    done = installed.run("init", str(folder), "--profile", "pure_sender", "--ci", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    commit(folder)
    return folder


def runner(tmp_path: Path, installed: Installed) -> dict[str, str]:
    """Return the environment of a fresh machine: Python without the generator, and the wheel where pip looks."""
    environment_with_dependencies(tmp_path / "python")
    programs = tmp_path / "python" / "bin"
    (programs / "pip").write_text(PIP.format(sys.executable, programs / "python"))
    (programs / "pip").chmod(0o755)
    return clean_environ(
        PATH=f"{programs}{os.pathsep}{os.environ['PATH']}",
        PIP_NO_INDEX="1",
        PIP_FIND_LINKS=str(installed.wheel.parent),
        XDG_CACHE_HOME=str(tmp_path / "cache"),
    )


@pytest.mark.system
def test_the_workflow_passes_in_a_fresh_clone(
    application: Path, tmp_path: Path, installed: Installed
) -> None:
    check_schema("github-workflows", application / WORKFLOW)
    steps = steps_of(application / WORKFLOW)
    assert [step["uses"] for step in steps if "uses" in step] == USED
    (job,) = yaml.safe_load((application / WORKFLOW).read_text())["jobs"].values()
    assert job["if"] == "vars.MICROROS_GEN != ''", "nothing is red before pip can find the generator"
    git("clone", "-q", str(application), "clone", cwd=tmp_path)
    environment = runner(tmp_path, installed)
    variables = {"MICROROS_GEN": str(installed.wheel)}
    done = run_steps(steps, tmp_path / "clone", environment, variables)
    assert done.returncode == 0, done.stdout + done.stderr
    assert (tmp_path / "clone/build/an_app").is_file()
    sized = run_step({"run": "microros-gen size build --format json"}, tmp_path / "clone", environment, {})
    assert json.loads(sized.stdout)["image"] == str(tmp_path / "clone/build/an_app"), sized.stderr
    assert git("status", "--porcelain", cwd=tmp_path / "clone") == "", "what is built is ignored"

    # A change whose consequence is not in the golden copy.
    settings = tmp_path / "clone/microros.yaml"
    settings.write_text(settings.read_text().replace("topic: count", "topic: tally"))
    done = run_steps(steps, tmp_path / "clone", environment, variables)
    assert done.returncode == 1
    assert '+  "/tally"' in done.stdout or "tally" in done.stdout
    assert re.search(r"[0-9]+ of [0-9]+ files differ from golden", done.stderr)


@pytest.mark.long
def test_the_action_does_the_same(application: Path, tmp_path: Path, installed: Installed) -> None:
    """It builds the wheel of the repository, so it needs the network, as on GitHub."""
    environment = clean_environ(
        GITHUB_ACTION_PATH=str(copy_of_repository(tmp_path / "action")),
        RUNNER_TEMP=str(tmp_path),
        XDG_CACHE_HOME=str(tmp_path / "cache"),
    )
    inputs = {**defaults_of(ACTION), "python": sys.executable}
    done = run_steps(steps_of(ACTION), application, environment, inputs)
    assert done.returncode == 0, done.stdout + done.stderr
    (application / "golden/sources.txt").write_text("")
    done = run_steps(steps_of(ACTION)[1:], application, environment, inputs)
    assert done.returncode == 1
    assert "--- " in done.stdout


@pytest.mark.system
def test_the_action_is_one(application: Path, tmp_path: Path, installed: Installed) -> None:
    """Its form, and its last step with the generator where the first one puts it."""
    check_schema("github-actions", ACTION)
    install, compare = steps_of(ACTION)
    assert '"$GITHUB_ACTION_PATH"' in install["run"]
    (tmp_path / "microros-gen").symlink_to(installed.program.parents[1])
    environment = clean_environ(RUNNER_TEMP=str(tmp_path), XDG_CACHE_HOME=str(tmp_path / "cache"))
    inputs = {**defaults_of(ACTION), "interface-path": str(ROOT / "microros_gen/idl")}
    assert run_steps([compare], application, environment, inputs).returncode == 0
    faulty = run_steps([compare], application, environment, {**inputs, "interface-path": "no such"})
    assert faulty.returncode == 2
    assert "the interface path 'no such' does not exist" in faulty.stderr


@pytest.mark.system
def test_the_hook_is_one(application: Path, installed: Installed) -> None:
    """Its form, its files, and its command as pre-commit starts it."""
    command = [sys.executable, "-m", "pre_commit", "validate-manifest", str(HOOKS)]
    assert subprocess.run(command, check=False).returncode == 0
    (hook,) = yaml.safe_load(HOOKS.read_text(encoding="utf-8"))
    for path in (
        "microros.yaml",
        "app/microros.yaml",
        "msgs/msg/A.msg",
        "golden/src/a/b.c",
        "boards/mine.yaml",
    ):
        assert re.search(hook["files"], path), path
    for path in ("main.c", "README.md", "src/golden.c"):
        assert not re.search(hook["files"], path), path
    words: list[str] = [*hook["entry"].split(), *hook["args"]]
    program, *arguments = words
    assert program == "microros-gen"
    assert installed.run(*arguments, folder=application).returncode == 0
    (application / "golden/sources.txt").unlink()
    assert installed.run(*arguments, folder=application).returncode == 1


@pytest.mark.long
def test_pre_commit_runs_the_hook_of_a_clone(application: Path, tmp_path: Path) -> None:
    """pre-commit makes the hook's environment itself, so it needs the network."""
    repository = copy_of_repository(tmp_path / "repository")
    commit(repository)
    configuration = {
        "repos": [
            {
                "repo": str(repository),
                "rev": git("rev-parse", "HEAD", cwd=repository).strip(),
                "hooks": [{"id": "microros-gen-check"}],
            }
        ]
    }
    (application / ".pre-commit-config.yaml").write_text(yaml.safe_dump(configuration))
    git("add", "-A", cwd=application)
    command = [sys.executable, "-m", "pre_commit", "run", "--all-files"]
    environment = clean_environ(
        PRE_COMMIT_HOME=str(tmp_path / "hooks"), XDG_CACHE_HOME=str(tmp_path / "cache")
    )
    done = subprocess.run(
        command, cwd=application, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert re.search(r"microros-gen check\.+Passed", done.stdout)
    settings = application / "microros.yaml"
    settings.write_text(settings.read_text().replace("topic: count", "topic: tally"))
    done = subprocess.run(
        command, cwd=application, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 1
    assert "- exit code: 1" in done.stdout
    assert "files differ from golden" in done.stdout


def copy_of_repository(folder: Path) -> Path:
    """Return a copy of what is under version control and as it is now, without tests."""
    listed = git("ls-files", "-co", "--exclude-standard", cwd=ROOT).splitlines()
    for name in listed:
        if not name.startswith(("tests/", "docs/", "examples/")) and (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, folder / name)
    return folder
