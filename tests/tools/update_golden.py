# SPDX-License-Identifier: Apache-2.0
"""`make golden`: rewrites every golden copy below tests/golden, one folder for each profile that is ready.

A golden copy is what `microros-gen generate` writes for a profile alone, from the definitions that ship with the
tool, so that it does not depend on the packages that a machine has. `make golden` and a look at the difference
belong to every change of what is generated.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from tests.support.paths import ROOT

GOLDEN = ROOT / "tests" / "golden"
SHIPPED = ROOT / "microros_gen" / "idl"


def tool(*arguments: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """Run microros-gen of this checkout in `folder`."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-m", "microros_gen", *arguments]
    return subprocess.run(command, cwd=folder, env=environment, text=True, capture_output=True, check=False)


def ready_profiles(folder: Path) -> list[str]:
    """Return the built-in profiles that can be generated."""
    listed = tool("profiles", "--format", "json", folder=folder)
    return [profile["name"] for profile in json.loads(listed.stdout) if profile["status"] == "ready"]


def check_arguments(profile: str, golden: Path = GOLDEN) -> list[str]:
    """Return the call that compares the golden copy of `profile`."""
    paths = ["--interface-path", str(SHIPPED), "--golden", str(golden / profile)]
    return ["check", "--profile", profile, *paths]


def main() -> int:
    """Rewrite all copies, remove those of profiles that are gone; 0 when all were written."""
    with tempfile.TemporaryDirectory() as empty:
        profiles = ready_profiles(Path(empty))
        for profile in profiles:
            result = tool(*check_arguments(profile), "--update", folder=Path(empty))
            print((result.stdout + result.stderr).strip())
            if result.returncode != 0:
                return result.returncode
    for path in sorted(GOLDEN.iterdir()):
        if path.is_dir() and path.name not in profiles:
            shutil.rmtree(path)
            print(f"{path}: removed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
