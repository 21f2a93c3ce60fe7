# SPDX-License-Identifier: Apache-2.0
"""The configuration file and the options of `microros-gen agent`: what they say together, and what is wrong where."""

from __future__ import annotations

import json
from dataclasses import asdict, fields
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from microros_gen.agent.configuration.model import CanChoice, NamedPath, PtyChoice, SerialChoice, SocketChoice
from microros_gen.agent.configuration.parser import SCHEMA, parse_agent_file
from microros_gen.agent.early_signals import EarlySignals
from microros_gen.agent.limits import Limits
from microros_gen.agent.manifests import Manifests
from microros_gen.agent.transport.tcp import TcpLimits
from microros_gen.cli.agent.options import AgentOptions, _one_each
from microros_gen.cli.agent.start import serve
from microros_gen.cli.agent.types import ManifestOf, TypeHashes, read_manifests
from microros_gen.diagnostics import Diagnostics, Source, UserError
from microros_gen.documents.schema import load_schema
from microros_gen.interfaces.type_hashes import type_hashes
from tests.support.ids import without_id
from tests.support.paths import ROOT

EXAMPLE = ROOT / "examples/agent/agent.yaml"
NOTHING = {
    "config": None,
    "domain": None,
    "discovery": False,
    "discovery_port": None,
    "graph_server": False,
    "client_state": False,
    "diagnostics": False,
    "status_socket": None,
    "metrics": None,
    "page": None,
    "no_parameter_server": False,
    "parameter_file": None,
    "client_timeout": None,
    "max_clients": None,
    "limits": (),
    "workers": None,
    "references": (),
    "entities": (),
    "policy": None,
    "psk_file": None,
    "check": False,
    "manifest": (),
    "interface_path": (),
    "record": None,
    "verbose": 0,
    "verbosity": None,
    "log_format": None,
}
WHOLE = """\
version: 1
transports:
  - udp4:
  - udp6: {bind: "::", port: 7777}
  - tcp4: {port: 0, connections: 8, output_bytes: 4096, patience_s: 2.5}
  - serial: {device: tty, baud: 9600}
  - serial: {device: /dev/ttyUSB0}
  - canfd: {device: can0}
  - pty: {link: board, baud: 9600}
discovery: {port: 7401}
domain: 7
limits: {clients: 3, client_timeout_s: 1.5, message_bytes: 1000}
references: [refs.xml]
entities: [a.json, /b.json]
policy: policy.yaml
psk_file: keys
manifests: [m.json, 0x1=n.json]
interface_paths: [idl]
record: all.pcapng
log: {format: json, verbose: 2}
"""


def options(text: str, folder: Path, *transports: SocketChoice, **arguments: object) -> AgentOptions:
    path = folder / "agent.yaml"
    path.write_text(text)
    return AgentOptions.of([{**NOTHING, "config": path, **arguments}], transports)


def test_everything_that_a_file_can_say(tmp_path: Path) -> None:
    """Paths are relative to the file."""
    options_read = options(WHOLE, tmp_path)
    assert options_read == AgentOptions(
        transports=(
            SocketChoice("udp4"),
            SocketChoice("udp6", 7777, "::"),
            SocketChoice("tcp4", 0, None, (("connections", 8), ("output_bytes", 4096), ("patience_s", 2.5))),
            SerialChoice(str(tmp_path / "tty"), 9600),
            SerialChoice("/dev/ttyUSB0"),
            CanChoice("can0"),
            PtyChoice(str(tmp_path / "board"), 9600),
        ),
        discovery=7401,
        domain=7,
        limits=Limits(clients=3, client_timeout_s=1.5, message_bytes=1000),
        references=(tmp_path / "refs.xml",),
        entities=(tmp_path / "a.json", Path("/b.json")),
        policy=tmp_path / "policy.yaml",
        psk_file=tmp_path / "keys",
        manifests=(ManifestOf(tmp_path / "m.json"), ManifestOf(tmp_path / "n.json", "0x1")),
        interface_paths=(tmp_path / "idl",),
        record=tmp_path / "all.pcapng",
        log_format="json",
        verbose=2,
    )


def test_the_command_line_wins(tmp_path: Path) -> None:
    options_read = options(
        WHOLE,
        tmp_path,
        SocketChoice("udp4", 1),
        domain=0,
        client_timeout=9.0,
        limits=("objects=5", "clients=4"),
        references=(Path("more.xml"),),
        log_format="text",
        verbose=1,
        discovery_port=9,
    )
    assert options_read.transports == (SocketChoice("udp4", 1),)
    assert (options_read.domain, options_read.log_format, options_read.verbose, options_read.discovery) == (
        0,
        "text",
        1,
        9,
    )
    assert options_read.limits == Limits(clients=4, client_timeout_s=9.0, message_bytes=1000, objects=5)
    assert options_read.references == (tmp_path / "refs.xml", Path("more.xml"))


