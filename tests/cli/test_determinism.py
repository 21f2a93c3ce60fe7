# SPDX-License-Identifier: Apache-2.0
"""The same inputs give the same bytes: whatever Python, locale, hash seed, folder, time and path of the output."""

from __future__ import annotations

import getpass
import json
import os
import socket
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.command_line import Runner
from tests.support.environments import clean_environ, interpreters, with_dependencies
from tests.support.paths import ROOT
from tests.support.slices import first

pytestmark = pytest.mark.builds

APPLICATION = """\
version: 1
profiles: [pure_sender]
interfaces: [own_msgs, std_msgs, geometry_msgs, sensor_msgs/msg/Imu, diagnostic_msgs/msg/DiagnosticArray]
pools: {publishers: 4}
limits: {"*": {string: 16, sequence: 3}}
"""
# Characters beyond ASCII, numbers whose text depends on a locale, names whose lower case does (İ, ı).
INTERFACE = """\
# Größe in µm — İstanbul
float64 HALF=0.5
float32 TINY=1e-10
string GREETING="grüß dich"
int32 idle_in_inches 7
float64[3] corner [0.1, 2.5, 1e22]
string title "İyi günler"
wstring<=5 wide "ıç"
"""


def tree(out: Path) -> dict[str, bytes]:
    return {p.relative_to(out).as_posix(): p.read_bytes() for p in sorted(out.rglob("*")) if p.is_file()}


def prepare(folder: Path) -> Path:
    """Write the application and its interfaces below `folder`."""
    package = folder / "interfaces" / "own_msgs" / "msg"
    package.mkdir(parents=True)
    (package / "Idle.msg").write_text(INTERFACE, encoding="utf-8")
    (folder / "microros.yaml").write_text(APPLICATION, encoding="utf-8")
    return folder


def arguments(folder: Path, out: str) -> list[str]:
    paths = [
        "--interface-path",
        str(folder / "interfaces"),
        "--interface-path",
        str(ROOT / "microros_gen/idl"),
    ]
    return ["generate", "-c", str(folder / "microros.yaml"), *paths, "-o", out]


def generate(python: str | Path, folder: Path, current: Path, out: str, **environ: str) -> dict[str, bytes]:
    """Run the tool with `python` in `current`; return the bytes of the output."""
    current.mkdir(parents=True, exist_ok=True)
    variables = clean_environ(PYTHONPATH=str(ROOT), XDG_CACHE_HOME=str(current / "cache"), **environ)
    command = [str(python), "-m", "microros_gen", *arguments(folder, out)]
    done = subprocess.run(command, cwd=current, env=variables, capture_output=True, check=False)
    assert done.returncode == 0, done.stderr.decode("utf-8", "replace")
    return tree(current / out)


@pytest.fixture
def inputs(tmp_path: Path) -> Path:
    return prepare(tmp_path / "inputs")


@pytest.fixture
def expected(run: Runner, inputs: Path, folder: Path) -> dict[str, bytes]:
    """What this process generates."""
    outcome = run(*arguments(inputs, "out"))
    assert outcome.status == 0, outcome.err
    files = tree(folder / "out")
    assert len(files) > 200
    return files


@pytest.mark.system
@pytest.mark.parametrize("version", first(interpreters()), ids=lambda v: f"{v[0]}.{v[1]}")
def test_every_python(
    inputs: Path, tmp_path: Path, expected: dict[str, bytes], version: tuple[int, int]
) -> None:
    if len(interpreters()) == 1:
        pytest.skip("this machine has only one Python from 3.10")
    try:
        python = with_dependencies(interpreters()[version], version)
    except OSError as fault:
        pytest.skip(f"no environment for Python {version}: {str(fault)[:300]}")
    assert generate(python, inputs, tmp_path / "there", "out") == expected


