# SPDX-License-Identifier: Apache-2.0
"""`size`, `explain`, `run` and budgets of an application that a user's CMake project links."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from tests.support.agent.observer import observing
from tests.support.agent.process import own_domain, running_agent
from tests.support.e2e.relay import Relay
from tests.support.paths import ROOT
from tests.support.workspace.projects import BOARD, EXAMPLE, PAGE, Project, run

SCHEMA = json.loads((ROOT / "microros_gen/cli/size/size.schema.json").read_text(encoding="utf-8"))
EXCEEDED = re.compile(r"microros\.yaml(:\d+:\d+): error: (.*?): \d+ bytes, and (memory\.\w+ is \d+)")
BUDGETS = "memory: {ram_budget: 1 KiB, flash_budget: 10 KiB, stack: 512}\n"


def tool(project: Project, *words: str | Path, status: int = 0) -> subprocess.CompletedProcess[str]:
    """Run microros-gen in the project's folder; its exit status has to be `status`."""
    command = (sys.executable, "-m", "microros_gen", *words)
    environment = {**project.environment, "PYTHONPATH": str(ROOT)}
    done = run(*command, cwd=project.source, env=environment)
    assert done.returncode == status, done.stdout + done.stderr
    assert "Traceback" not in done.stderr
    return done


def sized(project: Project, *words: str | Path) -> Any:
    data = json.loads(tool(project, "size", *words, "--format", "json").stdout)
    jsonschema.validate(data, SCHEMA)
    return data


@pytest.fixture(scope="module")
def whole(project: Project) -> Any:
    """What `size` says of the build folder as it is after the first build."""
    return sized(project, project.build_folder)


def totals(program: str, image: Path) -> dict[str, int]:
    """Return what the tool chain's own `size` says."""
    line = subprocess.run([program, "-B", image], capture_output=True, text=True, check=True).stdout
    text, data, bss = map(int, line.splitlines()[1].split()[:3])
    return {"text": text, "data": data, "bss": bss, "flash": text + data, "ram": data + bss}


def owners(data: Mapping[str, Any], group: str) -> dict[str, int]:
    return {o["name"]: o["flash"] for o in data["owners"] if o["group"] == group}


def test_size_of_a_build_folder_is_that_of_its_own_image(project: Project, whole: Any) -> None:
    image, data = project.build_folder / "app", whole
    assert data["image"] == str(image)
    assert data["totals"] == totals("size", image)
    assert {"publish", "session", "timers", "support"} <= set(owners(data, "component"))
    assert set(owners(data, "type support")) == {"robot_msgs/msg/WheelSpeeds", "std_msgs/msg/Int32"}
    assert set(owners(data, "application")) == {"app.c.o"}
    assert not owners(data, "other library")
    uses = {part["use"] for part in data["ram"]}
    assert {"publisher 0", "publisher 1", "message of robot_msgs/msg/WheelSpeeds", "session"} <= uses
    names = [e["name"] for e in data["entities"]]
    assert names == ["/wheels", "/wheel_speeds", "/turns"]


@pytest.mark.system
def test_its_stack_counts_the_callbacks_of_the_application(whole: Any) -> None:
    stack = whole["stack"]
    assert stack["known"]
    chain = [link["function"] for link in stack["main"]["chain"]]
    assert chain[0] == "main"
    assert "publish" in chain or "start" in chain, "a function of app.c"
    assert all(link["known_from"] == "compiler" for link in stack["main"]["chain"])


@pytest.mark.system
def test_the_output_folder_in_it_and_its_image_are_the_same(project: Project, whole: Any) -> None:
    assert sized(project, project.out) == whole
    assert sized(project, project.build_folder, "--image", project.build_folder / "app") == whole


