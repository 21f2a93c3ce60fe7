# SPDX-License-Identifier: Apache-2.0
"""`init --platform`: a project with each package, from nothing or from sources, and what it needs of them."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest
from click.shell_completion import ShellComplete

from microros_gen.cli.main import cli
from microros_gen.package.find import builtin_packages
from microros_gen.package.project import Project
from microros_gen.package.render import describe, plan_package, render_package
from microros_gen.typesupport.plan.file_names import device_in, equal_but_for_case
from tests.support.command_line import Runner
from tests.support.paths import ROOT

PACKAGES = [name for name in builtin_packages() if describe(name).project is not None]
COUNTER = """\
#include <rclc/rclc.h>
#include <std_msgs/msg/int32.h>
#include "helper.h"
/* main() is elsewhere */
void work(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;
  rcl_node_t node;
  rcl_publisher_t publisher;
  (void)rclc_support_init(&support, 0, NULL, &allocator);
  (void)rclc_node_init_default(&node, "worker", "", &support);
  (void)rclc_publisher_init_default(&publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "work");
}
"""
OWN = """\
package: mine
summary: A test
library: mine
transports: [udp]
layout: [{from: ""}]
"""


def project_of(name: str) -> Project:
    found = describe(name).project
    assert found is not None
    return found


@pytest.fixture
def sources(folder: Path) -> Path:
    """Sources of a program that begins nowhere and reaches no agent."""
    own = folder / "old"
    (own / "lib").mkdir(parents=True)
    (own / "work.c").write_text(COUNTER)
    (own / "helper.h").write_text("#define HELPER 1\n")
    (own / "lib" / "more.c").write_text("int more;\n")
    return own


@pytest.mark.parametrize("name", PACKAGES)
def test_a_project_of_nothing_has_the_package_of_its_plan(run: Runner, folder: Path, name: str) -> None:
    project, robot = project_of(name), folder / "my-robot"
    done = run("init", "my-robot", "--platform", name)
    assert (done.status, done.err) == (0, ""), done.err
    assert done.out.splitlines()[-len(project.next) :] == [
        step.replace("{dir}", "my-robot").replace("{name}", "my_robot") for step in project.next
    ]
    library = robot / project.place_of_library("my_robot")
    check = ("check", "--package", name, "-c", str(robot / "microros.yaml"), "--golden", str(library))
    assert run(*check).status == 0
    places = [path.relative_to(robot).as_posix() for path in robot.rglob("*")]
    assert not [place for place in places if re.search(r"NAME|DOT_|\{|\.j2$", place) or device_in(place)]
    assert list(equal_but_for_case(places)) == []
    named = re.findall(r"# (\S+):\d+$", (robot / "microros.yaml").read_text(), re.MULTILINE)
    assert named
    assert set(named) <= set(places), "comments name files of the project"
    text = "".join(path.read_text() for path in robot.iterdir() if path.is_file())
    assert str(ROOT) not in text
    assert f"microros-gen package {name} -c microros.yaml -o {library.relative_to(robot)}" in text
    again = run("init", "my-robot", "--platform", name)
    assert again.status == 2
    assert "MG-9002" in again.err


def test_a_profile_that_lacks_what_the_example_does(run: Runner, folder: Path) -> None:
    done = run("init", "robot", "--platform", "pico", "--profile", "pure_reader")
    assert (done.status, done.err) == (0, ""), done.err
    text = (folder / "robot" / "microros.yaml").read_text()
    assert "profiles: [pure_reader]" in text
    assert "components: [+publish, +timers]" in text


@pytest.mark.parametrize("name", PACKAGES)
def test_sources_are_copied_and_what_is_missing_is_named(run: Runner, sources: Path, name: str) -> None:
    project = project_of(name)
    done = run("init", "robot", "--platform", name, "--from", str(sources))
    assert done.status == 0, done.err
    robot = sources.parent / "robot"
    start = project.sources.replace("{name}", "robot")
    for path in sources.rglob("*.[ch]"):
        copied = robot / f"{start}{path.relative_to(sources).as_posix()}"
        assert copied.read_bytes() == path.read_bytes()
    assert re.search(rf"{project.entry.functions[0]}\(\).*\n?.*MG-9014", done.err)
    assert project.entry.hint in done.err
    assert "topic: work" in (robot / "microros.yaml").read_text()


def test_the_sketch_with_setup_is_the_main_one(run: Runner, sources: Path) -> None:
    (sources / "battery.ino").write_text("void read_battery() {}\n")
    (sources / "rover.ino").write_text("void setup() { read_battery(); }\nvoid loop() {}\n")
    done = run("init", "robot", "--platform", "arduino", "--from", str(sources))
    assert done.status == 0, done.err
    sketch = sources.parent / "robot" / "robot"
    assert sorted(path.name for path in sketch.glob("*.ino")) == ["battery.ino", "robot.ino"]
    assert (sketch / "robot.ino").read_text() == (sources / "rover.ino").read_text()


def test_a_shell_offers_the_packages_that_have_a_project() -> None:
    offered = ShellComplete(cli, {}, "microros-gen", "_C").get_completions(["init", "x", "--platform"], "")
    assert [item.value for item in offered] == PACKAGES


FOLDERS = {
    "esp-idf": ("main/CMakeLists.txt", '"include"', '"lib/imu"'),
    "nuttx": ("robot/Makefile", "-Iinclude", "-Ilib/imu"),
    "pico": ("CMakeLists.txt", '"src/include"', '"src/lib/imu"'),
    "platformio": ("platformio.ini", '"-Isrc/include"', '"-Isrc/lib/imu"'),
    "stm32cube": ("microros_app.mk", "'-I$(MICROROS_APP)/src/include' ", "'-I$(MICROROS_APP)/src/lib/imu'\n"),
    "zephyr": ("CMakeLists.txt", '"src/include"', '"src/lib/imu"'),
}


@pytest.mark.parametrize("name", FOLDERS)
def test_the_sources_find_headers_in_other_folders(run: Runner, sources: Path, name: str) -> None:
    for place in ("include/arm/gains.h", "lib/imu/imu.h"):
        (sources / place).parent.mkdir(parents=True, exist_ok=True)
        (sources / place).write_text("")
    (sources / "lib" / "more.c").write_text('#include <arm/gains.h>\n#include "imu.h"\n')
    done = run("init", "robot", "--platform", name, "--from", str(sources))
    assert done.status == 0, done.err
    file, *folders = FOLDERS[name]
    text = (sources.parent / "robot" / file).read_text()
    assert [folder for folder in folders if folder not in text] == []


def test_make_passes_folders_with_spaces_and_dollars(run: Runner, sources: Path) -> None:
    names = ("my inc", "a$b", "c#d")
    for index, name in enumerate(names):
        (sources / name).mkdir()
        (sources / name / f"gains_{index}.h").write_text("")
    (sources / "more.c").write_text("".join(f'#include "gains_{index}.h"\n' for index in range(len(names))))
    assert run("init", "robot", "--platform", "stm32cube", "--from", str(sources)).status == 0
    robot = sources.parent / "robot"
    included = (robot / "microros_app.mk").read_text().rpartition("include $(MICROROS_APP)/")[2].strip()
    (robot / included).parent.mkdir(parents=True, exist_ok=True)
    (robot / included).write_text("")
    makefile = sources.parent / "Makefile"
    makefile.write_text("include robot/microros_app.mk\nall:\n\t@printf '%s\\n' $(C_INCLUDES)\n")
    outputs = subprocess.run(["make", "-s"], cwd=makefile.parent, check=True, capture_output=True, text=True)
    assert {f"-Irobot/src/{name}" for name in names} <= {*outputs.stdout.splitlines()}


def test_the_projects_that_have_include_folders_are_all_but_sketchbooks() -> None:
    assert {*FOLDERS, "arduino", "teensy"} == set(PACKAGES)


@pytest.mark.parametrize("name", PACKAGES)
def test_set_up_calls_that_are_accepted_are_those_of_the_package(name: str) -> None:
    files = render_package(plan_package(describe(name), None))
    headers = b"".join(content for path, content in files.items() if path.endswith(".h")).decode()
    needs = [need for _, need in project_of(name).transports]
    calls = {function for need in needs for function in need.functions if "microros" in function}
    assert calls <= set(re.findall(r"\b(\w+)\s*\(", headers))


def test_an_example_can_be_that_of_files_of(run: Runner, folder: Path) -> None:
    assert run("init", "robot", "--platform", "teensy").status == 0
    example = describe("arduino").example
    assert example is not None
    assert (folder / "robot/robot/robot.ino").read_bytes() == (example / "publisher.ino").read_bytes()
    plan = (folder / "robot" / "microros.yaml").read_text()
    assert "UNDECIDED" not in plan
    assert "key:" not in plan  # a Teensy has a number


def test_a_package_has_its_own_readme(run: Runner, folder: Path) -> None:
    assert run("init", "my-robot", "--platform", "stm32cube").status == 0
    text = (folder / "my-robot" / "README.md").read_text()
    for line in ("include my-robot/microros_app.mk", "add_subdirectory(my-robot)", "## Build"):
        assert line in text
    assert "schema application" in text


def test_an_application_that_does_not_plan_has_no_package_yet(run: Runner, sources: Path) -> None:
    (sources / "work.c").write_text(COUNTER.replace("std_msgs, msg, Int32", "nowhere_msgs, msg, Thing"))
    done = run("init", "robot", "--platform", "pico", "--from", str(sources))
    assert done.status == 2
    robot = sources.parent / "robot"
    assert (robot / "src" / "work.c").is_file()
    assert not (robot / project_of("pico").library).exists()
    assert "it does not build before the errors are gone" in done.out


def test_a_transport_that_the_package_does_not_have(run: Runner, sources: Path) -> None:
    reach = '  rmw_uros_options_set_udp_address("192.168.1.2", "8888", options);\n}\n'
    (sources / "work.c").write_text(COUNTER[:-2] + reach)
    done = run("init", "robot", "--platform", "pico", "--from", str(sources))
    assert done.status == 2
    assert "the package pico has no transport 'udp'" in done.err


def test_a_package_without_a_project(run: Runner, folder: Path) -> None:
    done = run("init", "robot", "--platform", "cmake")
    assert done.status == 2
    assert "MG-9013" in done.err
    own = folder / "mine"
    own.mkdir()
    (own / "package.yaml").write_text(OWN)
    (own / "microros.yaml").write_text("version: 1\nprofiles: [pure_sender]\n")
    assert "the package mine has no project" in run("init", "robot", "--platform", "./mine").err
    assert not (folder / "robot").exists()


def test_a_package_of_a_folder(run: Runner, folder: Path, sources: Path) -> None:
    own = folder / "mine"
    (own / "project" / "NAME").mkdir(parents=True)
    (own / "package.yaml").write_text(
        OWN + "project:\n  library: lib\n  sources: src/\n  example: example.c\n"
        "  entry: {functions: [work], hint: Begin in work}\n  next: ['make -C {dir}']\n"
    )
    (own / "microros.yaml").write_text("version: 1\nprofiles: [pure_sender]\n")
    (own / "project" / "NAME" / "DOT_list.j2").write_text(
        "{{ view.name }} {{ view.first }}|{{ view.rest_c | join(' ') }}\n"
    )
    done = run("init", "robot", "--platform", "./mine", "--from", str(sources))
    assert done.status == 0, done.err
    assert (folder / "robot" / "robot" / ".list").read_text() == "robot work.c|lib/more.c\n"
    assert "package ../mine -c microros.yaml -o lib" in (folder / "robot" / "README.md").read_text()
    assert done.out.endswith("make -C robot\n")


@pytest.mark.parametrize("option", [("--target", "cortex-m4"), ("--ci",)])
def test_options_without_effect_are_refused(run: Runner, folder: Path, option: tuple[str, ...]) -> None:
    done = run("init", "robot", "--platform", "pico", *option)
    assert done.status == 2
    assert "--platform takes neither --target nor --ci" in done.err
    assert not (folder / "robot").exists()


def test_a_file_that_cannot_be_copied(run: Runner, sources: Path) -> None:
    for name in ("table.h", "more.h"):
        (sources / name).write_bytes(b"/* */\n" * (1 << 18))
    (sources / "helper.h").write_text("#include <own_msgs/msg/gains.h>\n")
    done = run("init", "robot", "--platform", "zephyr", "--from", str(sources))
    assert done.status == 2
    faults = [line for line in done.err.splitlines() if ": error: " in line]
    assert [re.findall(r"helper\.h:1:1|table\.h|more\.h", fault) for fault in faults] == [
        ["helper.h:1:1"],
        ["more.h"],
        ["table.h"],
    ], done.err
    assert not (sources.parent / "robot").exists()
