# SPDX-License-Identifier: Apache-2.0
"""The package `nuttx`: its settings, and what make takes from its files.

That it builds and runs in NuttX was seen by hand (docs/verification/ports.md); the ports are checked by
tests/platform/test_kernels.py.
"""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import kconfiglib
import pytest

from microros_gen import compiler
from microros_gen.package.render import describe, plan_package, render_package
from tests.support.command_line import Runner

UDP = """\
version: 1
profiles: [pure_sender]
transport: {type: udp, agent: 192.168.1.2:8888}
nodes: [{name: n, publishers: [{topic: t, type: std_msgs/msg/Int32}]}]
"""
KERNEL = """\
config DISABLE_PTHREAD
\tbool "No threads"
config PIPES
\tbool
config PRIORITY_INHERITANCE
\tbool
config PTHREAD_MUTEX_TYPES
\tbool
config SERIAL_TERMIOS
\tbool
config NET_UDP
\tbool
config NET_TCP
\tbool
source "{folder}/Kconfig"
"""
MAKE = """\
CONFIG_MICROROSLIB := y
CONFIG_MICROROSLIB_EXAMPLE := {example}
CONFIG_MICROROSLIB_EXAMPLE_PROGNAME := "microros"
APPDIR := {apps}
INCDIR_PREFIX := -I
include {folder}/Make.defs
$(info CONFIGURED_APPS=$(CONFIGURED_APPS))
$(info CFLAGS=$(CFLAGS))
include Makefile
$(info CSRCS=$(CSRCS))
$(info MAINSRC=$(MAINSRC))
$(info PROGNAME=$(PROGNAME))
all:;
"""


@pytest.fixture(params=["general", "udp"])
def application(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """The package of the general plan, or of a plan for UDP."""
    name = str(request.param)
    config = tmp_path / "udp.yaml" if name == "udp" else None
    if config is not None:
        config.write_text(UDP)
    compiler.write(render_package(plan_package(describe("nuttx"), config)), tmp_path / name)
    return tmp_path / name


def make(folder: Path, application: Path, **values: str) -> dict[str, list[str]]:
    """Return the variables that `folder` sets for NuttX's own files, for which files without rules stand in."""
    if shutil.which("make") is None:
        pytest.skip("no make")
    apps = application.parent / "apps"
    apps.mkdir(exist_ok=True)
    for name in ("Make.defs", "Application.mk"):
        (apps / name).touch()
    text = MAKE.format(apps=apps, folder=folder, example=values.get("example", ""))
    call = ["make", "--silent", "-C", str(folder), "-f", "-"]
    done = subprocess.run(call, input=text, capture_output=True, text=True, check=True)
    words = (line.partition("=") for line in done.stdout.splitlines() if "=" in line)
    return {name: value.split() for name, _, value in words}


def test_the_setting_selects_what_the_plan_needs(application: Path) -> None:
    start = application.parent / "Kconfig"
    start.write_text(KERNEL.format(folder=application))
    kconfig = kconfiglib.Kconfig(str(start), warn_to_stderr=False)
    assert kconfig.warnings == []
    symbols = kconfig.syms
    symbols["MICROROSLIB"].set_value("y")
    own = {"general": "SERIAL_TERMIOS", "udp": "NET_UDP"}[application.name]
    of_all = ("PIPES", "PRIORITY_INHERITANCE", "PTHREAD_MUTEX_TYPES")
    of_transport = ("SERIAL_TERMIOS", "NET_UDP", "NET_TCP")
    assert {n: symbols[n].str_value for n in of_all} == dict.fromkeys(of_all, "y")
    assert {n for n in of_transport if symbols[n].str_value == "y"} == {own}
    assert symbols["MICROROSLIB_EXAMPLE_PROGNAME"].str_value == ""
    symbols["MICROROSLIB_EXAMPLE"].set_value("y")
    assert symbols["MICROROSLIB_EXAMPLE_PROGNAME"].str_value == "microros"
    symbols["DISABLE_PTHREAD"].set_value("y")
    assert symbols["MICROROSLIB"].str_value == "n"


@pytest.mark.builds
def test_make_has_every_source_and_one_program(application: Path) -> None:
    found = make(application, application, example="y")
    assert found["CONFIGURED_APPS"] == [str(application)]
    assert found["CFLAGS"] == [f"-I{application}/include"]
    sources = {path.relative_to(application).as_posix() for path in application.rglob("*.c")}
    library = {name for name in sources if name.startswith("src/")}
    assert set(found["CSRCS"]) == library
    program = {"general": "examples/publisher/main.c", "udp": "examples/pure_sender/main.c"}[application.name]
    assert found["MAINSRC"] == [program]
    assert program in sources
    assert make(application, application)["MAINSRC"] == []


@pytest.mark.builds
def test_a_project_names_its_program(run: Runner, folder: Path) -> None:
    """The folder is `external` of nuttx-apps."""
    old = folder / "old"
    (old / "lib").mkdir(parents=True)
    source = describe("nuttx").folder / "files" / "examples" / "publisher" / "main.c"
    shutil.copy(source, old / "start.c")
    for name in ("two words", "a$b", "c#d"):
        (old / name).mkdir()
        (old / name / f"{name[0]}.h").write_text("extern int more;\n")
    (old / "lib" / "more.c").write_text('#include "t.h"\n#include "a.h"\n#include "c.h"\nint more;\n')
    (old / "lib" / "other.cpp").write_text("int other;\n")
    assert run("init", "apps/external", "--platform", "nuttx", "--from", "old").status == 0
    external = folder / "apps" / "external"
    (folder / "apps" / "Make.defs").touch()
    (folder / "apps" / "Application.mk").touch()
    text = (
        f"APPDIR := {folder}/apps\nCONFIG_MICROROSLIB := y\nCONFIG_EXTERNAL_EXTERNAL := y\n"
        f"include {external}/Make.defs\n$(info APPS=$(CONFIGURED_APPS))\ninclude Makefile\n"
        "$(info PROGRAM=$(PROGNAME) $(MAINSRC) $(CSRCS) $(CXXSRCS))\n"
        "all:; @gcc $(CFLAGS) -fsyntax-only lib/more.c && g++ $(CXXFLAGS) -fsyntax-only lib/more.c\n"
    )
    call = ["make", "--silent", "-C", str(external / "external"), "-f", "-"]
    done = subprocess.run(call, input=text, capture_output=True, text=True, check=True)
    first, second = (line.partition("=")[2].split() for line in done.stdout.splitlines())
    assert set(first) == {f"{external}/{name}" for name in ("external", "microros")}
    assert second == ["external", "start.c", "lib/more.c", "lib/other.cpp"]
