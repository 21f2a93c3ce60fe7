# SPDX-License-Identifier: Apache-2.0
"""`make release`: what it builds can be installed without a compiler, and what it refuses to release."""

from __future__ import annotations

import hashlib
import json
import re
import subprocess
import tarfile
from pathlib import Path

import pytest

from tests.support.environments import dependencies
from tests.support.installed import copy_of_sources
from tests.support.paths import ROOT
from tests.support.sharing import ShareResult
from tests.tools import release
from tests.tools.release import changelog_section, contents, make_release, obstacles, try_wheel, version

CHANGELOG = "# Changelog\n\n## Unreleased\n\n- New.\n\n## 0.2.0 (2026-01-01)\n\n### Tool\n\n- A.\n\n## 0.1.0\n\n- B.\n"


def test_the_section_of_a_version() -> None:
    assert changelog_section(CHANGELOG, "0.2.0") == "### Tool\n\n- A.\n"
    assert changelog_section(CHANGELOG, "0.1.0") == "- B.\n"
    assert changelog_section(CHANGELOG, "0.1") is None or changelog_section(CHANGELOG, "0.3.0") is None
    assert changelog_section("## 1.0\n\n## 0.9\n\n- B.\n", "1.0") is None, "an empty section says nothing"


def git(folder: Path, *arguments: str) -> None:
    identity = ("-c", "user.name=A User", "-c", "user.email=user@example.org")
    subprocess.run(["git", *identity, *arguments], cwd=folder, check=True, capture_output=True)


@pytest.mark.builds
def test_what_cannot_be_released(tmp_path: Path) -> None:
    (tmp_path / "microros_gen").mkdir()
    (tmp_path / "docs").mkdir()
    (tmp_path / "microros_gen/__init__.py").write_text('__version__ = "0.2.0"\n')
    (tmp_path / "docs/changelog.md").write_text("# Changelog\n\n## Unreleased\n\n- A.\n")
    git(tmp_path, "init", "-q")
    assert [reason.split(" (")[0] for reason in obstacles(tmp_path)] == [
        "there are changes that are not committed",
        "docs/changelog.md has no section `## 0.2.0`: give it to what is below `## Unreleased`",
    ]
    (tmp_path / "docs/changelog.md").write_text(CHANGELOG)
    git(tmp_path, "add", "-A")
    git(tmp_path, "commit", "-q", "-m", "A")
    assert obstacles(tmp_path) == []
    git(tmp_path, "tag", "v0.2.0")
    assert obstacles(tmp_path) == ["the tag v0.2.0 exists: raise __version__ in microros_gen/__init__.py"]


@pytest.mark.system
def test_a_release(tmp_path: Path, share_result: ShareResult) -> None:
    """Twice the same bytes; the wheel was installed and used in an environment without a compiler."""

    def digest_of(wheel: Path, _: Path) -> str:
        return hashlib.sha256(wheel.read_bytes()).hexdigest()

    share_result(
        release, "try_wheel", digest_of, lambda wheel, _: try_wheel(wheel, tmp_path / digest_of(wheel, _))
    )
    source = tmp_path / "source"
    copy_of_sources(source)
    (source / "docs").mkdir()
    (source / "docs/changelog.md").write_bytes((ROOT / "docs/changelog.md").read_bytes())
    out = tmp_path / "release"
    make_release(source, out, "- A.\n")
    (wheel,), (sdist,) = out.glob("*.whl"), out.glob("*.tar.gz")
    assert wheel.name == f"microros_gen-{version()}-py3-none-any.whl"
    assert sdist.name == f"microros_gen-{version()}.tar.gz"
    assert (out / "changes.md").read_text() == "- A.\n"
    names = {
        line.split("  ")[1]: line.split("  ")[0] for line in (out / "SHA256SUMS").read_text().splitlines()
    }
    assert set(names) == {wheel.name, sdist.name, "changes.md", "sbom.cdx.json"}
    for name, digest in names.items():
        assert hashlib.sha256((out / name).read_bytes()).hexdigest() == digest

    files = {p.relative_to(ROOT).as_posix() for p in (ROOT / "microros_gen").rglob("*") if p.is_file()}
    files = {name for name in files if "__pycache__" not in name}
    assert files <= set(contents(wheel)), "every file of the package is in the wheel"
    with tarfile.open(sdist) as opened:
        top = f"microros_gen-{version()}"
        inside = {name.removeprefix(f"{top}/") for name in opened.getnames()}
    assert files | {"LICENSE", "README.md", "docs/changelog.md", "pyproject.toml"} <= inside
    assert not [name for name in inside if name.startswith(("tests", "examples", "build"))]

    bill = json.loads((out / "sbom.cdx.json").read_text(encoding="utf-8"))
    own = bill["metadata"]["component"]
    assert (own["name"], own["version"], own["licenses"][0]["license"]["name"]) == (
        "microros-gen",
        version(),
        "Apache-2.0",
    )
    assert own["hashes"] == [{"alg": "SHA-256", "content": names[wheel.name]}]
    needed = {re.split(r"[<>=]", requirement)[0] for requirement in dependencies()}
    listed = {component["name"].lower() for component in bill["components"]}
    assert needed <= listed
    assert listed - needed <= {"markupsafe"}, "what they need in turn"
    assert all(component["licenses"] for component in bill["components"])
    references = [component["bom-ref"] for component in bill["components"]]
    assert bill["dependencies"] == [{"ref": own["bom-ref"], "dependsOn": references}]

    again = tmp_path / "again"
    make_release(source, again, "- A.\n")
    assert (again / "SHA256SUMS").read_text() == (out / "SHA256SUMS").read_text()
