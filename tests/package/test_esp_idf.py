# SPDX-License-Identifier: Apache-2.0
"""The package `esp-idf`: its manifest, its settings, and what its CMakeLists.txt registers.

What it compiles to was seen by hand with the public sources (docs/howto/esp_idf.md); the ports are checked by
tests/platform/test_kernels.py.
"""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.package.render import describe, plan_package, render_package

UART = """\
version: 1
profiles: [pure_sender]
transport: {type: custom, framing: true}
nodes: [{name: n, publishers: [{topic: t, type: std_msgs/msg/Int32}]}]
"""
COMMANDS = """\
set(CMAKE_CURRENT_LIST_DIR "${FOLDER}")
function(idf_build_get_property result name)
  set(${result} "${TARGET}" PARENT_SCOPE)
endfunction()
function(idf_component_get_property result component name)
  set(${result} "/idf/${component}" PARENT_SCOPE)
endfunction()
function(target_include_directories)
  message(STATUS "PRIVATE ${ARGV}")
endfunction()
function(idf_component_register)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "" "SRCS;INCLUDE_DIRS;REQUIRES")
  message(STATUS "SRCS ${arg_SRCS}")
  message(STATUS "INCLUDE_DIRS ${arg_INCLUDE_DIRS}")
  message(STATUS "REQUIRES ${arg_REQUIRES}")
endfunction()
include("${FOLDER}/CMakeLists.txt")
"""


@pytest.fixture(params=["general", "uart"])
def component(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """The package of the general plan, or of a plan for a UART."""
    name = str(request.param)
    config = tmp_path / "uart.yaml" if name == "uart" else None
    if config is not None:
        config.write_text(UART)
    folder = tmp_path / name
    compiler.write(render_package(plan_package(describe("esp-idf"), config)), folder)
    return folder


def registered(component: Path, target: str) -> dict[str, list[str]]:
    """Return what CMakeLists.txt registers for a target of ESP-IDF, by keyword."""
    script = component.parent / "commands.cmake"
    script.write_text(COMMANDS)
    call = ["cmake", f"-DFOLDER={component}", f"-DTARGET={target}", "-P", str(script)]
    lines = subprocess.run(call, capture_output=True, text=True, check=True).stdout.splitlines()
    words = (line.removeprefix("-- ").partition(" ") for line in lines)
    return {keyword: value.split(";") for keyword, _, value in words}


def test_the_manifest_is_valid(component: Path) -> None:
    from idf_component_tools.manager import ManifestManager  # takes long, in each process that collects

    manifest = ManifestManager(str(component), "micro_ros_espidf_component").load()
    assert manifest.license == "Apache-2.0"
    assert [(need.name, need.version) for need in manifest.requirements] == [("idf", ">=5.3")]


@pytest.mark.builds
@pytest.mark.parametrize("target", ["esp32c3", "linux"])
def test_every_source_is_registered_with_what_it_needs(component: Path, target: str) -> None:
    if shutil.which("cmake") is None:
        pytest.skip("no cmake")
    found = registered(component, target)
    sources = {path.relative_to(component).as_posix() for path in component.rglob("*.c")}
    own = {name for name in sources if not name.startswith(("src/", "examples/"))}
    assert (
        own
        == {
            "uart": {"esp32_serial_transport/esp32_serial_transport.c"},
            "general": {"network_interfaces/uros_wlan_netif.c"},
        }[component.name]
    )
    expected = {name for name in sources if not name.startswith("examples/")}
    assert set(found["SRCS"]) == (expected - own if target == "linux" else expected)
    assert all((component / name).is_dir() for name in found["INCLUDE_DIRS"])
    assert ("esp_wifi" in found["REQUIRES"]) == (component.name == "general" and target == "esp32c3")
    assert ("esp_driver_uart" in found["REQUIRES"]) == (component.name == "uart" and target == "esp32c3")
    assert found["PRIVATE"][-1] == "/idf/freertos/FreeRTOS-Kernel/include/freertos"


def test_menuconfig_has_every_setting_that_is_used(component: Path) -> None:
    defined = {
        name
        for path in (*component.rglob("Kconfig"), *component.rglob("Kconfig.projbuild"))
        for name in re.findall(r"^\s*config (\w+)$", path.read_text(), re.MULTILINE)
    }
    used = {
        name
        for path in component.rglob("*.[ch]")
        for name in re.findall(r"CONFIG_((?:MICRO_?ROS|ESP)_\w+)", path.read_text())
    }
    assert used <= defined
    assert ("MICRO_ROS_ESP_UART_TRANSPORT" in defined) == (component.name == "uart")
    assert ("MICRO_ROS_ESP_NETIF_WLAN" in defined) == (component.name == "general")
