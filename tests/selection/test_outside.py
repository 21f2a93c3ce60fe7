# SPDX-License-Identifier: Apache-2.0
"""Components, profiles and parts of platforms that a folder or an installed package brings."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path

import pytest

from tests.support.command_line import Runner
from tests.support.ids import without_id
from tests.support.outside import (
    BEACON,
    COMPONENT,
    PACKAGE,
    install_with_ament,
    install_with_pip,
    write_files,
)
from tests.support.slices import first

APPLICATION = "profiles: [pure_sender]\ncomponents: [./beacon]\ninterfaces: [std_msgs/msg/Int32]\n"


def application(folder: Path, text: str = APPLICATION) -> None:
    (folder / "microros.yaml").write_text(
        f"version: 1\nsession: {{key: 1}}\nlimits: {{'*': {{string: 20}}}}\n{text}"
    )


def plan_of(folder: Path) -> str:
    return str(json.loads((folder / "out" / "manifest.json").read_text())["plan"])


@pytest.mark.system
@pytest.mark.builds
def test_a_folder_is_built_like_a_component_of_the_tool(folder: Path, run: Runner) -> None:
    write_files(folder / "beacon", BEACON)
    application(folder)
    done = run("build", "-o", "out")
    assert done.status == 0, done.err
    symbols = subprocess.run(
        ["nm", str(folder / "out/lib/libmicroros.a")], text=True, capture_output=True, check=True
    ).stdout
    assert " T beacon_shown" in symbols
    assert '"pure_sender"' in (folder / "out/src/beacon/beacon_text.c").read_text()
    manifest = json.loads((folder / "out/manifest.json").read_text())
    assert manifest["selection"]["outside"] == {
        "beacon": {"from": "folder beacon", "summary": "Counts what the application shows"}
    }
    assert {f"component beacon/{name}" for name in BEACON} <= set(manifest["inputs"])
    assert "beacon (from folder beacon)" not in done.err
    shown = run("explain", "out", "beacon")
    assert "Counts what the application shows (from folder beacon)" in shown.out
    table = run("resolve").out
    assert "from folder beacon" in table
    rows = json.loads(run("resolve", "--format", "json").out)["components"]
    assert {row["name"]: row["from"] for row in rows if "from" in row} == {"beacon": "folder beacon"}


def test_a_component_that_is_planned_is_refused_by_a_build(folder: Path, run: Runner) -> None:
    """The resolver shows it; `init` writes no folder with a profile that needs it."""
    planned = COMPONENT.replace("status: ready", "status: planned")
    write_files(folder / "beacon", {**BEACON, "component.yaml": planned})
    application(folder)
    done = run("generate", "-o", "out")
    assert done.status == 2
    assert "the component beacon, which this version of microros-gen does not have yet" in done.err
    assert not (folder / "out").exists()
    assert "beacon" in run("resolve").out


def test_where_the_folder_is_does_not_matter(folder: Path, run: Runner, tmp_path: Path) -> None:
    outputs = []
    for place in ("near", "far/away"):
        work = write_files(tmp_path / place / "app", {})
        work.mkdir(parents=True, exist_ok=True)
        write_files(work / "beacon", BEACON)
        application(work)
        assert run("generate", "-c", str(work / "microros.yaml"), "-o", str(work / "out")).status == 0
        outputs.append(
            {p.relative_to(work): p.read_bytes() for p in (work / "out").rglob("*") if p.is_file()}
        )
    assert outputs[0] == outputs[1]
    option = run(
        "generate", "--profile", "pure_sender", "--component", str(tmp_path / "near/app/beacon"), "-o", "out"
    )
    assert option.status == 0, option.err
    assert str(tmp_path) not in (folder / "out/manifest.json").read_text()


def test_a_change_of_a_file_makes_another_plan_and_is_seen(folder: Path, run: Runner) -> None:
    write_files(folder / "beacon", BEACON)
    application(folder)
    assert run("generate", "-o", "out", "--depfile", "out.d").status == 0
    first = plan_of(folder)
    listed = (folder / "out.d").read_text()
    for name in BEACON:
        assert f"{folder}/beacon/{name}" in listed
    assert run("check", "--golden", "golden", "--update").status == 0
    assert run("check", "--golden", "golden").status == 0
    source = folder / "beacon/src/beacon.c"
    source.write_text(source.read_text().replace("port_time_ms()", "port_time_ms() + 1u"))
    done = run("check", "--golden", "golden")
    assert done.status == 1
    assert "port_time_ms() + 1u" in done.out
    assert run("generate", "-o", "out").status == 0
    assert plan_of(folder) != first
    assert "+ 1u" in (folder / "out/src/beacon/beacon.c").read_text()


def test_a_run_that_is_remembered_sees_a_new_header(folder: Path, run: Runner) -> None:
    write_files(folder / "beacon", BEACON)
    application(folder)
    for path in (*folder.rglob("*"), folder):
        os.utime(path, (1, 1))
    for _ in range(2):
        assert run("generate", "-o", "out").status == 0
    write_files(folder / "beacon", {"include/beacon/more.h": "extern int beacon_more;\n"})
    assert run("generate", "-o", "out").status == 0
    assert (folder / "out/include/beacon/more.h").is_file()


def test_a_folder_of_several_things(folder: Path, run: Runner) -> None:
    write_files(folder / "parts", PACKAGE)
    (folder / "board.yaml").write_text(
        "target: stone\nsummary: Made up\nextends: cortex-m4\nos: rock\nprovides: [steady, sleep, lock, wait]\n"
    )
    application(
        folder,
        "profiles: [lighthouse]\ncomponents: [./parts]\ntarget: board.yaml\ninterfaces: [std_msgs/msg/Int32]\n",
    )
    done = run("generate", "-o", "out")
    assert done.status == 0, done.err
    assert (folder / "out/src/port_rock/port_rock_time.c").is_file()
    assert (folder / "out/src/beacon/beacon.c").is_file()
    manifest = json.loads((folder / "out/manifest.json").read_text())
    origins = {name: row["from"] for name, row in manifest["selection"]["outside"].items()}
    assert origins == {"beacon": "folder parts", "port_rock": "folder parts"}
    assert "profile lighthouse" in manifest["inputs"]
    assert manifest["selection"]["reasons"]["beacon"] == ["profile lighthouse"]


@pytest.mark.parametrize("kind", first(["pip", "ament", "ament elsewhere"], 2))
def test_an_installed_package(kind: str, folder: Path, run: Runner, monkeypatch: pytest.MonkeyPatch) -> None:
    site = folder.parent / "site"
    if kind == "pip":
        install_with_pip(site)
        monkeypatch.syspath_prepend(str(site))
    else:
        install_with_ament(site, below="lib/robot" if kind != "ament" else "")
        monkeypatch.setenv("AMENT_PREFIX_PATH", str(site))
    application(folder, "profiles: [lighthouse]\ninterfaces: [std_msgs/msg/Int32]\n")
    done = run("generate", "-o", "out")
    assert done.status == 0, done.err
    origin = f"{kind.split()[0]} package robot_parts"
    manifest = json.loads((folder / "out/manifest.json").read_text())
    assert manifest["selection"]["outside"]["beacon"]["from"] == origin
    listed = run("profiles")
    assert f"Sends, and shows it (from {origin})" in listed.out
    rows = json.loads(run("profiles", "--format", "json").out)
    assert [row["from"] for row in rows if "from" in row] == [origin]
    listed = run("targets")
    assert f"Made up (from {origin})" in listed.out
    assert "family" not in listed.out
    rows = json.loads(run("targets", "--format", "json").out)
    assert [(row["name"], row["from"]) for row in rows if "from" in row] == [("crag", origin)]
    done = run("generate", "--profile", "pure_sender", "--target", "crag", "-o", "crag")
    assert done.status == 0, done.err
    assert "-DCRAG=1" in (folder / "crag/toolchain.cmake").read_text()
    inputs = json.loads((folder / "crag/manifest.json").read_text())["inputs"]
    assert {"target crag.yaml", "target _family.yaml"} <= inputs.keys()
    assert f"from {origin}" in run("profiles", "lighthouse").out
    result = run("init", "new", "--profile", "lighthouse")
    assert result.status == 0, result.err
    assert "lighthouse" in (folder / "new/microros.yaml").read_text()


def test_init_looks_in_the_headers_of_packages(
    folder: Path, run: Runner, monkeypatch: pytest.MonkeyPatch
) -> None:
    site = folder.parent / "site"
    install_with_pip(site)
    monkeypatch.syspath_prepend(str(site))
    source = """\