def test_the_view_of_clients_is_asked_for(tmp_path: Path) -> None:
    head = "version: 1\ntransports: [udp4: {}]\n"
    assert options(head + "client_state: true\n", tmp_path).client_state
    assert not options(head, tmp_path).client_state
    assert options(head, tmp_path, client_state=True).client_state
    assert options(head + "diagnostics: true\n", tmp_path).diagnostics
    assert not options(head, tmp_path).watches_clients
    only = options(head, tmp_path, diagnostics=True)
    assert (only.client_state, only.diagnostics, only.watches_clients) == (False, True, True)


def test_where_the_agent_is_monitored(tmp_path: Path) -> None:
    head = "version: 1\ntransports: [udp4: {}]\n"
    nothing = options(head, tmp_path)
    assert (nothing.status_socket, nothing.metrics, nothing.page, nothing.is_monitored) == (
        None,
        None,
        None,
        True,
    )
    named = options(f"{head}status_socket: s\nmetrics: 9464\npage: '[::1]:80'\n", tmp_path)
    assert named.status_socket == str(tmp_path / "s")
    assert (named.metrics, named.page) == (NamedPath("9464"), NamedPath("[::1]:80"))
    without = options(f"{head}status_socket: none\n", tmp_path)
    assert (without.status_socket, without.is_monitored) == ("none", False)
    assert options(f"{head}status_socket: none\n", tmp_path, page="1").is_monitored
    over = options(f"{head}status_socket: s\nmetrics: 9464\n", tmp_path, status_socket="/t", metrics="1")
    assert (over.status_socket, over.metrics) == ("/t", NamedPath("1"))


def test_a_graph_server_inside_the_agent(tmp_path: Path) -> None:
    head = "version: 1\ntransports: [udp4: {}]\n"
    assert options(head + "graph_server: true\n", tmp_path).graph_server
    assert not options(head + "graph_server: false\n", tmp_path).graph_server
    assert not options(head, tmp_path).graph_server
    assert options(head, tmp_path, graph_server=True).graph_server


def test_discovery_as_a_word(tmp_path: Path) -> None:
    head = "version: 1\ntransports: [udp4: {}]\n"
    assert options(head + "discovery: true\n", tmp_path).discovery == 7400
    assert options(head + "discovery: false\n", tmp_path).discovery is None
    assert options(head, tmp_path).discovery is None
    assert options(head, tmp_path, discovery=True).discovery == 7400


def test_every_fault_is_reported_at_its_place(tmp_path: Path) -> None:
    text = """\
version: 2
transports:
  - upd4: {port: 8888}
  - udp4: {prot: 1}
  - tcp4: {port: 70000}
  - serial: {}
  - {udp4: , udp6: }
limit: {clients: 3}
limits: {clent_timeout_s: 1, clients: many, domains: 0}
domain: 300
log: {format: jsn}
references: refs.xml
"""
    with pytest.raises(UserError) as error:
        options(text, tmp_path)
    path = tmp_path / "agent.yaml"
    reported = [without_id(d.headline()).removeprefix(f"{path}:") for d in error.value.diagnostics]
    assert reported == [
        "1:10: error: 'version' must be 1, the only version; it is 2. A later microros-gen wrote the file: update"
        " microros-gen",
        "3:5: error: unknown key 'upd4' in 'transports[0]'. Did you mean 'udp4'?",
        "4:12: error: unknown key 'prot' in 'transports[1].udp4'. Did you mean 'port'?",
        "5:18: error: 'transports[2].tcp4.port' must be a whole number between 0 and 65535; it is 70000. Write 65535"
        " or less",
        "6:13: error: missing key 'device' in 'transports[3].serial'. Add `device: …`",
        "7:5: error: 'transports[4]' must be one transport with its settings, as `udp4: {port: 8888}`; it is a mapping",
        "8:1: error: unknown key 'limit' in the file. Did you mean 'limits'?",
        "9:10: error: unknown key 'clent_timeout_s' in 'limits'. Did you mean 'client_timeout_s'?",
        "9:39: error: 'limits.clients' must be a whole number between 1 and 65535; it is the text 'many'",
        "9:54: error: 'limits.domains' must be a whole number between 1 and 233; it is 0. Write 1 or more",
        "10:9: error: 'domain' must be a whole number between 0 and 232; it is 300. Write 232 or less",
        "11:15: error: 'log.format' must be text or json; it is the text 'jsn'. Did you mean 'json'?",
        "12:13: error: 'references' must be a list; it is the text 'refs.xml'. Write it as a list: [refs.xml]",
    ]


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("", "the file is empty"),
        ("version: 1\n", "the agent has no transport. Name one"),
        ("version: 1\ntransports: []\n", "'transports' must be a list with at least one transport"),
        ("version: 1\ntransports: [udp4: {}]\n\tx: 1\n", "agent.yaml:3:"),
    ],
)
def test_files_that_do_not_hold(text: str, wanted: str, tmp_path: Path) -> None:
    with pytest.raises(UserError) as error:
        options(text, tmp_path)
    assert wanted in str(error.value)


