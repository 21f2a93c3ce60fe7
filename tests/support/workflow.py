# SPDX-License-Identifier: Apache-2.0
"""Runs the commands of the steps of GitHub workflows and composite actions, as they stand."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import yaml

_INPUT = re.compile(r"\$\{\{ (?:inputs|vars)\.([A-Za-z_-]+) \}\}")


def steps_of(path: Path) -> list[dict[str, Any]]:
    """Return the steps of the only job of a workflow, or of a composite action."""
    data = yaml.safe_load(path.read_text(encoding="utf-8"))
    if "runs" in data:
        return list(data["runs"]["steps"])
    (job,) = data["jobs"].values()
    return list(job["steps"])


def defaults_of(action: Path) -> dict[str, str]:
    """Return the inputs of an action with their defaults."""
    inputs = yaml.safe_load(action.read_text(encoding="utf-8"))["inputs"]
    return {name: str(value["default"]) for name, value in inputs.items()}


def run_step(
    step: Mapping[str, Any], folder: Path, environment: Mapping[str, str], inputs: Mapping[str, str]
) -> subprocess.CompletedProcess[str]:
    """Run the command of a step in `folder`, with the shell options that GitHub documents for bash."""
    own = {
        name: _INPUT.sub(lambda m: inputs[m[1]], str(value)) for name, value in step.get("env", {}).items()
    }
    command = str(step["run"])
    assert "${{" not in command, "a command has no expressions: what they bring could be a command too"
    shell = ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", command]
    return subprocess.run(
        shell, cwd=folder, env={**environment, **own}, capture_output=True, text=True, check=False
    )


def run_steps(
    steps: Sequence[Mapping[str, Any]],
    folder: Path,
    environment: Mapping[str, str],
    inputs: Mapping[str, str],
) -> subprocess.CompletedProcess[str]:
    """Run the steps that have a command until one fails; return the last one that was run."""
    done = None
    for step in steps:
        if "run" in step:
            done = run_step(step, folder, environment, inputs)
            if done.returncode != 0:
                break
    assert done is not None
    return done
