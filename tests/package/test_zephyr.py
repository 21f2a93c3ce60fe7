# SPDX-License-Identifier: Apache-2.0
"""The package `zephyr`: its settings, what its CMakeLists.txt gives to Zephyr, and a check of syntax of its sources.

Zephyr itself was not at hand (docs/howto/zephyr.md): its functions in CMake have stand-ins that print, and its headers
are the declarations of tests/platform/kernels.
"""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import kconfiglib
import pytest
import yaml

from microros_gen import compiler
from microros_gen.package.render import describe, plan_package, render_package
from tests.support.agent.observer import observing
from tests.support.agent.process import own_domain, running_agent
from tests.support.command_line import Runner
from tests.support.package.pio import running
from tests.support.paths import TESTS
from tests.support.runtime.merged import merged
from tests.support.slices import first

KERNELS = TESTS / "platform" / "kernels"
HOST = TESTS / "support" / "package" / "zephyr_host"
UDP = """\
version: 1
profiles: [pure_sender]
target: {network: zephyr_sockets}
transport: {type: udp, agent: 192.168.1.2:8888}
nodes: [{name: n, publishers: [{topic: t, type: std_msgs/msg/Int32}]}]
"""
KERNEL = """\
config HWINFO
    bool
config RING_BUFFER
    bool
osource "{folder}/Kconfig"
"""
COMMANDS = """\
foreach(name zephyr_library_named zephyr_include_directories zephyr_library_sources target_sources)
  cmake_language(EVAL CODE "
    function(${name})
      message(STATUS \\"${name} \\${ARGV}\\")
    endfunction()")
endforeach()
function(target_include_directories)
endfunction()
function(find_package)
  message(STATUS "ZEPHYR_EXTRA_MODULES ${ZEPHYR_EXTRA_MODULES}")
endfunction()
function(project)
endfunction()
set(CMAKE_CURRENT_LIST_DIR "${FOLDER}")
set(CMAKE_CURRENT_SOURCE_DIR "${FOLDER}")
include("${FOLDER}/CMakeLists.txt")
"""
FLAGS = ("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wsign-conversion", "-Wshadow", "-Werror")