@pytest.mark.parametrize(
    ("limit", "wanted"),
    [
        ("client=3", "unknown limit 'client'. Did you mean 'clients'?"),
        ("clients=0", "'limits.clients' must be a whole number between 1 and 65535; it is 0"),
        ("clients", "'limits.clients' must be a number. Write --limit clients=NUMBER"),
        ("clients=x", "'limits.clients' must be a whole number between 1 and 65535; it is the text 'x'"),
        ("clients=3}\ndomain: 5 #", "'limits.clients' must be a number"),
    ],
)
def test_limits_on_the_command_line(limit: str, wanted: str, tmp_path: Path) -> None:
    with pytest.raises(UserError) as error:
        options("version: 1\ntransports: [udp4: {}]\n", tmp_path, limits=(limit,))
    assert wanted in str(error.value)


def test_options_of_several_places() -> None:
    """Lists are joined, -v counts, and what holds for the whole agent has one value."""
    first = {**NOTHING, "verbose": 1, "domain": 3, "references": (Path("a"),)}
    second = {**NOTHING, "verbose": 1, "domain": 3, "references": (Path("b"),), "discovery": True}
    merged = _one_each([NOTHING, first, second])
    assert (merged["verbose"], merged["domain"], merged["discovery"]) == (2, 3, True)
    assert merged["references"] == (Path("a"), Path("b"))
    with pytest.raises(UserError, match="--domain has two values, 3 and 4"):
        _one_each([first, {**NOTHING, "domain": 4}])
    with pytest.raises(UserError, match="--domain has two values, 0 and 4"):
        _one_each([{**NOTHING, "domain": 0}, {**NOTHING, "domain": 4}])


def test_the_schema_has_every_limit_and_its_default() -> None:
    schema = load_schema(SCHEMA)
    Draft202012Validator.check_schema(schema)
    reported = schema["properties"]["limits"]["properties"]
    assert {name: about["default"] for name, about in reported.items()} == asdict(Limits())
    for field in fields(Limits):
        assert reported[field.name]["type"] == {"int": "integer", "float": "number"}[str(field.type)]
        assert reported[field.name]["description"]
    tcp = schema["$defs"]["tcp"]["properties"]
    assert {name: tcp[name]["default"] for name in asdict(TcpLimits())} == asdict(TcpLimits())


def test_the_example_holds(tmp_path: Path) -> None:
    diagnostics = Diagnostics()
    options = parse_agent_file(Source("agent.yaml", EXAMPLE.read_text()), diagnostics)
    diagnostics.check()
    assert options.transports


def manifest(path: Path, *nodes: str, **types: str) -> ManifestOf:
    places = [node.rpartition("/")[::2] for node in nodes]
    reported = {
        "types": {f"p/msg/{name}": {"hash": value} for name, value in types.items()},
        "entities": {"nodes": [{"namespace": space or "/", "name": name} for space, name in places]},
    }
    path.write_text(json.dumps(reported))
    return ManifestOf(path)


ONE, TWO = "RIHS01_" + "1" * 64, "RIHS01_" + "2" * 64


def test_hashes_of_clients_precede_those_of_files(tmp_path: Path) -> None:
    diagnostics = Diagnostics()
    manifests = [manifest(tmp_path / "a.json", A=ONE), manifest(tmp_path / "b.json", A=ONE, B=TWO)]
    clients = read_manifests(manifests, diagnostics)
    diagnostics.check()
    hashes = TypeHashes({"p/msg/B": ONE, "p/msg/C": TWO}.get, clients.common)
    assert [hashes(f"p/msg/{name}") for name in "ABCD"] == [ONE, TWO, TWO, None]
    assert hashes.differences(clients) == ["p/msg/B"]


