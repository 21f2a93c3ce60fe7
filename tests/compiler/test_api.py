# SPDX-License-Identifier: Apache-2.0
"""The Python API: each step returns data, mistakes are `UserError`, warnings are objects, nothing is printed."""

from __future__ import annotations

import dataclasses
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.diagnostics import Source
from microros_gen.documents.ahead import Ahead, compute_ahead
from microros_gen.interfaces.find import shipped_folder

SHIPPED = (shipped_folder(),)
OPTIONS = compiler.Options(profiles=("pure_sender",), interface_paths=SHIPPED)


@pytest.fixture(autouse=True)
def _nothing_is_printed(
    capfd: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[None]:
    monkeypatch.chdir(tmp_path)
    yield
    assert capfd.readouterr() == ("", "")


@pytest.mark.builds
def test_the_steps_one_by_one(tmp_path: Path) -> None:
    request = compiler.read(OPTIONS)
    resolved = compiler.resolve(request)
    planned = compiler.plan(resolved)
    files = compiler.render(planned)
    out = compiler.output_folder(resolved)
    assert out == Path("build/pure_sender")
    report = compiler.write(files, out)
    assert set(report.written) == set(files)
    built = compiler.compile(planned, out)
    assert (out / built.report.library).is_file()
    assert built.usage is None or built.usage.flash > 0
    assert compiler.differences(files, out) == ()


def test_generate_is_all_steps_up_to_writing(tmp_path: Path) -> None:
    generated = compiler.generate(OPTIONS, tmp_path / "out")
    assert generated.out == tmp_path / "out"
    assert (generated.out / "manifest.json").read_bytes() == compiler.render(generated.planned)[
        "manifest.json"
    ]
    again = compiler.generate(OPTIONS, tmp_path / "out")
    assert again.report.written == ()


@pytest.mark.parametrize("fails", [False, True])
def test_a_second_process_prints_the_same_files_in_the_same_order(
    fails: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where it fails, the first process prints its half, too."""
    started: list[Ahead] = []

    def compute(work: Callable[[Iterator[str]], Mapping[str, bytes]]) -> Ahead | None:
        ahead = compute_ahead(broken if fails else work)
        started.extend([] if ahead is None else [ahead])
        return ahead

    def broken(names: Iterator[str]) -> Mapping[str, bytes]:
        raise RuntimeError(*names)

    packages = ("geometry_msgs", "std_srvs")
    planned = compiler.plan(
        compiler.resolve(compiler.read(dataclasses.replace(OPTIONS, interfaces=packages)))
    )
    alone = compiler.render(planned)
    monkeypatch.setattr("microros_gen.typesupport.views.types._WORTH_A_PROCESS", 2)
    monkeypatch.setattr("microros_gen.typesupport.views.types.compute_ahead", compute)
    assert list(compiler.render(planned, fork=True).items()) == list(alone.items())
    if not started:
        pytest.skip("one processor, or no fork")


def test_a_difference_is_a_unified_diff(tmp_path: Path) -> None:
    generated = compiler.generate(OPTIONS, tmp_path / "out")
    header = tmp_path / "out/include/microros_config.h"
    header.write_text(header.read_text(encoding="utf-8") + "/* changed */\n", encoding="utf-8")
    (difference,) = compiler.differences(compiler.render(generated.planned), tmp_path / "out")
    assert "-/* changed */" in difference


@pytest.mark.parametrize(
    ("text", "step", "message"),
    [
        ("version: 1\nprofiles: [pure_sender]\nserial: 1\n", "read", "serial"),
        ("version: 1\nprofiles: [pure_sendr]\n", "resolve", "pure_sendr"),
        ("version: 1\nprofiles: [pure_sender]\ninterfaces: [std_msgs/msg/Int33]\n", "plan", "Int33"),
    ],
)
def test_a_mistake_is_an_object_with_its_place(text: str, step: str, message: str) -> None:
    done: list[str] = []

    def steps() -> None:
        done.append("read")
        request = compiler.read_source(
            Source("microros.yaml", text), Path(), compiler.Options(interface_paths=SHIPPED)
        )
        done.append("resolve")
        resolved = compiler.resolve(request)
        done.append("plan")
        compiler.plan(resolved)

    with pytest.raises(compiler.UserError) as caught:
        steps()
    assert done[-1] == step
    (diagnostic,) = caught.value.diagnostics
    assert isinstance(diagnostic, compiler.Diagnostic)
    assert message in diagnostic.message
    assert diagnostic.span is not None
    assert diagnostic.span.line == text[: text.index(message)].count("\n") + 1


def test_a_warning_is_an_object_and_is_there_once() -> None:
    text = "version: 1\nprofiles: [pure_sender]\ntarget: {name: qemu-mps2-an386}\n"
    resolved = compiler.resolve(
        compiler.read_source(Source("microros.yaml", text), Path(), compiler.Options(interface_paths=SHIPPED))
    )
    (warning,) = compiler.plan(resolved).warnings
    assert "unique id" in warning.message
    assert warning.span is not None
    assert warning.span.line == 3


def test_importing_the_package_imports_nothing_else() -> None:
    program = (
        "import sys; import microros_gen.compiler as c;"
        "found = sorted(m for m in sys.modules if m.startswith('microros_gen.'));"
        "assert found == ['microros_gen.compiler'], found;"
        "assert all(getattr(c, name) for name in c.__all__)"
    )
    subprocess.run([sys.executable, "-c", program], check=True)


def test_an_attribute_that_is_not_exported() -> None:
    with pytest.raises(AttributeError, match="no attribute 'plann'"):
        compiler.plann  # noqa: B018
