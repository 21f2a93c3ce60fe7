# SPDX-License-Identifier: Apache-2.0
"""`make release`: checks, builds and tests what a release consists of, in build/release. Nothing is uploaded.

The version is that of microros_gen/__init__.py; docs/changelog.md must have a section for it. The commit must be what
is checked out, without changes. In build/release are then: wheel, sdist, the changelog's section, an SBOM (CycloneDX
1.5, JSON) and SHA256SUMS.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from tests.support.environments import clean_environ
from tests.support.installed import environment_with_dependencies, install_file
from tests.support.paths import ROOT

OUT = ROOT / "build" / "release"
_LICENSES = {"MIT License": "MIT", "BSD License": "BSD-3-Clause"}
# Names, versions and licenses of what an environment has, as its own Python sees them.
_INSTALLED = """\
import json
from importlib.metadata import distributions
found = []
for d in distributions():
    m = d.metadata
    license = m.get("License-Expression") or m.get("License") or ""
    classifiers = [c for c in m.get_all("Classifier") or () if c.startswith("License ::")]
    found.append([m["Name"], d.version, license, classifiers])
print(json.dumps(found))
"""


def version(root: Path = ROOT) -> str:
    """Return the version of the package."""
    text = (root / "microros_gen/__init__.py").read_text(encoding="utf-8")
    match = re.search(r'^__version__ = "([^"]+)"$', text, re.MULTILINE)
    assert match
    return match[1]


def changelog_section(text: str, wanted: str) -> str | None:
    """Return the section of a version in a changelog, without its heading; None: it does not exist or is empty."""
    match = re.search(rf"^## {re.escape(wanted)}\b[^\n]*\n(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)
    return match[1].strip() + "\n" if match and match[1].strip() else None


def obstacles(root: Path = ROOT) -> list[str]:
    """Return why there can be no release of the checkout `root`."""
    found = []
    status = subprocess.run(
        ["git", "status", "--porcelain"], cwd=root, capture_output=True, text=True, check=True
    )
    if status.stdout:
        found.append("there are changes that are not committed (git status)")
    wanted = version(root)
    changelog = (root / "docs/changelog.md").read_text(encoding="utf-8")
    if changelog_section(changelog, wanted) is None:
        found.append(
            f"docs/changelog.md has no section `## {wanted}`: give it to what is below `## Unreleased`"
        )
    tags = subprocess.run(
        ["git", "tag", "--list", f"v{wanted}"], cwd=root, capture_output=True, text=True, check=True
    )
    if tags.stdout.strip():
        found.append(f"the tag v{wanted} exists: raise __version__ in microros_gen/__init__.py")
    return found


def build(source: Path, out: Path) -> tuple[Path, Path]:
    """Build the wheel and the sdist of the folder `source` into `out`; return their paths."""
    command = [sys.executable, "-m", "hatchling", "build", "-d", str(out)]
    done = subprocess.run(command, cwd=source, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"hatchling fails:\n{done.stdout}{done.stderr}")
    (wheel,), (sdist,) = out.glob("*.whl"), out.glob("*.tar.gz")
    return wheel, sdist


def contents(wheel: Path) -> Mapping[str, str]:
    """Return the hash of each file of a wheel."""
    with zipfile.ZipFile(wheel) as opened:
        return {name: hashlib.sha256(opened.read(name)).hexdigest() for name in opened.namelist()}


def wheel_of_sdist(sdist: Path, folder: Path) -> Path:
    """Build the wheel of a sdist, as pip does where no wheel fits."""
    with tarfile.open(sdist) as opened:
        opened.extractall(folder, filter="data")
    (source,) = folder.iterdir()
    (folder / "wheel").mkdir()
    return build(source, folder / "wheel")[0]


def try_wheel(wheel: Path, folder: Path) -> Path:
    """Install a wheel into a fresh environment and use it where no compiler is; return the environment.

    Raises SystemExit where something fails.
    """
    environment = folder / "environment"
    environment_with_dependencies(environment)
    install_file(environment, wheel)
    program = environment / "bin" / "microros-gen"
    variables = clean_environ(PATH=str(environment / "bin"), XDG_CACHE_HOME=str(folder / "cache"))
    expected = f"microros-gen, version {wheel.name.split('-')[1]}\n"
    for arguments in (
        ("--version",),
        ("generate", "--profile", "pure_sender", "-o", "out"),
        ("interfaces", "sensor_msgs/msg/Imu"),
        ("schema", "application"),
        ("init", "robot"),
    ):
        done = subprocess.run(
            [str(program), *arguments],
            cwd=folder,
            env=variables,
            capture_output=True,
            text=True,
            check=False,
        )
        if done.returncode != 0 or (arguments == ("--version",) and done.stdout != expected):
            raise SystemExit(f"microros-gen {' '.join(arguments)} fails:\n{done.stdout}{done.stderr}")
    return environment


def sbom(wheel: Path, environment: Path) -> dict[str, Any]:
    """Return the bill of materials of the wheel and of what it needs, with the versions in `environment`."""
    python = str(environment / "bin" / "python")
    done = subprocess.run([python, "-c", _INSTALLED], capture_output=True, text=True, check=True)
    components = {_key(found[0]): found for found in json.loads(done.stdout)}
    name, own_version, license, classifiers = components.pop("microros-gen")
    own = _component(name, own_version, license, classifiers, "application")
    own["hashes"] = [{"alg": "SHA-256", "content": hashlib.sha256(wheel.read_bytes()).hexdigest()}]
    others = [_component(*components[key]) for key in sorted(components) if key not in _TOOLS]
    return {
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": {"component": own},
        "components": others,
        "dependencies": [{"ref": own["bom-ref"], "dependsOn": [c["bom-ref"] for c in others]}],
    }


_TOOLS = ("pip", "setuptools", "wheel")
"""What an environment has for installing."""


def _key(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def _component(
    name: str, own: str, license: str, classifiers: list[str], kind: str = "library"
) -> dict[str, Any]:
    reference = f"pkg:pypi/{_key(name)}@{own}"
    found: dict[str, Any] = {
        "type": kind,
        "bom-ref": reference,
        "name": name,
        "version": own,
        "purl": reference,
    }
    last = classifiers[0].rsplit(" :: ", 1)[-1] if classifiers else ""
    text = license if license and "\n" not in license else _LICENSES.get(last, last)
    if text:
        found["licenses"] = [{"license": {"name": text}}]
    return found


def make_release(source: Path, out: Path, notes: str) -> None:
    """Build and test the folder `source`, and write everything of the release to `out`."""
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    wheel, sdist = build(source, out)
    with tempfile.TemporaryDirectory() as folder:
        again = wheel_of_sdist(sdist, Path(folder))
        if contents(again) != contents(wheel):
            raise SystemExit("the wheel that is built from the sdist differs")
    with tempfile.TemporaryDirectory() as folder:
        environment = try_wheel(wheel, Path(folder))
        text = json.dumps(sbom(wheel, environment), indent=2, ensure_ascii=False) + "\n"
    (out / "sbom.cdx.json").write_text(text, encoding="utf-8", newline="\n")
    (out / "changes.md").write_text(notes, encoding="utf-8", newline="\n")
    lines = [f"{hashlib.sha256(p.read_bytes()).hexdigest()}  {p.name}\n" for p in sorted(out.iterdir())]
    (out / "SHA256SUMS").write_text("".join(lines), encoding="utf-8", newline="\n")


def main() -> int:
    """Make the release of the commit that is checked out; 2 and the reasons where that cannot be."""
    found = obstacles()
    if found:
        print("\n".join(f"no release: {reason}" for reason in found))
        return 2
    notes = changelog_section((ROOT / "docs/changelog.md").read_text(encoding="utf-8"), version())
    assert notes is not None
    with tempfile.TemporaryDirectory() as folder:
        archive = Path(folder) / "source.tar"
        subprocess.run(["git", "archive", "-o", str(archive), "HEAD"], cwd=ROOT, check=True)
        source = Path(folder) / "source"
        with tarfile.open(archive) as opened:
            opened.extractall(source, filter="data")
        make_release(source, OUT, notes)
    print(f"{os.path.relpath(OUT)}: {', '.join(sorted(p.name for p in OUT.iterdir()))}")
    print(f"next: git tag v{version()}, push the tag, and upload the wheel and the sdist")
    return 0


if __name__ == "__main__":
    sys.exit(main())
