# SPDX-License-Identifier: Apache-2.0
"""Services on links: the table of both boards, the storage of requests and replies, and what the ends agree about."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.components.boards import application, peers, planned, refused, written

SYSTEM = """\
version: 1
boards:
  sensor: {application: sensor/microros.yaml}
  motor: {application: motor/microros.yaml}
  arm: {application: arm/microros.yaml}
links:
  - {type: udp, ends: {sensor: "10.0.0.1:7500", motor: "10.0.0.2:7500"}}
  - {type: udp, ends: {sensor: "10.0.0.1:7501", arm: "10.0.0.3:7500"}}
"""
PAIR = SYSTEM.replace("  arm: {application: arm/microros.yaml}\n", "").rpartition("  - ")[0]
SERVICES = "components: [+services]\n"


def ends(kind: str, *declared: str) -> str:
    lines = "".join(f"      - {{type: std_srvs/srv/SetBool, {each}}}\n" for each in declared)
    return f"    {kind}:\n{lines}"


def board(name: str, *parts: str) -> str:
    return application(name, "".join(parts), SERVICES)


def pair(folder: Path, server: str = "peer: only", client: str = "peer: only") -> Path:
    """Write a system in which the motor calls /set of the sensor."""
    return written(
        folder,
        PAIR,
        board("sensor", ends("services", f"name: /set, {server}")),
        board("motor", ends("clients", f"name: /set, {client}")),
    )


def test_both_boards_have_the_same_table(tmp_path: Path) -> None:
    sensor = board(
        "sensor",
        ends("services", "name: /set, peer: also, queue: 5", "name: /ros"),
        ends("clients", "name: /go, peer: only", "name: /again, peer: only"),
    )
    motor = board(
        "motor",
        ends("services", "name: /again, peer: only, queue: 4", "name: /go, peer: only"),
        ends("clients", "name: /ros2", "name: /set, peer: only"),
    )
    written(tmp_path, PAIR, sensor, motor)
    [of_sensor], [of_motor] = peers(tmp_path, "sensor").links, peers(tmp_path, "motor").links
    assert [service.name for service in of_sensor.services] == ["/again", "/go", "/set"]
    assert of_sensor.services == of_motor.services
    assert of_sensor.key == of_motor.key
    assert (of_sensor.repliers, of_sensor.requesters) == (((0, 2, 4),), ((0, 1, 0), (1, 0, 0)))
    assert (of_motor.repliers, of_motor.requesters) == (((0, 0, 4), (1, 1, 4)), ((1, 2, 0),))
    assert peers(tmp_path, "motor").shown == "sensor (/again, /go, /set)"
    assert peers(tmp_path, "sensor").service_tables == (
        "const xrce_peer_service_t xrce_peer_repliers[MICROROS_PEER_REPLIERS] = {",
        "  {0, 2, 0, 4}, /* /set: motor */",
        "};",
        "const xrce_peer_service_t xrce_peer_requesters[MICROROS_PEER_REQUESTERS] = {",
        "  {0, 1, 0, 0}, /* /go: motor */",
        "  {1, 0, 0, 0}, /* /again: motor */",
        "};",
    )


def test_without_an_agent(tmp_path: Path) -> None:
    pair(tmp_path)
    sensor, motor = peers(tmp_path, "sensor"), peers(tmp_path, "motor")
    assert sensor.alone
    assert motor.alone
    assert (sensor.serves, sensor.calls, sensor.head) == (True, False, 12)
    assert (motor.serves, motor.calls, motor.head) == (False, True, 0)
    # SetBool: a bool goes, a bool and a string of 20 characters come.
    assert motor.slot_size == 16
    assert sensor.slot_size == 12 + 24 + 4 + 4 + 21 + 3
    assert sensor.slots == motor.slots == 4


def test_another_service_gives_another_key(tmp_path: Path) -> None:
    [first] = peers(pair(tmp_path), "sensor").links
    for name in ("sensor", "motor"):
        file = tmp_path / name / "microros.yaml"
        file.write_text(file.read_text().replace("SetBool", "Trigger"))
    [second] = peers(tmp_path, "sensor").links
    assert first.key != second.key


@pytest.mark.parametrize(
    ("faulty", "server", "client", "words"),
    [
        ("sensor", "peer: only", "queue: 1", "no board that is linked with this one calls '/set'"),
        ("motor", "queue: 1", "peer: only", "no board that is linked with this one serves '/set'"),
        (
            "sensor",
            "peer: only",
            "peer: only, type: std_srvs/srv/Trigger",
            "has the type std_srvs/srv/SetBool here, and the client of the board 'motor' (motor/microros.yaml:9)",
        ),
        (
            "motor",
            "peer: only",
            "peer: also",
            "a client calls one server: that of '/set' is on another board",
        ),
        (
            "motor",
            "peer: only",
            "peer: only, local: also",
            "'/set' has `local: also` and `peer: only`, and a client can have one of them",
        ),
        (
            "sensor",
            "peer: only, queue: 3",
            "peer: only",
            "4 requests of '/set' may come from other boards at a time, and 3 fit its queue. Write `queue: 4`",
        ),
        (
            "sensor",
            "peer: also",
            "peer: only",
            "at a time, and one of the agent, and 4 fit its queue. Write `queue: 5`",
        ),
        (
            "sensor",
            "peer: only, queue_bytes: 400",
            "peer: only",
            "has bytes, and room for no certain number of requests of other boards. Write `queue: 4`",
        ),
        (
            "sensor",
            "peer: only, limits: {string: 66000}",
            "peer: only, limits: {string: 66000}",
            "a message of '/set' takes 66045 bytes, and fragments of a link carry 65539. Lower its limits",
        ),
        (
            "motor",
            "peer: only",
            "peer: only, limits: {message: 8}",
            "'message' of '/set': up to 20 characters from the service of the board 'sensor' (sensor/microros.yaml:9), "
            "and 8 fit the client",
        ),
        (
            "sensor",
            "peer: only",
            "peer: only, limits: {message: 8}",
            "'message' of '/set': up to 20 characters from the service, and 8 fit the client of the board 'motor'",
        ),
    ],
)
def test_ends_that_do_not_agree(tmp_path: Path, faulty: str, server: str, client: str, words: str) -> None:
    pair(tmp_path, server, client)
    if "type:" in client:
        file = tmp_path / "motor" / "microros.yaml"
        file.write_text(file.read_text().replace("type: std_srvs/srv/SetBool, ", ""))
    assert words in refused(tmp_path, faulty)


def test_limits_of_requests_are_compared_in_the_other_direction(tmp_path: Path) -> None:
    folder = pair(tmp_path)
    for name, limit in (("sensor", 9), ("motor", 20)):
        file = folder / name / "microros.yaml"
        text = file.read_text().replace("std_srvs/srv/SetBool", "diagnostic_msgs/srv/AddDiagnostics")
        file.write_text(text.replace("peer: only", f"peer: only, limits: {{load_namespace: {limit}}}"))
    for name, writer in (("sensor", "the client of the board 'motor'"), ("motor", "the client")):
        assert f"'load_namespace' of '/set': up to 20 characters from {writer}" in refused(folder, name)


def test_interface_files_that_differ(tmp_path: Path) -> None:
    folder = pair(tmp_path)
    for name, response in (("sensor", "int32 x\n"), ("motor", "int32 y\n")):
        services = folder / name / "interfaces" / "robot_srvs" / "srv"
        services.mkdir(parents=True)
        (services / "Set.srv").write_text(f"bool on\n---\n{response}")
        (services.parent / "package.xml").write_text("<package><name>robot_srvs</name></package>")
        config = folder / name / "microros.yaml"
        config.write_text(
            "interface_paths: [interfaces]\n"
            + config.read_text().replace("std_srvs/srv/SetBool", "robot_srvs/srv/Set")
        )
    for name in ("sensor", "motor"):
        assert "robot_srvs/srv/Set is defined otherwise" in refused(folder, name)
    (folder / "motor/interfaces/robot_srvs/srv/Set.srv").write_text("bool on\n---\nint32 x\n")
    assert planned(folder)


def test_two_servers_of_one_client(tmp_path: Path) -> None:
    server = ends("services", "name: /set, peer: only")
    folder = written(
        tmp_path, SYSTEM, board("sensor", ends("clients", "name: /set, peer: only")), board("motor", server)
    )
    (folder / "arm").mkdir()
    (folder / "arm" / "microros.yaml").write_text(board("arm", server))
    assert "a client calls one server: the boards 'motor', 'arm' serve '/set'" in refused(folder)


def test_one_server_of_two_boards(tmp_path: Path) -> None:
    client = ends("clients", "name: /set, peer: only, queue: 2")
    folder = written(
        tmp_path,
        SYSTEM,
        board("sensor", ends("services", "name: /set, peer: also, queue: 5")),
        board("motor", client),
    )
    (folder / "arm").mkdir()
    (folder / "arm" / "microros.yaml").write_text(board("arm", client))
    plan = peers(folder, "sensor")
    assert plan.replier_count == 2
    assert plan.service_tables[1:3] == (
        "  {0, 0, 0, 2}, /* /set: motor */",
        "  {0, 0, 1, 2}, /* /set: arm */",
    )
    assert not plan.alone
