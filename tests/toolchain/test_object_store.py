# SPDX-License-Identifier: Apache-2.0
"""The store of objects: what is the same is compiled once, what differs in anything is compiled, and damage is seen."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import pytest

from microros_gen.diagnostics import UserError
from microros_gen.toolchain.compile import BuildReport, compile_tree, object_name
from microros_gen.toolchain.object_store import Found, ObjectStore
from microros_gen.toolchain.toolchain import Toolchain
from tests.support.command_line import Runner

pytestmark = pytest.mark.builds

FILES = {
    "include/microros_config.h": "#define MICROROS_A 1\n#define MICROROS_B 2\n",
    "include/x.h": '#include "microros_config.h"\nint f(int a);\n',
    "src/x/x.c": '#include "x.h"\nint f(int a)\n{\n  return a + MICROROS_A;\n}\n',
    "examples/main.c": '#include "x.h"\nint main(void)\n{\n  return f(1);\n}\n',
}
SOURCE = "src/x/x.c"
DEBUG = ("-O1", "-g")


class Workshop:
    """Builds of small trees with one store."""

    def __init__(self, folder: Path) -> None:
        path = "/usr/local/bin:/usr/bin:/bin"  # not those of the tests' own cache
        compiler, archiver = shutil.which("gcc", path=path), shutil.which("ar", path=path)
        if compiler is None or archiver is None:
            pytest.skip("no gcc")
        self.tools = Toolchain(compiler, archiver, ("-O1",), (), ())
        self.folder = folder
        self.store = ObjectStore(folder / "store")

    def build(
        self,
        out: str = "a",
        files: Mapping[str, str] | None = None,
        flags: tuple[str, ...] = ("-O1",),
        with_store: bool = True,
    ) -> BuildReport:
        """Build from nothing the files above, those of `files` changed."""
        home = self.folder / out
        shutil.rmtree(home, ignore_errors=True)
        for name, text in {**FILES, **(files or {})}.items():
            (home / name).parent.mkdir(parents=True, exist_ok=True)
            (home / name).write_text(text)
        tools, store = replace(self.tools, c_flags=flags), self.store if with_store else None
        return compile_tree(home, [SOURCE], "examples/main.c", None, tools, store=store)

    def object(self, out: str = "a") -> bytes:
        return (self.folder / out / object_name(SOURCE)).read_bytes()

    def entries(self) -> list[Path]:
        return [path for path in (self.folder / "store").rglob("*") if path.is_file()]


@pytest.fixture
def workshop(tmp_path: Path) -> Workshop:
    return Workshop(tmp_path)


def test_the_same_is_compiled_once_and_has_the_same_bytes(workshop: Workshop) -> None:
    first = workshop.build(flags=DEBUG)
    compiled = workshop.object()
    again = workshop.build(flags=DEBUG)
    assert (first.compiled, first.copied) == (2, 0)
    assert (again.compiled, again.copied, again.kept) == (0, 2, 0)
    assert workshop.object() == compiled
    workshop.build(flags=DEBUG, with_store=False)
    assert workshop.object() == compiled


def test_a_copied_object_is_up_to_date_in_the_next_build(workshop: Workshop) -> None:
    workshop.build()
    workshop.build()
    home = workshop.folder / "a"
    report = compile_tree(home, [SOURCE], "examples/main.c", None, workshop.tools, store=workshop.store)
    assert (report.compiled, report.copied, report.kept) == (0, 0, 2)


@pytest.mark.parametrize(("flags", "compiled"), [(("-O1",), 0), (DEBUG, 2)])
def test_the_folder_counts_where_debug_information_names_it(
    workshop: Workshop, flags: tuple[str, ...], compiled: int
) -> None:
    workshop.build("a", flags=flags)
    assert workshop.build("b", flags=flags).compiled == compiled
    workshop.build("c", flags=flags, with_store=False)
    assert (workshop.object("b") == workshop.object("c")) == (compiled == 0)


@pytest.mark.parametrize(
    ("name", "text", "compiled"),
    [
        ("include/x.h", FILES["include/x.h"] + "int g(int a);\n", 2),
        (SOURCE, FILES[SOURCE].replace("a +", "a -"), 1),
        ("include/microros_config.h", "#define MICROROS_A 4\n#define MICROROS_B 2\n", 1),
        ("include/microros_config.h", "#define MICROROS_A 1\n#define MICROROS_B 4\n", 0),
        ("include/microros_config.h", "#define MICROROS_A MICROROS_B\n#define MICROROS_B 4\n", 1),
        ("include/microros_config.h", FILES["include/microros_config.h"] + "#error no\n", -1),
    ],
)
def test_what_reads_something_else_is_compiled(
    workshop: Workshop, name: str, text: str, compiled: int
) -> None:
    workshop.build()
    if compiled < 0:
        with pytest.raises(UserError, match="#error no"):
            workshop.build(files={name: text})
        return
    report = workshop.build(files={name: text})
    assert report.compiled == compiled
    copied = workshop.object()
    workshop.build(files={name: text}, with_store=False)
    assert workshop.object() == copied


def test_flags_environment_and_headers_outside_count(
    workshop: Workshop, monkeypatch: pytest.MonkeyPatch
) -> None:
    outside = workshop.folder / "outside"
    outside.mkdir()
    (outside / "limits_of_y.h").write_text("#define Y 1\n")
    files = {SOURCE: "#include <limits_of_y.h>\n" + FILES[SOURCE].replace("a +", "a + Y +")}
    monkeypatch.setenv("C_INCLUDE_PATH", str(outside))
    assert workshop.build(files=files).compiled == 2
    assert workshop.build(files=files).compiled == 0
    (outside / "limits_of_y.h").write_text("#define Y 2\n")
    assert workshop.build(files=files).compiled == 1, "a header of the system changed"
    assert workshop.build(files=files, flags=("-O2",)).compiled == 2
    assert workshop.build(files=files).compiled == 0
    monkeypatch.setenv("C_INCLUDE_PATH", f"{outside}:{workshop.folder}")
    assert workshop.build(files=files).compiled == 2


def test_another_compiler_counts(workshop: Workshop) -> None:
    """Here the same program with another time: an update."""
    own = workshop.folder / "bin" / "gcc"
    own.parent.mkdir()
    own.write_text(f'#!/bin/sh\nexec {workshop.tools.compiler} "$@"\n')
    own.chmod(0o755)
    workshop.tools = replace(workshop.tools, compiler=str(own))
    workshop.build()
    assert workshop.build().compiled == 0
    os.utime(own, ns=(1, 1))
    assert workshop.build().compiled == 2


def test_what_names_the_time_or_this_processor_is_not_kept(workshop: Workshop) -> None:
    files = {SOURCE: FILES[SOURCE] + "extern const char * when;\nconst char * when = __TIME__;\n"}
    workshop.build(files=files)
    assert workshop.build(files=files).compiled == 1
    workshop.build(flags=("-O1", "-march=native"))
    assert workshop.build(flags=("-O1", "-march=native")).compiled == 2


def test_an_error_is_reported_each_time(workshop: Workshop) -> None:
    files = {SOURCE: FILES[SOURCE].replace("a +", "b +")}
    for _ in range(2):
        with pytest.raises(UserError, match="undeclared"):
            workshop.build(files=files)


@pytest.mark.parametrize("damage", [b"", b"{}", b"[[1]]", b'[["/dev/null"]]', b"x" * 500])
def test_damage_means_that_the_compiler_runs(workshop: Workshop, damage: bytes) -> None:
    workshop.build()
    good = workshop.object()
    for path in workshop.entries():
        path.write_bytes(damage)
    assert workshop.build().compiled == 2
    assert workshop.object() == good
    assert workshop.build().compiled == 0, "what was damaged was replaced"


def test_a_changed_byte_of_an_object_is_seen(workshop: Workshop) -> None:
    workshop.build()
    good = workshop.object()
    for path in workshop.entries():
        if path.suffix == ".bin":
            content = bytearray(path.read_bytes())
            content[-1] ^= 1
            path.write_bytes(content)
    assert workshop.build().compiled == 2
    assert workshop.object() == good


def test_a_store_that_cannot_be_written_is_no_error(workshop: Workshop) -> None:
    (workshop.folder / "store").write_text("a file")
    assert workshop.build().compiled == 2
    assert workshop.build().compiled == 2


def test_builds_side_by_side_find_whole_entries(tmp_path: Path) -> None:
    """Each finds nothing or all of it, whoever wrote it."""
    content = bytes(range(256)) * 400

    def keep_and_find(_: int) -> bool:
        store = ObjectStore(tmp_path, largest=300_000)
        store.keep("aa", "".join, Found(["x"], {".o": content, ".d": b"d"}))
        found = store.find("aa", "".join)
        store.close()
        return found is None or found.outputs == {".o": content, ".d": b"d"}

    with ThreadPoolExecutor(8) as pool:
        assert all(pool.map(keep_and_find, range(200)))
    assert not list(tmp_path.glob("*/*.????????????????")), "no file that is half written stays"


def test_the_store_has_a_size_and_keeps_what_was_used_last(tmp_path: Path) -> None:
    largest = 100_000
    for number in range(100):
        store = ObjectStore(tmp_path, largest)
        store.keep(f"{number:02}", "".join, Found([f"x{number}"], {".o": bytes(9_000)}))
        _age(tmp_path)
        assert store.find("00", "".join) is not None, "it is used all the time"
        store.close()
        held = sum(path.stat().st_size for path in tmp_path.rglob("*") if path.is_file())
        assert held <= largest
    store = ObjectStore(tmp_path, largest)
    assert store.find("99", "".join) is not None
    assert store.find("50", "".join) is None


def _age(folder: Path) -> None:
    """Make every file a second older, as if time had passed."""
    for path in folder.rglob("*"):
        found = path.stat()
        os.utime(path, ns=(found.st_atime_ns, found.st_mtime_ns - 1_000_000_000))


def test_it_can_be_switched_off(tmp_path: Path) -> None:
    cache = {"XDG_CACHE_HOME": str(tmp_path)}
    assert ObjectStore.of_user({**cache, "MICROROS_GEN_OBJECTS": "off"}) is None
    store = ObjectStore.of_user(cache)
    assert store is not None
    store.keep("00", "".join, Found(["x"], {".o": b"o"}))
    assert list((tmp_path / "microros-gen" / "objects").glob("*/*.bin"))


def test_the_environment_names_another_folder(tmp_path: Path) -> None:
    store = ObjectStore.of_user(
        {"XDG_CACHE_HOME": str(tmp_path), "MICROROS_GEN_OBJECTS": str(tmp_path / "ci")}
    )
    assert store is not None
    store.keep("00", "".join, Found(["x"], {".o": b"o"}))
    assert list((tmp_path / "ci").glob("*/*.bin"))
    assert not (tmp_path / "microros-gen").exists()


APPLICATION = "version: 1\ncomponents: [cdr]\ninterfaces: [std_msgs/msg/Int32]\n"


def test_build_uses_the_store_of_the_user(run: Runner, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MICROROS_GEN_OBJECTS", "")
    monkeypatch.setenv("CFLAGS", "-O0")
    (folder / "microros.yaml").write_text(APPLICATION)
    first = run("build", "-o", "out")
    assert re.search(r"^compiled +\d+ objects, 0 were up to date$", first.out, re.MULTILINE)
    shutil.rmtree(folder / "out")
    again = run("build", "-o", "out")
    text = r"^compiled +0 objects, \d+ were copied from earlier builds, 0 were up to date$"
    assert re.search(text, again.out, re.MULTILINE)


def test_build_does_without_the_store_where_that_is_off(
    run: Runner, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("MICROROS_GEN_OBJECTS", "off")
    monkeypatch.setenv("CFLAGS", "-O0")
    (folder / "microros.yaml").write_text(APPLICATION)
    assert run("build", "-o", "out").status == 0
    assert not list((folder.parent / "cache").rglob("objects"))