int main(void)
{
  rclc_support_init(&support, 0, NULL, &allocator);
  rclc_node_init_default(&node, "lamp", "", &support);
  rclc_publisher_init_default(&publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "light");
  printf("%u", (unsigned)beacon_shown());
}
"""
    write_files(folder / "code", {"main.c": source})
    done = run("init", "app", "--from", "code")
    assert done.status == 0, done.err
    assert "components: [+beacon]" in (folder / "app/microros.yaml").read_text()
    (site / "robot_parts/components/beacon/component.yaml").write_text(COMPONENT + "typo: 1\n")
    assert run("init", "other", "--from", "code").status == 0, "a package that does not hold is left out"
    assert "beacon" not in (folder / "other/microros.yaml").read_text()


def test_what_else_is_installed_changes_nothing(
    folder: Path, run: Runner, monkeypatch: pytest.MonkeyPatch
) -> None:
    application(folder, "profiles: [pure_sender]\ninterfaces: [std_msgs/msg/Int32]\n")
    assert run("generate", "-o", "out").status == 0
    install_with_pip(folder.parent / "site")
    monkeypatch.syspath_prepend(str(folder.parent / "site"))
    assert run("generate", "-o", "other").status == 0
    names = {
        p.relative_to(folder / "out"): p.read_bytes() for p in (folder / "out").rglob("*") if p.is_file()
    }
    again = {
        p.relative_to(folder / "other"): p.read_bytes() for p in (folder / "other").rglob("*") if p.is_file()
    }
    assert names == again


def test_two_packages_with_one_name_are_refused(
    folder: Path, run: Runner, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("one", "two"):
        install_with_pip(folder.parent / "site", name)
    monkeypatch.syspath_prepend(str(folder.parent / "site"))
    application(folder, "profiles: [pure_sender]\ncomponents: [+beacon]\ninterfaces: [std_msgs/msg/Int32]\n")
    done = run("generate", "-o", "out")
    assert done.status == 2
    assert (
        "microros.yaml:5:14: error: the component 'beacon' comes from pip package one and pip package two"
        in done.err
    )


FAULTS = [
    (
        "layer: middleware",
        "layer: lower",
        "component.yaml:3:8: error: 'layer' must be micro-ROS, middleware or port",
    ),
    ("asks: [time]", "common: true", "component.yaml:6:1: error: `common` is for built-in components"),
    ("asks: [time]", "asks: [tides]", "component.yaml:6:8: error: unknown capability 'tides'"),
    (
        "needs: [publish]",
        "needs: [publisch]",
        "component.yaml:5:9: error: the component 'beacon' needs the unknown",
    ),
    ("asks: [time]", "hue: red", "component.yaml:6:1: error: unknown key 'hue' in the file"),
    (
        "component: beacon",
        "component: buoy",
        "component.yaml:1:12: error: the folder of the component 'buoy' is",
    ),
    ("[beacon.c,", "[sea.c,", "component.yaml:8:11: error: missing file 'src/sea.c'"),
    ("[beacon.c,", "[../../x.c,", "component.yaml:8:11: error: '../../x.c' is outside the component's src/"),
    ("beacon/beacon.h]", "beacon/sea.h]", "component.yaml:7:11: error: missing file 'include/beacon/sea.h'"),
    (
        "asks: [time]",
        "hooks: {due: beacon_left(message)}",
        "component.yaml:6:14: error: unknown variable 'message' of the hook",
    ),
    (
        "layer: middleware",
        "layer: port",
        "component.yaml:3:1: error: a part of a platform is not a component",
    ),
    (
        "asks: [time]",
        "implies: [{publisher: /x, type: Int32}]",
        "component.yaml:6:33: error: 'Int32' is not a type",
    ),
]


@pytest.mark.parametrize(
    ("good", "bad", "expected"), FAULTS, ids=[expected.split("error: ")[1][:30] for *_, expected in FAULTS]
)
def test_a_fault_is_reported_with_its_place(
    good: str, bad: str, expected: str, folder: Path, run: Runner
) -> None:
    assert good in COMPONENT
    write_files(folder / "beacon", {**BEACON, "component.yaml": COMPONENT.replace(good, bad)})
    application(folder)
    done = run("generate", "-o", "out")
    assert done.status == 2
    assert expected in without_id(done.err)
    assert not (folder / "out").exists()


def test_names_of_others_are_refused(folder: Path, run: Runner) -> None:
    publish = COMPONENT.replace("component: beacon", "component: publish")
    write_files(folder / "publish", {**BEACON, "component.yaml": publish})
    application(folder, APPLICATION.replace("./beacon", "./publish"))
    done = run("generate", "-o", "out")
    assert done.status == 2
    assert (
        "microros.yaml:5:14: error: the name 'publish' of a component from folder publish is taken by"
        in done.err
    )

    write_files(folder / "beacon", {**BEACON, "include/microros/port.h": "\n"})
    application(folder)
    done = run("generate", "-o", "out")
    assert done.status == 2
    assert "the components 'base' and 'beacon' both have 'include/microros/port.h'" in done.err

    (folder / "beacon/include/microros/port.h").unlink()
    write_files(folder / "beacon", {"include/std_msgs/msg/int32.h": "\n"})
    done = run("generate", "-o", "out")
    assert done.status == 2
    assert "a component has the file 'include/std_msgs/msg/int32.h', which belongs to a type" in done.err


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            "{% if %}\n",
            "beacon_text.c.j2:2:1: error: the template cannot be rendered: Expected an expression",
        ),
        ("{{ plan.nothing }}\n", "beacon_text.c.j2:2:1: error: the template cannot be rendered: "),
    ],
)
def test_a_faulty_template_is_reported_with_its_line(
    text: str, expected: str, folder: Path, run: Runner
) -> None:
    write_files(folder / "beacon", {**BEACON, "src/beacon_text.c.j2": f"/* first */\n{text}"})
    application(folder)
    done = run("generate", "-o", "out")
    assert done.status == 2
    assert expected in done.err


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("./none", "'./none' is not a folder"),
        ("./empty", "'./empty' contains no component, profile, platform or target"),
        ("-./beacon", "'components[0]' must be a component to add or drop"),
    ],
)
def test_a_folder_that_brings_nothing(name: str, expected: str, folder: Path, run: Runner) -> None:
    (folder / "empty").mkdir()
    application(folder, APPLICATION.replace("./beacon", name))
    done = run("generate", "-o", "out")
    assert done.status == 2
    assert f"microros.yaml:5:14: error: {expected}" in done.err