@pytest.fixture(params=["general", "udp"])
def module(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """The package of the general plan, or of a plan with the library's own UDP."""
    name = str(request.param)
    config = tmp_path / "udp.yaml" if name == "udp" else None
    if config is not None:
        config.write_text(UDP)
    compiler.write(render_package(plan_package(describe("zephyr"), config)), tmp_path / name)
    return tmp_path / name


def settings(module: Path, *chosen: str) -> kconfiglib.Kconfig:
    """Return the settings of the module, some of them chosen."""
    start = module.parent / "Kconfig"
    start.write_text(KERNEL.format(folder=module))
    kconfig = kconfiglib.Kconfig(str(start), warn_to_stderr=False)
    assert kconfig.warnings == []
    for name in chosen:
        assert kconfig.syms[name].set_value("y")
    return kconfig


def given(folder: Path, *chosen: str) -> list[tuple[str, list[str]]]:
    """Return the calls of Zephyr's functions that a CMakeLists.txt makes, with the settings `chosen`."""
    if shutil.which("cmake") is None:
        pytest.skip("no cmake")
    script = folder.parent / "commands.cmake"
    script.write_text(COMMANDS)
    call = ["cmake", f"-DFOLDER={folder}", *(f"-DCONFIG_{name}=y" for name in chosen), "-P", str(script)]
    lines = subprocess.run(call, capture_output=True, text=True, check=True).stdout.splitlines()
    words = (line.removeprefix("-- ").partition(" ") for line in lines)
    return [(name, values.split(";")) for name, _, values in words]


def test_the_module_names_its_files(module: Path) -> None:
    """Keys of Zephyr's module.yml: `cmake` is a folder with a CMakeLists.txt, `kconfig` a file."""
    data = yaml.safe_load((module / "zephyr" / "module.yml").read_text())
    assert data == {"name": "libmicroros", "build": {"cmake": ".", "kconfig": "Kconfig"}}
    assert (module / "CMakeLists.txt").is_file()
    assert (module / "Kconfig").is_file()


def test_the_settings_are_those_of_the_public_module(module: Path) -> None:
    kconfig = settings(module, "MICROROS")
    assert kconfig.syms["HWINFO"].str_value == "y"
    own = {name for name in kconfig.syms if name.startswith("MICROROS")}
    if module.name == "udp":
        assert own == {"MICROROS"}
        return
    transports = ("SERIAL", "SERIAL_USB", "UDP")
    for transport in transports:
        kconfig = settings(module, "MICROROS", f"MICROROS_TRANSPORT_{transport}")
        chosen = [t for t in transports if kconfig.syms[f"MICROROS_TRANSPORT_{t}"].str_value == "y"]
        assert chosen == [transport]
        port = kconfig.syms["MICROROS_AGENT_PORT"].str_value
        assert port == ("8888" if transport == "UDP" else "")
        assert kconfig.syms["RING_BUFFER"].str_value == ("n" if transport == "UDP" else "y")


@pytest.mark.builds
@pytest.mark.parametrize("transport", ["SERIAL", "SERIAL_USB", "UDP"])
def test_zephyr_gets_every_source_and_one_transport(module: Path, transport: str) -> None:
    assert given(module) == []
    calls = given(module, "MICROROS", f"MICROROS_TRANSPORT_{transport}")
    sources = [Path(path) for name, values in calls if name == "zephyr_library_sources" for path in values]
    kind = "udp" if transport == "UDP" else "serial"
    folder = module / "microros_transports" / kind
    expected = set((module / "src").rglob("*.c")) | set(folder.glob("*.c"))
    if module.name == "udp":  # its transport is in src/: prj.conf has no choice
        calls = given(module, "MICROROS")
        sources = [
            Path(path) for name, values in calls if name == "zephyr_library_sources" for path in values
        ]
        expected = set((module / "src").rglob("*.c"))
    assert set(sources) == expected
    includes = {values[0] for name, values in calls if name == "zephyr_include_directories"}
    assert includes == {str(module / "include"), *([str(folder)] if module.name == "general" else [])}


@pytest.mark.builds
@pytest.mark.parametrize("kind", ["serial", "udp"])
@pytest.mark.parametrize("compiler_name", ["gcc", "clang", "arm-none-eabi-gcc"])
def test_transports_and_example_are_correct_c(tmp_path: Path, kind: str, compiler_name: str) -> None:
    if shutil.which(compiler_name) is None:
        pytest.skip(f"no {compiler_name}")
    files = render_package(plan_package(describe("zephyr"), None))
    compiler.write(files, tmp_path / "module")
    transport = tmp_path / "module" / "microros_transports" / kind
    example = tmp_path / "module" / "examples" / "int32_publisher" / "src" / "main.c"
    folders = (tmp_path / "module" / "include", transport, KERNELS / "zephyr", KERNELS / "zephyr_sockets")
    call = [compiler_name, "-std=gnu11", "-fsyntax-only", *FLAGS, *(f"-I{path}" for path in folders)]
    call += ["-include", "zephyr/autoconf.h", "-DKERNEL_ALIAS"]
    call += ['-DCONFIG_MICROROS_AGENT_IP="192.168.1.100"', '-DCONFIG_MICROROS_AGENT_PORT="8888"']
    done = subprocess.run(
        [*call, str(transport / "microros_transports.c"), str(example)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr


@pytest.mark.builds
@pytest.mark.parametrize(
    ("kind", "lost"), [("serial", "CONFIG_UART_INTERRUPT_DRIVEN"), ("udp", "CONFIG_NET_SOCKETS")]
)
def test_a_missing_setting_stops_the_compiler(tmp_path: Path, kind: str, lost: str) -> None:
    source = describe("zephyr").folder / "files" / "microros_transports" / kind / "microros_transports.c"
    module = tmp_path / "module"
    compiler.write(render_package(plan_package(describe("zephyr"), None)), module)
    folders = (module / "include", source.parent, KERNELS / "zephyr", KERNELS / "zephyr_sockets")
    (tmp_path / "lost.h").write_text(f"#include <zephyr/autoconf.h>\n#undef {lost}\n")
    call = ["gcc", "-fsyntax-only", *(f"-I{path}" for path in folders), "-include", str(tmp_path / "lost.h")]
    done = subprocess.run([*call, str(source)], capture_output=True, text=True, check=False)
    assert re.search(rf'#error "prj.conf: set .*{lost}=y', done.stderr)


@pytest.mark.parametrize("transport", ["serial", "udp", "tcp", "custom"])
def test_the_library_has_each_transport_of_zephyr(run: Runner, folder: Path, transport: str) -> None:
    """A network need not be named."""
    (folder / "own.yaml").write_text(
        f"version: 1\nprofiles: [pure_sender]\ntransport: {{type: {transport}}}\n"
    )
    done = run("package", "zephyr", "-c", "own.yaml", "-o", "out")
    assert (done.status, done.err, "you define" in done.out) == (0, "", False)
    own = list((folder / "out" / "src").glob(f"*/port_zephyr_{transport}.c"))
    assert len(own) == (transport != "custom")


@pytest.mark.builds
def test_a_project_finds_its_module(run: Runner, folder: Path) -> None:
    assert run("init", "robot", "--platform", "zephyr").status == 0
    calls = dict(given(folder / "robot"))
    assert calls["ZEPHYR_EXTRA_MODULES"] == [str(folder / "robot" / "modules" / "libmicroros")]
    assert calls["target_sources"] == ["app", "PRIVATE", "src/main.c"]
    config = (folder / "robot" / "prj.conf").read_text()
    known = settings(folder / "robot" / "modules" / "libmicroros").syms
    assert [name for name in re.findall(r"CONFIG_(MICROROS\w*)=", config) if name not in known] == []


@pytest.mark.system
@pytest.mark.ros
@pytest.mark.builds
@pytest.mark.parametrize("kind", first(["serial", "udp"]))
def test_the_example_reaches_ros(tmp_path: Path, kind: str) -> None:
    """Over functions of Zephyr for this computer (tests/support/package/zephyr_host)."""
    module = tmp_path / "module"
    compiler.write(render_package(plan_package(describe("zephyr"), None)), module)
    domain, line, program = own_domain(), tmp_path / "line", tmp_path / "program"
    transport = ("pty", "--link", str(line)) if kind == "serial" else ("udp4", "--port", "0")
    sources = [module / "microros_transports" / kind / "microros_transports.c", HOST / "kernel.c"]
    sources += [module / "examples" / "int32_publisher" / "src" / "main.c"]
    for number, unit in enumerate(merged(sorted((module / "src").rglob("*.c")))):
        sources.append(tmp_path / f"{number}.c")
        sources[-1].write_text("".join(f'#include "{path}"\n' for path in unit))
    folders = (module / "include", module / "microros_transports" / kind, HOST)
    options = ("--domain", str(domain))
    with observing(domain) as observer:
        observer.subscribe("/zephyr_int32_publisher", "std_msgs/msg/Int32")
        with running_agent(domain, *options, transport=transport) as agent:
            port = agent.device.rpartition(":")[2] if kind == "udp" else "0"
            call = ["gcc", "-std=gnu11", "-O1", "-Wall", "-Wextra", "-Werror", "-D_GNU_SOURCE", "-pthread"]
            call += ["-fsanitize=address,undefined", *(f"-I{path}" for path in folders)]
            call += ['-DCONFIG_MICROROS_AGENT_IP="127.0.0.1"', f'-DCONFIG_MICROROS_AGENT_PORT="{port}"']
            done = subprocess.run(
                [*call, *map(str, sources), "-o", str(program)], capture_output=True, text=True, check=False
            )
            assert done.returncode == 0, done.stderr
            with running(program, ZEPHYR_LINE=str(line)):
                samples = observer.got(3, timeout_s=30, topic="/zephyr_int32_publisher")
    numbers = [value["data"] for _, value in samples]
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))
