# SPDX-License-Identifier: Apache-2.0
"""`init --from-colcon-meta`: every setting has a key, a reason why it needs none, or a mark."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path

import pytest

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.migrate.colcon_meta import read_settings
from microros_gen.migrate.draft import Draft
from microros_gen.migrate.meta_draft import meta_draft
from tests.support.migrate.proposals import Init, application_in, undecided_in

RMW = "rmw_microxrcedds"
CLIENT = "microxrcedds_client"
ALWAYS = 2  # remarks of every proposal without nodes: the types, and what it does


def text_of(packages: Mapping[str, list[str]]) -> str:
    names = {
        name: {"cmake-args": [f"-D{argument}" for argument in arguments]}
        for name, arguments in packages.items()
    }
    return json.dumps({"names": names}, indent=4)


def write(path: Path, **packages: list[str]) -> None:
    path.write_text(text_of(packages), encoding="utf-8")


def draft(**packages: list[str]) -> Draft:
    """Return what `init` proposes, without the defaults of every proposal."""
    diagnostics = Diagnostics()
    settings = read_settings(Source("a.meta", text_of(packages)), diagnostics)
    diagnostics.check()
    return meta_draft(settings, declared=False)


def test_settings_that_have_keys(init: Init, tmp_path: Path) -> None:
    write(
        tmp_path / "app-colcon.meta",
        rmw_microxrcedds=[
            "RMW_UXRCE_TRANSPORT=serial",
            "RMW_UXRCE_DEFAULT_SERIAL_DEVICE=/dev/ttyACM1",
            "RMW_UXRCE_CREATION_MODE=refs",
            "RMW_UXRCE_MAX_NODES=2",
            "RMW_UXRCE_MAX_PUBLISHERS:STRING=3",
            "RMW_UXRCE_MAX_SUBSCRIPTIONS=1",
            "RMW_UXRCE_MAX_SERVICES=1",
            "RMW_UXRCE_MAX_CLIENTS=0",
            "RMW_UXRCE_MAX_HISTORY=5",
            "RMW_UXRCE_MAX_WAIT_SETS=2",
            "RMW_UXRCE_MAX_GUARD_CONDITION=0",
            "RMW_UXRCE_STREAM_HISTORY=8",
            "RMW_UXRCE_NODE_NAME_MAX_LENGTH=20",
            "RMW_UXRCE_TOPIC_NAME_MAX_LENGTH=30",
            "RMW_UXRCE_PUBLISH_RELIABLE_TIMEOUT=250",
        ],
        microxrcedds_client=[
            "UCLIENT_SERIAL_TRANSPORT_MTU=256",
            "UCLIENT_PROFILE_MULTITHREAD=ON",
            "UCLIENT_HARD_LIVELINESS_CHECK=ON",
            "UCLIENT_HARD_LIVELINESS_CHECK_TIMEOUT=3000",
        ],
    )
    status, _, _ = init("app", "--from-colcon-meta", "app-colcon.meta")
    assert status == 0
    application = application_in(tmp_path / "app/microros.yaml")
    transport = application.transport
    assert (transport.type, transport.device, transport.mtu) == ("serial", "/dev/ttyACM1", 256)
    assert application.entities is not None
    assert application.entities.name == "reference"
    assert application.pools == {
        "nodes": 2, "publishers": 3, "subscriptions": 1, "services": 1, "clients": 0, "queue": 5, "wait_sets": 2,
        "guard_conditions": 0, "history": 8, "name_size": 30,
    }  # fmt: skip
    assert (application.on_full, application.on_full_block_ms) == ("block", 250)
    assert {p.name for p in application.profiles} == {"pure_sender", "pure_reader"}
    assert {c.name for c in application.components} == {"services", "multithread"}
    assert application.hard_liveliness_ms == 3000
    text = (tmp_path / "app/microros.yaml").read_text()
    assert "  history: 8 # RMW_UXRCE_STREAM_HISTORY (app-colcon.meta:" in text


@pytest.mark.parametrize("kind", ["udp", "tcp"])
def test_the_agents_address(kind: str) -> None:
    name = f"RMW_UXRCE_DEFAULT_{kind.upper()}"
    settings = [f"RMW_UXRCE_TRANSPORT={kind}", f"{name}_IP=10.0.0.7", f"{name}_PORT=9999"]
    transport = draft(rmw_microxrcedds=settings).groups["transport"]
    assert {key: value.value for key, value in transport.items()} == {"type": kind, "agent": "10.0.0.7:9999"}


def test_a_custom_transport_without_framing() -> None:
    settings = {RMW: ["RMW_UXRCE_TRANSPORT=custom"], CLIENT: ["UCLIENT_PROFILE_STREAM_FRAMING=OFF"]}
    transport = draft(**settings).groups["transport"]
    assert {key: value.value for key, value in transport.items()} == {"type": "custom", "framing": False}


def test_what_is_not_needed_is_named_with_its_reason_and_line(init: Init, tmp_path: Path) -> None:
    write(
        tmp_path / "a.meta",
        rcutils=["RCUTILS_NO_FILESYSTEM=ON", "ENABLE_TESTING=OFF"],
        tracetools=["TRACETOOLS_DISABLED=ON"],
        microxrcedds_client=["UCLIENT_PIC=OFF", "UCLIENT_UDP_TRANSPORT_MTU=1024", "UCLIENT_PROFILE_CAN=OFF"],
        rmw_microxrcedds=[
            "RMW_UXRCE_TRANSPORT=custom",
            "RMW_UXRCE_MAX_TOPICS=9",
            "RMW_UXRCE_DEFAULT_UDP_PORT=1",
        ],
    )
    _, _, err = init("app", "--from-colcon-meta", "a.meta")
    text = (tmp_path / "app/microros.yaml").read_text()
    listed = " ".join(line.lstrip("# ") for line in text.splitlines() if line.startswith("#"))
    for line, expected in [
        (5, "rcutils RCUTILS_NO_FILESYSTEM=ON: the library has no heap, no files and no threads"),
        (6, "rcutils ENABLE_TESTING=OFF: the tests of the old stack are not built"),
        (11, "tracetools TRACETOOLS_DISABLED=ON: the tracing"),
        (16, "microxrcedds_client UCLIENT_PIC=OFF: it is about how the old stack is built"),
        (17, "microxrcedds_client UCLIENT_UDP_TRANSPORT_MTU=1024: the transport is custom"),
        (18, "microxrcedds_client UCLIENT_PROFILE_CAN=OFF: `transport: {type: canfd, id: 0x7f}`"),
        (24, "rmw_microxrcedds RMW_UXRCE_MAX_TOPICS=9: topics are counted"),
        (25, "rmw_microxrcedds RMW_UXRCE_DEFAULT_UDP_PORT=1: the transport is custom"),
    ]:
        assert f"- a.meta:{line}: {expected}" in listed
    assert err.count("warning") == ALWAYS


@pytest.mark.parametrize(
    ("setting", "expected"),
    [
        ("RMW_UXRCE_STREAM_HISTORY=32", "here it can be 1 to 16"),
        ("RMW_UXRCE_MAX_NODES=many", "'many' is not a whole number"),
        ("RMW_UXRCE_MAX_PUBLISHERS=-1", "here it can be 0 to 250"),
        (
            "RMW_UXRCE_GRAPH=ON",
            "declare the nodes and write `components: [+graph]`, which needs a graph server",
        ),
        ("RMW_UXRCE_ALLOW_DYNAMIC_ALLOCATIONS=ON", "pools do not grow: the library has no heap"),
        ("RMW_UXRCE_CREATION_MODE=xml", "'xml' is not one of bin, refs"),
        ("RMW_UXRCE_TRANSPORT=custom_serial", "the transport 'custom_serial' is not known here"),
        ("RMW_UXRCE_MAX_SUBSCRIPTIOS=2", "not known here. Did you mean 'RMW_UXRCE_MAX_SUBSCRIPTIONS'?"),
    ],
)
def test_undecided_settings_are_reported(setting: str, expected: str) -> None:
    (remark,) = draft(rmw_microxrcedds=[setting]).remarks
    assert remark.undecided
    assert str(remark.span) == "a.meta:5:17"
    assert remark.text.startswith(f"rmw_microxrcedds {setting}: {expected}")


def test_what_could_not_be_decided_is_marked(init: Init, tmp_path: Path) -> None:
    write(tmp_path / "a.meta", rmw_microxrcedds=["RMW_UXRCE_GRAPH=ON"])
    status, out, err = init("app", "--from-colcon-meta", "a.meta")
    assert status == 0
    assert "a.meta:5:17: warning: rmw_microxrcedds RMW_UXRCE_GRAPH=ON: declare the nodes" in err
    assert '"-DRMW_UXRCE_GRAPH=ON"\n' in err
    assert f"{1 + ALWAYS} to be decided by you: look for UNDECIDED in app/microros.yaml" in out
    assert undecided_in(tmp_path / "app/microros.yaml") == ["UNDECIDED: to be decided by you."]
    assert (
        "# - a.meta:5: rmw_microxrcedds RMW_UXRCE_GRAPH=ON: " in (tmp_path / "app/microros.yaml").read_text()
    )


def test_several_files_the_last_one_wins_and_yaml_is_taken(init: Init, tmp_path: Path) -> None:
    write(tmp_path / "colcon.meta", rmw_microxrcedds=["RMW_UXRCE_MAX_PUBLISHERS=10", "RMW_UXRCE_MAX_NODES=5"])
    arguments = "-DRMW_UXRCE_MAX_PUBLISHERS=2 -D RMW_UXRCE_MAX_CLIENTS=1"
    text = f"names:\n    rmw_microxrcedds:\n        cmake-args: {arguments}\n"
    (tmp_path / "app.meta").write_text(text)
    assert init("app", "--from-colcon-meta", "colcon.meta", "--from-colcon-meta", "app.meta")[0] == 0
    pools = application_in(tmp_path / "app/microros.yaml").pools
    assert pools == {"publishers": 2, "nodes": 5, "clients": 1}


def test_a_duplicate_package_is_reported(init: Init, tmp_path: Path) -> None:
    entry = '"rcutils": {"cmake-args": []}'
    (tmp_path / "a.meta").write_text(f'{{\n\t"names": {{\n\t\t{entry},\n\t\t{entry}\n\t}}\n}}\n')
    _, _, err = init("app", "--from-colcon-meta", "a.meta")
    assert "a.meta:4:3: warning: duplicate key 'rcutils'; first in line 3; the first one is used" in err


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", "'a.meta' is empty. A colcon.meta has a mapping `names` of packages"),
        ("{}", "a.meta:1:1: error: no packages in this file"),
        ('{"names": {"a": {"cmake-args": [["x"]]}}}', "a.meta:1:33: error: 'cmake-args' must list strings"),
        ('{"names": ["a"]}', "a.meta:1:11: error: 'names' must be a mapping"),
        ("names: {a: {", "a.meta:1:13: error: "),
    ],
)
def test_what_is_no_colcon_meta_is_refused(text: str, expected: str, init: Init, tmp_path: Path) -> None:
    (tmp_path / "a.meta").write_text(text)
    status, _, err = init("app", "--from-colcon-meta", "a.meta")
    assert status == 2
    assert expected in err
    assert not (tmp_path / "app").exists()


def test_a_file_that_is_not_there(init: Init) -> None:
    status, _, err = init("app", "--from-colcon-meta", "no.meta")
    assert status == 2
    assert re.search(r"error: cannot read 'no\.meta': No such file.*\. Give the path of a colcon\.meta", err)