@pytest.mark.system
def test_the_commands_of_the_page(project: Project) -> None:
    """All but `run`, which is below. One writes a page with treemaps."""
    (block,) = re.findall(r"^```console\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
    lines = [line.removeprefix("$ microros-gen ").split() for line in block.splitlines()]
    assert [words[0] for words in lines] == ["size", "size", "explain", "run"]
    for words in lines[:-1]:
        tool(project, *(project.build_folder if word == "build/app" else word for word in words))
    text = (project.source / "size.html").read_text()
    assert len(text) > 10_000
    assert "<title>Sizes of " in text
    assert re.search(r"<title>app\.c\.o \(application\): \d+ bytes</title>", text)
    assert re.search(r"<title>publish \(component\): \d+ bytes</title>", text)


@pytest.mark.system
def test_explain_names_the_way_from_its_main(project: Project, whole: Any) -> None:
    output = json.loads(
        tool(project, "explain", project.build_folder, "rcl_publish", "--format", "json").stdout
    )
    assert (output["of"], output["present"]) == ("publish", True)
    assert output["chain"][0] == "main"
    assert output["place"].startswith("src/publish/rcl_publisher.c:")
    own = json.loads(tool(project, "explain", project.build_folder, "app.c", "--format", "json").stdout)
    assert own["flash"] == owners(whole, "application")["app.c.o"]
    assert "publish" in {part["name"] for part in own["holds"]}


@pytest.mark.system
def test_without_a_map_symbols_tell(project: Project, whole: Any) -> None:
    image, mapped = project.build_folder / "app", whole
    linker_map = image.with_suffix(".map")
    hidden = linker_map.rename(linker_map.with_suffix(".hidden"))
    try:
        data = sized(project, project.build_folder)
        assert "The linker map is missing" in tool(project, "size", project.build_folder).stdout
    finally:
        hidden.rename(linker_map)
    assert (data["mapped"], mapped["mapped"]) == (False, True)
    assert data["totals"] == mapped["totals"]
    functions = {
        s["name"]: s["owner"] for s in mapped["symbols"] if s["name"].startswith(("rcl", "rmw", "xrce"))
    }
    assert len(functions) > 50
    assert {s["name"]: s["owner"] for s in data["symbols"] if s["name"] in functions} == functions
    assert "app.c.o" in owners(data, "application")


@pytest.mark.system
def test_an_image_of_somebody_elses_archive(project: Project, tmp_path: Path) -> None:
    """No record, no names that are ours, another library next to it: members are known by what they define."""
    objects = sorted(p for p in project.build_folder.rglob("robot.dir/**/*.o"))
    other = tmp_path / "xrce_session.c"
    other.write_text(
        "int driver(void); int driver(void) { return 3; }\nint xrce_driver(void) { return 4; }\n"
    )
    main = tmp_path / "main.c"
    main.write_text(
        "#include <rclc/rclc.h>\nint driver(void);\nstatic rclc_support_t s;\n"
        "int main(void) { rcl_allocator_t a = rcl_get_default_allocator();\n"
        "  return driver() + (int)rclc_support_init(&s, 0, NULL, &a); }\n"
    )
    steps = (
        ["ar", "rcs", "libvendor.a", *map(str, objects)],
        ["gcc", "-c", "-o", "xrce_session.o", str(other)],
        ["ar", "rcs", "libdriver.a", "xrce_session.o"],
        ["gcc", "-g", f"-I{project.out / 'include'}", "-c", "-o", "main.o", str(main)],
        [
            "gcc",
            "-Wl,--gc-sections",
            "-Wl,-Map=robot.map",
            "main.o",
            "libvendor.a",
            "libdriver.a",
            "-o",
            "robot",
        ],
    )
    for step in steps:
        done = run(*step, cwd=tmp_path, env=project.environment)
        assert done.returncode == 0, done.stderr
    data = sized(project, project.build_folder, "--image", tmp_path / "robot")
    assert data["totals"] == totals("size", tmp_path / "robot")
    assert {"session", "support", "ping"} <= set(owners(data, "component"))
    assert set(owners(data, "other library")) == {"libdriver.a"}
    assert set(owners(data, "application")) == {"main.o"}
    output = tool(project, "explain", project.out, "rclc_support_init", "--image", tmp_path / "robot").stdout
    assert re.search(r"^reached +main → rclc_support_init", output, re.MULTILINE)
    assert (
        any("-fcallgraph-info=su" in text for text in data["stack"]["not_counted"])
        or not data["stack"]["known"]
    )


@pytest.mark.system
def test_budgets_are_those_of_build(project: Project) -> None:
    """Each is an error at its place in the application file, until the file or the application is fixed."""
    config = project.source / "microros.yaml"
    before = config.read_text()
    config.write_text(before + BUDGETS)
    line = len(before.splitlines()) + 1
    wanted = [
        (f":{line}:{BUDGETS.index(value) + 1}", what, key)
        for value, what, key in (
            ("1 KiB", "static RAM in the image", "memory.ram_budget is 1024"),
            ("10 KiB", "flash in the image", "memory.flash_budget is 10240"),
            ("512", "worst stack from main", "memory.stack is 512"),
        )
    ]
    try:
        for _ in range(2):
            built = project.build()
            assert built.returncode != 0
            assert EXCEEDED.findall(built.stdout + built.stderr) == wanted
        assert "pools: {history: 3}  # saves 18 bytes" in built.stdout + built.stderr
        tool(
            project, "size", project.build_folder, status=1 if (project.build_folder / "app").is_file() else 2
        )
        config.write_text(before + re.sub(r": \d+( KiB)?", ": 1 MiB", BUDGETS))
        held = project.build()
        assert held.returncode == 0, held.stdout
        budgets = sized(project, project.build_folder)["budgets"]
        assert [(b["key"], b["exceeded"]) for b in budgets] == [
            (f"memory.{key}", False) for key in ("ram_budget", "flash_budget", "stack")
        ]
    finally:
        config.write_text(before)
        assert project.build().returncode == 0


@pytest.mark.ros
def test_run_starts_the_image_of_a_build_folder(project: Project, relay: Relay) -> None:
    """Its port is the relay's, so the agent is another one."""
    domain = own_domain()
    with (
        running_agent(domain, "--domain", str(domain)) as agent,
        observing(domain) as observer,
        started("run", project.build_folder, "--no-agent"),
    ):
        relay.connect(agent.port)
        observer.subscribe("/turns", "std_msgs/msg/Int32", reliable=True)
        assert [topic for topic, _ in observer.got(2)][:2] == ["/turns", "/turns"]


@pytest.mark.system
@pytest.mark.ros
@pytest.mark.skipif(shutil.which("qemu-system-arm") is None, reason="no qemu-system-arm")
def test_run_starts_an_image_for_a_board_with_its_agent(board: Project) -> None:
    domain = own_domain()
    image = board.build_folder / "app.elf"
    with (
        observing(domain) as observer,
        started("run", board.out, "--image", image, "--domain", str(domain)),
    ):
        observer.subscribe("/turns", "std_msgs/msg/Int32", reliable=True)
        assert [topic for topic, _ in observer.got(2, timeout_s=60)][:2] == ["/turns", "/turns"]


@contextmanager
def started(*words: str | Path) -> Iterator[None]:
    """Start a command of the tool; end it afterwards."""
    command = [sys.executable, "-m", "microros_gen", *map(str, words)]
    with subprocess.Popen(command) as process:
        try:
            yield
        finally:
            process.terminate()


FETCHED = """\
cmake_minimum_required(VERSION 3.16)
project(robots C)
include(FetchContent)
FetchContent_Declare(microros_gen SOURCE_DIR "{tool}")
FetchContent_MakeAvailable(microros_gen)
add_subdirectory(firmware)
"""
FIRMWARE = """\
microros_add_library(robot CONFIG microros.yaml)
add_executable(app "${CMAKE_CURRENT_BINARY_DIR}/robot-microros/examples/pure_sender/main.c")
microros_image(app robot)
add_executable(plain EXCLUDE_FROM_ALL "${CMAKE_CURRENT_BINARY_DIR}/robot-microros/examples/pure_sender/main.c")
target_link_libraries(plain PRIVATE robot)
"""
SMALL = """\
version: 1
profiles: [pure_sender]
entities: preconfigured
liveliness: none
errors: code
memory: {ram_budget: 128}
nodes: [{name: n, publishers: [{topic: t, type: std_msgs/msg/Int32, qos: {reliability: best_effort}}]}]
"""


@pytest.mark.system
@pytest.mark.parametrize("generator", ["ninja", pytest.param("make", marks=pytest.mark.long)])
def test_a_part_of_a_project_that_fetches_the_tool(generator: str, tmp_path: Path) -> None:
    """In a separate folder, so the linker runs elsewhere; its budget is checked there as well."""
    project = Project(tmp_path / "robots", generator)
    firmware = project.source / "firmware"
    firmware.mkdir(parents=True)
    (project.source / "CMakeLists.txt").write_text(FETCHED.format(tool=project.tool))
    (firmware / "CMakeLists.txt").write_text(FIRMWARE)
    (firmware / "microros.yaml").write_text(SMALL)
    configured = project.configure()
    assert configured.returncode == 0, configured.stderr
    built = project.build()
    assert built.returncode != 0
    ((place, what, budget),) = EXCEEDED.findall(built.stdout + built.stderr)
    assert (place, what, budget) == (":6:22", "static RAM in the image", "memory.ram_budget is 128")
    (firmware / "microros.yaml").write_text(SMALL.replace("128", "64 KiB"))
    built = project.build()
    assert built.returncode == 0, built.stdout
    data = sized(project, project.build_folder)
    assert data["image"] == str(project.build_folder / "firmware/app")
    assert set(owners(data, "application")) == {"main.c.o"}
    assert data["stack"]["main"]["chain"][0]["function"] == "main"
    assert not owners(data, "other library")
    plain_image_is_checked_by_the_command_of_the_page(project, firmware)


def plain_image_is_checked_by_the_command_of_the_page(project: Project, firmware: Path) -> None:
    """What target_link_libraries links is not checked by the build; one command does that."""
    words = re.findall(r"`microros-gen (size \S+ --image \S+ --budgets)`", PAGE)[0].split()
    words = [
        {"build/app": project.build_folder, "plain": project.build_folder / "firmware/plain"}.get(w, w)
        for w in words
    ]
    for budget, status in (("64 KiB", 0), ("128", 1)):
        (firmware / "microros.yaml").write_text(SMALL.replace("128", budget))
        built = project.build("--target", "plain")
        assert built.returncode == 0, built.stdout
        output = tool(project, *words, status=status).stderr
        found = [(place, key) for place, _, key in EXCEEDED.findall(output)]
        assert found == ([(":6:22", "memory.ram_budget is 128")] if status else [])


@pytest.mark.system
@pytest.mark.skipif(shutil.which("arm-none-eabi-gcc") is None, reason="no arm-none-eabi-gcc")
def test_of_a_processor_without_a_board_the_library_is_checked(tmp_path: Path) -> None:
    """There is not an image, so `build` bounds the library; so does the build that makes it."""
    project = Project(tmp_path / "a library")
    project.source.mkdir()
    (project.source / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.16)\nproject(firmware C ASM)\nfind_package(microros_gen REQUIRED)\n"
        "microros_add_library(robot CONFIG microros.yaml TARGET cortex-m4f)\n"
    )
    (project.source / "microros.yaml").write_text(SMALL + "transport: {type: custom}\n")
    configured = project.configure(f"-DCMAKE_TOOLCHAIN_FILE={EXAMPLE / BOARD}.cmake")
    assert configured.returncode == 0, configured.stderr
    built = project.build()
    assert built.returncode != 0
    ((place, what, _),) = EXCEEDED.findall(built.stdout + built.stderr)
    assert (place, what) == (":6:22", "static RAM of the library, before unused parts are dropped")
    (project.source / "microros.yaml").write_text(
        SMALL.replace("128", "64 KiB") + "transport: {type: custom}\n"
    )
    built = project.build()
    assert built.returncode == 0, built.stdout
    assert sized(project, project.build_folder)["measured"] == "library"
    (project.source / "microros.yaml").write_text(SMALL + "transport: {type: custom}\n")
    assert project.build().returncode != 0, "nothing but the budget changed"


