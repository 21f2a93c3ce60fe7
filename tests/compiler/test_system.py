# SPDX-License-Identifier: Apache-2.0
"""`check_system`: everything that the boards of a system file do not agree about, in one run."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen.compiler import CheckedSystem, UserError, check_system
from microros_gen.interfaces.find import shipped_folder
from tests.support.components.boards import MOTOR, SENSOR, SYSTEM, application, ends, planned, written

ARM = """\
boards:
  arm: {application: arm/microros.yaml}
"""


def checked(folder: Path) -> CheckedSystem:
    return check_system(folder / "system.yaml", (shipped_folder(),))


def ids(system: CheckedSystem) -> list[str]:
    return [d.id for d in system.diagnostics]


def results(system: CheckedSystem) -> dict[str, str]:
    return {board.name: board.result for board in system.boards}


def lines(system: CheckedSystem, folder: Path) -> list[str]:
    return [d.headline().replace(f"{folder}/", "") for d in system.diagnostics]


def three_boards(folder: Path, arm: str) -> Path:
    """Write a system in which a third board, `arm`, has a link with `motor`."""
    system = SYSTEM.replace("boards:\n", ARM)
    system += '  - {type: udp, ends: {motor: "10.0.0.2:7501", arm: "10.0.0.3:7501"}}\n'
    written(folder, system)
    (folder / "arm").mkdir()
    (folder / "arm" / "microros.yaml").write_text(arm)
    return folder


def test_boards_that_agree(tmp_path: Path) -> None:
    system = checked(written(tmp_path))
    assert (system.result, system.exit_status, system.diagnostics) == ("agrees", 0, ())
    assert [board.rows for board in system.boards] == [
        (("peers", "motor (/a); no agent is needed"),),
        (("peers", "sensor (/a); no agent is needed"),),
    ]


def test_everything_in_one_run(tmp_path: Path) -> None:
    publishers = (
        "topic: /a, peer: only, limits: {string: 600}, qos: {reliability: best_effort}",
        "topic: /b, peer: only",
        "topic: /c, peer: only",
    )
    subscriptions = (
        "topic: /a, peer: only, qos: {reliability: best_effort}",
        "topic: /b, peer: only",
        "topic: /d, peer: only",
    )
    sensor = application("sensor", ends("publishers", *publishers))
    motor = application("motor", ends("subscriptions", *subscriptions)).replace(
        "type: std_msgs/msg/String, topic: /b", "type: std_msgs/msg/Int32, topic: /b"
    )
    system = checked(written(tmp_path, SYSTEM, sensor, motor))
    assert (system.exit_status, results(system)) == (2, {"sensor": "differs", "motor": "differs"})
    assert [board.errors for board in system.boards] == [4, 3]
    # MTU and limits of /a, the type of /b; /c and /d have one end
    assert sorted(ids(system)) == ["MG-7198"] * 2 + ["MG-7200"] * 2 + ["MG-7204"] + ["MG-7206"] * 2
    assert any(line.startswith("motor/microros.yaml:10:9: error:") for line in lines(system, tmp_path))


@pytest.mark.parametrize(
    ("sensor", "motor"),
    [
        (SENSOR.replace("only}", "only, qos: {reliability: best_effort}}"), MOTOR),
        (SENSOR, MOTOR.replace("/a", "/z")),
        (SENSOR, MOTOR.replace(", peer: only", "")),
        (SENSOR, MOTOR.replace("string: 20", "string: 10")),
        (SENSOR.replace("pure_sender", "pure_sendr"), MOTOR),
        (SENSOR, MOTOR + "transport: {type: tcp}\n"),
    ],
)
def test_the_errors_are_those_of_the_builds(tmp_path: Path, sensor: str, motor: str) -> None:
    folder = written(tmp_path, SYSTEM, sensor, motor)
    built = []
    for board in ("sensor", "motor"):
        try:
            planned(folder, board)
        except UserError as error:
            built += [d.headline() for d in error.diagnostics]
    assert built
    assert sorted({d.headline() for d in checked(folder).diagnostics}) == sorted(set(built))


def test_one_board_that_cannot_be_read_hides_only_its_neighbors(tmp_path: Path) -> None:
    arm = application("arm", ends("publishers", "topic: /a, peer: only")).replace("profiles:", "profile:")
    folder = three_boards(tmp_path, arm)
    (folder / "sensor" / "microros.yaml").write_text(SENSOR.replace("/a", "/z"))
    system = checked(folder)
    assert results(system) == {"arm": "differs", "sensor": "differs", "motor": "not compared"}
    assert [board.missing for board in system.boards] == [(), (), ("arm",)]
    assert sorted(ids(system)) == ["MG-1002", "MG-7198"]


def test_a_board_that_does_not_name_the_system(tmp_path: Path) -> None:
    arm = application("arm", ends("publishers", "topic: /a"))
    unnamed = "".join(line for line in arm.splitlines(keepends=True) if not line.startswith("system:"))
    system = checked(three_boards(tmp_path, unnamed))
    assert ids(system) == ["MG-3196"]
    assert results(system) == {"arm": "differs", "sensor": "agrees", "motor": "not compared"}


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (SYSTEM.replace("motor:", "arm:", 1), "system.yaml:6:49: error: the system has no board 'motor'"),
        ("version: 1\n", "system.yaml:1:1: error: missing key 'boards'"),
    ],
)
def test_a_system_file_that_is_wrong(tmp_path: Path, text: str, words: str) -> None:
    system = checked(written(tmp_path, text))
    assert (system.exit_status, system.boards) == (2, ())
    assert words in lines(system, tmp_path)[0]


def test_without_a_file(tmp_path: Path) -> None:
    system = checked(tmp_path)
    assert (system.exit_status, ids(system)) == (2, ["MG-3190"])


def test_images_of_one_chip(tmp_path: Path) -> None:
    head, _, _ = SYSTEM.partition("links:")
    sensor, motor = (text.replace("peer: only", "local: chip") for text in (SENSOR, MOTOR))
    folder = written(tmp_path, f"{head}chips: [[sensor, motor]]\n", sensor, motor)
    system = checked(folder)
    assert (system.result, system.diagnostics) == ("agrees", ())
    assert [(n.board, n.over) for board in system.boards for n in board.neighbors] == [
        ("motor", "chip"),
        ("sensor", "chip"),
    ]
    (folder / "motor" / "microros.yaml").write_text(
        motor.replace("std_msgs/msg/String", "std_msgs/msg/Int32")
    )
    assert results(checked(folder)) == {"sensor": "differs", "motor": "differs"}


def test_warnings_are_no_differences(tmp_path: Path) -> None:
    sensor = SENSOR.replace("peer: only", "peer: also").replace("nodes", "session: {key: 7}\nnodes")
    motor = MOTOR.replace("nodes", "session: {key: 7}\nnodes") + ends("publishers", "topic: /ros")
    system = checked(written(tmp_path, SYSTEM, sensor, motor))
    assert ids(system) == ["MG-7207", "MG-7207"]
    assert system.exit_status == 0
    assert results(system) == {"sensor": "agrees", "motor": "agrees"}


def test_nothing_is_written(tmp_path: Path) -> None:
    folder = written(tmp_path)
    before = sorted(path for path in folder.rglob("*"))
    checked(folder)
    assert sorted(path for path in folder.rglob("*")) == before