@pytest.mark.parametrize(
    "environ",
    [
        pytest.param(
            {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0", "PYTHONHASHSEED": "1"},
            marks=pytest.mark.variant,
        ),
        {"LC_ALL": "tr_TR.UTF-8", "LANGUAGE": "tr", "PYTHONHASHSEED": "2"},
        {"LC_ALL": "de_DE.ISO-8859-1", "TZ": "Pacific/Kiritimati", "PYTHONHASHSEED": "random"},
        {"COLUMNS": "20", "TERM": "dumb", "PYTHONOPTIMIZE": "2", "PYTHONDONTWRITEBYTECODE": "1"},
    ],
    ids=["ascii", "turkish", "latin 1", "optimized"],
)
def test_every_environment(
    inputs: Path, tmp_path: Path, expected: dict[str, bytes], environ: dict[str, str]
) -> None:
    """A locale that a machine does not have acts like C; hash seeds and -OO differ anyway."""
    assert generate(sys.executable, inputs, tmp_path / "there", "out", **environ) == expected


def test_another_folder_and_an_absolute_output(
    run: Runner, inputs: Path, tmp_path: Path, expected: dict[str, bytes], monkeypatch: pytest.MonkeyPatch
) -> None:
    other = tmp_path / "Ein Ordner, weit weg" / "…"
    other.mkdir(parents=True)
    monkeypatch.chdir(other)
    assert run(*arguments(inputs, str(tmp_path / "absolute" / "out"))).status == 0
    assert tree(tmp_path / "absolute" / "out") == expected


def test_inputs_at_another_place(
    run: Runner, tmp_path: Path, expected: dict[str, bytes], folder: Path
) -> None:
    assert run(*arguments(prepare(tmp_path / "elsewhere"), "second")).status == 0
    assert tree(folder / "second") == expected


def test_relative_and_current_folder(
    run: Runner, inputs: Path, expected: dict[str, bytes], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Everything found from the current folder, as most users have it."""
    monkeypatch.chdir(inputs)
    paths = ["--interface-path", "interfaces", "--interface-path", str(ROOT / "microros_gen/idl")]
    assert run("generate", *paths, "-o", "../relative").status == 0
    assert tree(inputs.parent / "relative") == expected


@pytest.mark.parametrize("when", first([0, 951_782_400, 4_102_444_800]), ids=["1970", "2000-02-29", "2100"])
def test_another_time(run: Runner, inputs: Path, expected: dict[str, bytes], folder: Path, when: int) -> None:
    """Whatever the files' times are; what a clock says is asked for nowhere (see the manifest)."""
    for path in (inputs, *inputs.rglob("*")):
        os.utime(path, (when, when))
    assert run(*arguments(inputs, f"at {when}")).status == 0
    assert tree(folder / f"at {when}") == expected


def test_the_order_of_files_on_the_disk(run: Runner, tmp_path: Path, folder: Path) -> None:
    """Folders list names in the order of their creation on many file systems."""
    names = ["Zeta", "Alpha", "Mid", "Beta"]
    trees = []
    for number, order in enumerate((names, names[::-1])):
        messages = tmp_path / f"set{number}" / "order_msgs" / "msg"
        messages.mkdir(parents=True)
        for name in order:
            (messages / f"{name}.msg").write_text("int32 value\n")
        path = ["--interface-path", str(tmp_path / f"set{number}"), "--interface", "order_msgs"]
        assert run("generate", "--profile", "pure_sender", *path, "-o", f"out{number}").status == 0
        trees.append(tree(folder / f"out{number}"))
    assert trees[0] == trees[1]


def test_crlf_and_a_byte_order_mark_of_an_application_file_change_no_source(
    run: Runner, inputs: Path, expected: dict[str, bytes], folder: Path
) -> None:
    """An editor on another system; only the input's own hash in the manifest may differ."""
    path = inputs / "microros.yaml"
    path.write_bytes(APPLICATION.replace("\n", "\r\n").encode())
    assert run(*arguments(inputs, "crlf")).status == 0
    files = tree(folder / "crlf")
    differing = {name for name in expected if files.get(name) != expected[name]}
    assert differing <= {"manifest.json"}


def test_nothing_depends_on_the_machine(inputs: Path, expected: dict[str, bytes], tmp_path: Path) -> None:
    """No path, host name, user or time: in no file."""
    secrets = [str(tmp_path), str(ROOT), str(Path.home()) + "/", sys.prefix, os.sep + "tmp" + os.sep]
    host, user = socket.gethostname(), getpass.getuser()
    secrets += [word for word in (host, user) if len(word) > 6]
    for name, content in expected.items():
        text = content.decode("utf-8")
        assert not [secret for secret in secrets if secret in text], name
        assert "\r" not in text, name
    manifest = json.loads(expected["manifest.json"])
    assert set(manifest) == {
        "emulator", "entities", "features", "generator", "image", "inputs", "memory", "message_storage", "outputs",
        "plan", "pools", "selection", "target",
        "transport", "types",
    }  # fmt: skip
    assert not [key for key in manifest["inputs"] if "/" in key and key.count("/msg/") != 1]