@pytest.mark.system
def test_a_board_has_a_bound_for_everything(board: Project) -> None:
    """Nothing of its image is left out: start-up, interrupts, the callbacks of the application, the C library."""
    data = sized(board, board.build_folder)
    assert data["target"] == BOARD
    assert data["totals"] == totals("arm-none-eabi-size", board.build_folder / "app.elf")
    assert data["stack"]["not_counted"] == []
    assert {"main", "rclc_executor_spin", "publish"} <= {
        link["function"] for link in data["stack"]["main"]["chain"]
    }
    assert set(owners(data, "application")) == {"app.c.obj"}
    assert "libg_nano.a" in owners(data, "C library")


@pytest.mark.system
def test_what_is_not_there_is_said(project: Project, tmp_path: Path) -> None:
    output = tool(project, "size", tmp_path, status=2).stderr
    assert "is not an output folder of microros-gen, and no CMake build folder that has one" in output
    image = project.build_folder / "app"
    hidden = image.rename(image.with_suffix(".hidden"))
    try:
        for command in (("size",), ("run",)):
            output = tool(project, *command, project.build_folder, status=2).stderr
            assert f"{image} has not been built yet. Build it: cmake --build {project.build_folder}" in output
    finally:
        hidden.rename(image)
    whole = tool(project, "size", project.build_folder, "--image", sys.executable, status=2).stderr
    assert "was not linked with the library of" in whole
    cut = tmp_path / "cut"
    cut.write_bytes(image.read_bytes()[:3000])
    for path in (cut, Path("/dev/zero")):
        output = tool(project, "size", project.build_folder, "--image", path, status=1).stderr
        assert f"{path} cannot be measured: " in output