def test_a_manifest_is_of_its_nodes_or_of_a_key(tmp_path: Path) -> None:
    """Two clients may have two definitions of a type; the agent's core asks by key and node."""
    diagnostics = Diagnostics()
    first = manifest(tmp_path / "a.json", "/imu", "/ns/other", A=ONE)
    second = manifest(tmp_path / "b.json", "/imu", A=TWO)
    keyed = ManifestOf.of("0xA1B2C3D4=b.json", tmp_path)
    assert keyed == ManifestOf(second.path, "0xA1B2C3D4")
    clients = read_manifests([first, keyed], diagnostics)
    diagnostics.check()
    assert clients.common == {}
    found = Manifests(clients.by_client)
    hash_of_type = found.hash_of(b"\1\2\3\4", "imu")
    assert hash_of_type is not None
    assert hash_of_type("p/msg/A") == ONE
    hash_of_type = found.hash_of(b"\1\2\3\4", "ns/other")
    assert hash_of_type is not None
    assert hash_of_type("p/msg/A") == ONE
    hash_of_type = found.hash_of(b"\xa1\xb2\xc3\xd4", "imu")
    assert hash_of_type is not None
    assert hash_of_type("p/msg/A") == TWO
    assert found.hash_of(b"\1\2\3\4", "nobody") is None
    assert TypeHashes({"p/msg/A": ONE}.get, {}).differences(clients) == ["p/msg/A"]


def test_hashes_of_a_real_manifest_are_those_of_the_shipped_files() -> None:
    golden = Path(__file__).resolve().parents[1] / "golden/preconfigured/manifest.json"
    diagnostics = Diagnostics()
    clients = read_manifests([ManifestOf(golden)], diagnostics)
    diagnostics.check()
    hashes = TypeHashes(type_hashes(), clients.common)
    assert str(hashes("std_msgs/msg/Int32")).startswith("RIHS01_b6578ded")
    assert hashes.differences(clients) == []
    assert hashes("std_msgs/msg/../../Int32") is None


def test_manifests_that_do_not_hold(tmp_path: Path) -> None:
    diagnostics = Diagnostics()
    (tmp_path / "no.json").write_text("[]")
    manifests = [
        manifest(tmp_path / "a.json", A=ONE),
        manifest(tmp_path / "b.json", A=TWO),
        manifest(tmp_path / "c.json", A="RIHS01_x"),
        manifest(tmp_path / "d.json", "/n", A=ONE),
        manifest(tmp_path / "e.json", "/n", A=TWO),
        ManifestOf(tmp_path / "no.json"),
        ManifestOf(tmp_path / "missing.json"),
    ]
    read_manifests(manifests, diagnostics)
    reported = [d.message.replace(f"{tmp_path}/", "") for d in diagnostics]
    assert reported == [
        "b.json and a.json have different definitions of p/msg/A",
        "c.json is not a manifest of microros-gen",
        "e.json and d.json have different definitions of p/msg/A",
        "no.json is not a manifest of microros-gen",
        "missing.json cannot be read: No such file or directory",
    ]


def started(chosen: AgentOptions) -> None:
    signals = EarlySignals()
    with signals.noted():
        serve(chosen, signals)


def test_another_system_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.platform", "win32")
    with pytest.raises(UserError, match="the agent needs Linux"):
        started(AgentOptions(transports=(PtyChoice(),)))


def test_a_missing_file_is_reported_where_it_is_named(tmp_path: Path) -> None:
    """All of one kind in one run: first files, then transports."""
    text = "version: 1\ntransports:\n  - udp4: {port: 0, bind: 10.1.2.300}\n  - serial: {device: x, baud: 115201}\n"
    missing = "references: [r.xml]\nentities: [e.json]\nmanifests: [m.json]\ninterface_paths: [idl]\n"
    for more, wanted in (
        (missing, ["5:14: r.xml", "6:12: e.json", "7:13: m.json", "8:19: the interface path"]),
        ("", ["3:5: '10.1.2.300' is not", "4:5: this system has no serial speed of 115201"]),
    ):
        with pytest.raises(UserError) as caught:
            started(options(text + more, tmp_path))
        reported = [
            without_id(d.headline()).replace(f"{tmp_path}/", "").replace("error: ", "")
            for d in caught.value.diagnostics
        ]
        assert len(reported) == len(wanted)
        for line, begin in zip(reported, wanted, strict=True):
            assert line.startswith(f"agent.yaml:{begin}"), line
