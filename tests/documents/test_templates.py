# SPDX-License-Identifier: Apache-2.0
"""Compiled templates: from a file of earlier runs, or from a second process."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.documents.ahead import compute_ahead
from microros_gen.documents.templates import COMMON, common_templates, shared_environment

GENERATE = ("-m", "microros_gen", "generate", "--profile", "pure_sender", "-o", "out")


def generated(folder: Path, **environ: str) -> dict[str, bytes]:
    """Generate in `folder` with a new cache folder; return the files."""
    folder.mkdir(exist_ok=True)
    environment = {**os.environ, "XDG_CACHE_HOME": str(folder / "cache"), **environ}
    subprocess.run([sys.executable, *GENERATE], cwd=folder, env=environment, check=True, capture_output=True)
    out = folder / "out"
    return {path.relative_to(out).as_posix(): path.read_bytes() for path in out.rglob("*") if path.is_file()}


def test_a_run_without_a_cache_leaves_what_the_next_one_takes(tmp_path: Path) -> None:
    """Both processes together compile every template; the third way, from the file, gives the same output."""
    first = generated(tmp_path)
    (kept,) = (tmp_path / "cache" / "microros-gen" / "templates").iterdir()
    compiled = kept.read_bytes()
    (tmp_path / "out" / "README.md").unlink()
    assert generated(tmp_path) == first
    assert kept.read_bytes() == compiled


@pytest.mark.parametrize("profile", ["pure_sender", "pure_action_server"])
def test_the_second_process_compiles_what_the_selected_components_print(profile: str, tmp_path: Path) -> None:
    """The first one compiles nothing that it uses itself: every template that it looks up is known by then."""
    if compute_ahead(of_process) is None:
        pytest.skip("one processor, or no fork")
    program = (
        "import sys; from jinja2 import Environment; from microros_gen.cli.main import main\n"
        "compiled = []; compile = Environment.compile\n"
        "def counted(self, *arguments, **named):\n"
        "    compiled.append(arguments[1])\n"
        "    return compile(self, *arguments, **named)\n"
        "Environment.compile = counted\n"
        f"try: main(['generate', '--profile', '{profile}', '-o', 'out'])\n"
        "except SystemExit: print(compiled)\n"
    )
    environment = {**os.environ, "XDG_CACHE_HOME": str(tmp_path / "cache")}
    command = [sys.executable, "-c", program]
    done = subprocess.run(command, cwd=tmp_path, env=environment, check=True, capture_output=True, text=True)
    assert done.stdout.splitlines()[-1] == "[]", done.stdout


def test_the_second_process_begins_with_what_every_project_prints() -> None:
    """What only some projects print would delay the others: the first process waits for the second one."""
    printed: list[frozenset[str]] = []
    for profile in ("pure_sender", "pure_reader"):
        planned = compiler.plan(compiler.resolve(compiler.read(compiler.Options(profiles=(profile,)))))
        shared_environment.cache_clear()
        compiler.render(planned)
        cache = shared_environment().cache
        assert cache is not None
        printed.append(frozenset(template.name or "" for template in cache.values()))
    assert [sorted(frozenset(COMMON) - names) for names in printed] == [[], []]
    common = {name.split("/")[0] for name in common_templates()}
    assert "support" in common
    assert all(common <= {name.split("/")[0] for name in names} for names in printed)


def test_common_components_say_so_in_their_file(tmp_path: Path) -> None:
    """The line counts where it is a key of the file, not in a text."""
    texts = {
        "one": "component: one\ncommon: true\n",
        "two": "summary: |\n  common: true\n",
        "three": "common: false\n",
    }
    for name, text in texts.items():
        (tmp_path / name / "src").mkdir(parents=True)
        (tmp_path / name / "component.yaml").write_text(text)
        (tmp_path / name / "src/a.c.j2").touch()
    assert list(common_templates(tmp_path)) == ["one/src/a.c.j2"]


def test_a_process_computes(capfd: pytest.CaptureFixture[str]) -> None:
    ahead = compute_ahead(of_process)
    if ahead is None:
        pytest.skip("one processor, or no fork")
    ahead.ask(["first", "with space"])
    ahead.ask(["second"])
    ahead.ask(["x" * 5000])  # more than a pipe takes for sure: no reason to wait
    found = ahead.take()
    assert found["process"] == str(ahead.process).encode()
    assert found["long"] == bytes(1 << 20)
    assert found["requested"] == b"first, with space, second"
    assert capfd.readouterr() == ("", "")
    ahead.ask(["too late"])


def of_process(requested: Iterator[str]) -> Mapping[str, bytes]:
    return {
        "process": str(os.getpid()).encode(),
        "long": bytes(1 << 20),
        "requested": ", ".join(requested).encode(),
    }


def killed(requested: Iterator[str]) -> Mapping[str, bytes]:
    os.kill(os.getpid(), 9)
    return dict.fromkeys(requested, b"")


def broken(requested: Iterator[str]) -> Mapping[str, bytes]:
    raise RuntimeError(*requested)


@pytest.mark.parametrize("compute", [killed, broken])
def test_a_process_that_fails_has_no_result(
    compute: Callable[[Iterator[str]], Mapping[str, bytes]], capfd: pytest.CaptureFixture[str]
) -> None:
    ahead = compute_ahead(compute)
    if ahead is None:
        pytest.skip("one processor, or no fork")
    ahead.ask(["whatever"])
    assert ahead.take() == {}
    assert capfd.readouterr() == ("", "")
    with pytest.raises(ChildProcessError):
        os.waitpid(ahead.process, 0)  # nothing is left of it


def test_no_process_with_threads() -> None:
    end = threading.Event()
    thread = threading.Thread(target=end.wait)
    thread.start()
    try:
        assert compute_ahead(of_process) is None
    finally:
        end.set()
        thread.join()
