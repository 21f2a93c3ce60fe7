# SPDX-License-Identifier: Apache-2.0
"""Requests to a parameter server, byte for byte: limits, byte orders, what is cut or invented. No agent takes part."""

from __future__ import annotations

import random
import struct
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import resolve_interfaces
from microros_gen.interfaces.find import InterfaceFinder, shipped_folder
from microros_gen.ros.codec import ENCAPSULATION_BYTES, Codec
from tests.support.e2e.images import C_FILES, SANITIZE, Images
from tests.support.e2e.relay import Relay
from tests.support.patience import seconds

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
nodes: [{name: device, namespace: /arm}]
"""
SERVICES = {
    "get_parameters": "GetParameters",
    "get_parameter_types": "GetParameterTypes",
    "describe_parameters": "DescribeParameters",
    "list_parameters": "ListParameters",
    "set_parameters": "SetParameters",
    "set_parameters_atomically": "SetParametersAtomically",
}
BOOL, INTEGER, DOUBLE, STRING = 1, 2, 3, 4
VALUES = {BOOL: "bool_value", INTEGER: "integer_value", DOUBLE: "double_value", STRING: "string_value"}
REFUSED = None
CUT_SIZE = 4
"""What the middleware leaves of a request that is too large."""


@pytest.fixture(scope="module")
def codec() -> Codec:
    names = tuple(Named(f"rcl_interfaces/srv/{name}", None) for name in SERVICES.values())
    finder = InterfaceFinder.from_environment((shipped_folder(),))
    return Codec(resolve_interfaces(names, finder, Diagnostics()))


class Server:
    """The program, and the codec for what goes in and out."""

    def __init__(self, process: subprocess.Popen[str], codec: Codec) -> None:
        self._process, self._codec = process, codec

    def raw(self, service: str, body: bytes, order: str = "") -> bytes | None:
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(f"{service} {order}{body.hex()}\n")
        self._process.stdin.flush()
        line = self._process.stdout.readline().rstrip("\n")
        assert line, "the program has ended"
        return REFUSED if line == "refused" else bytes.fromhex(line[1:])

    def request(self, service: str, **members: Any) -> bytes:
        name = f"rcl_interfaces/srv/{SERVICES[service]}_Request"
        return self._codec.encode(name, members)[ENCAPSULATION_BYTES:]

    def reply(self, service: str, body: bytes) -> dict[str, Any]:
        return self._codec.decode(f"rcl_interfaces/srv/{SERVICES[service]}_Response", b"\0\1\0\0" + body)

    def call(self, service: str, **members: Any) -> dict[str, Any]:
        body = self.raw(service, self.request(service, **members))
        assert body is not REFUSED
        return self.reply(service, body)

    def values(self, *names: str) -> list[Any]:
        found = self.call("get_parameters", names=list(names))["values"]
        return [value[VALUES[value["type"]]] if value["type"] else None for value in found]

    def set(self, *pairs: tuple[str, int, Any]) -> list[str]:
        """Set parameters of these types; return the reasons, "ok" for success."""
        results = self.call("set_parameters", parameters=parameters(*pairs))["results"]
        return ["ok" if result["successful"] else result["reason"] for result in results]


def parameters(*pairs: tuple[str, int, Any]) -> list[dict[str, Any]]:
    return [
        {"name": name, "value": {"type": kind, **({VALUES[kind]: value} if kind in VALUES else {})}}
        for name, kind, value in pairs
    ]


@pytest.fixture(scope="module")
def program(images: Images, image_port: Relay, tmp_path_factory: pytest.TempPathFactory) -> Path:
    image = images.build(image_port.port, APPLICATION)
    path = tmp_path_factory.mktemp("requests") / "requests"
    return image.application(
        C_FILES / "parameter_requests.c", path, "-std=c99", "-Wall", "-Wextra", "-Werror"
    )


@contextmanager
def serving(program: Path, codec: Codec, *arguments: str) -> Iterator[Server]:
    pipe = subprocess.PIPE
    with subprocess.Popen([program, *arguments], stdin=pipe, stdout=pipe, stderr=pipe, text=True) as process:
        yield Server(process, codec)
        _, errors = process.communicate(timeout=seconds(20))
    assert (process.returncode, errors) == (0, "")


def test_more_names_than_parameters(program: Path, codec: Codec) -> None:
    """As many as the reply holds; with more of them it is empty, never cut."""
    with serving(program, codec) as server:
        assert server.values("a", "a", "b.steps", "a") == [False, False, 0, False]
        assert server.call("get_parameters", names=["a"] * 20)["values"] == []
        assert server.call("describe_parameters", names=["a"] * 40)["descriptors"] == []
        assert server.call("get_parameter_types", names=["a"] * 4)["types"] == bytes([BOOL] * 4)
        assert server.call("get_parameter_types", names=["a"] * 20)["types"] == b""


def test_more_sets_than_parameters_each_have_a_result(program: Path, codec: Codec) -> None:
    """Room for reasons runs out before room for results does."""
    with serving(program, codec) as server:
        results = server.call("set_parameters", parameters=parameters(*[("b.steps", DOUBLE, 1.0)] * 6))[
            "results"
        ]
        assert len(results) == 6
        assert [result["successful"] for result in results] == [False] * 6
        assert "Wrong parameter type" in results[0]["reason"]
        assert server.set(*[("b.steps", INTEGER, value) for value in range(6)]) == ["ok"] * 6
        assert server.values("b.steps") == [5]


def test_too_large_a_request_changes_nothing(program: Path, codec: Codec) -> None:
    with serving(program, codec) as server:
        many = server.request("set_parameters", parameters=parameters(*[("a", BOOL, True)] * 9))
        assert server.raw("set_parameters", many) is REFUSED
        assert server.values("a") == [False]


def test_cut_requests_are_answered(program: Path, codec: Codec) -> None:
    """Of a request larger than its queue holds, the length of its list arrives: each entry is refused with a reason."""
    reason = "the request is too large, none of it was set"
    with serving(program, codec) as server:
        for count in (9, 30, 2**32 - 1):
            cut = struct.pack("<I", count)
            for service in (
                "get_parameters",
                "get_parameter_types",
                "describe_parameters",
                "list_parameters",
            ):
                body = server.raw(service, cut)
                assert body is not REFUSED
                assert set(body) == {0}, "an empty reply"
            whole = server.raw("set_parameters_atomically", cut)
            assert whole is not REFUSED
            result = server.reply("set_parameters_atomically", whole)["result"]
            assert result == {"successful": False, "reason": reason}
            each = server.raw("set_parameters", cut)
            assert each is not REFUSED
            results = server.reply("set_parameters", each)["results"]
            assert len(results) == (count if count < 50 else 0)
            assert not any(result["successful"] for result in results)
            assert {result["reason"] for result in results} <= {reason, ""}
            assert count > 50 or results[0]["reason"] == reason
        assert server.set(("a", BOOL, True)) == ["ok"]
        assert len(server.call("list_parameters", prefixes=[], depth=0)["result"]["names"]) == 3


def test_long_names_are_unknown_ones(program: Path, codec: Codec) -> None:
    with serving(program, codec) as server:
        (reason,) = server.set(("é" * 100, BOOL, True))
        assert reason == f"parameter '{'é' * 44}' cannot be set because it was not declared"
        assert server.set(("", BOOL, True)) == ["parameter name must not be empty"]
        assert server.values("b.gain" + "x" * 100) == []


def test_no_parameter_at_all(program: Path, codec: Codec) -> None:
    with serving(program, codec) as server:
        assert server.call("set_parameters", parameters=[])["results"] == []
        result = server.call("set_parameters_atomically", parameters=[])["result"]
        assert (result["successful"], result["reason"]) == (False, "parameter list cannot be empty")


def test_values_of_the_whole_range(program: Path, codec: Codec) -> None:
    with serving(program, codec) as server:
        for value in (-(2**63), 2**63 - 1, -1, 0):
            assert server.set(("b.steps", INTEGER, value)) == ["ok"]
            assert server.values("b.steps") == [value]
        for number in (float("inf"), -0.0, 5e-324):
            assert server.set(("b.gain", DOUBLE, number)) == ["ok"]
            assert server.values("b.gain") == [number]
        assert server.set(("b.steps", INTEGER, 66)) == ["rejected by the callback"]
        assert server.set(("a", 200, None))[0].endswith("setting it to {unknown type} is not allowed.")


def test_big_endian_requests(program: Path, codec: Codec) -> None:
    with serving(program, codec) as server:
        body = struct.pack(">II8sII2s", 2, 8, b"b.steps\0", 1, 2, b"a\0")[:-1]
        found = server.raw(
            "get_parameter_types", struct.pack(">II8sI2s", 2, 8, b"b.steps\0", 2, b"a\0"), "big"
        )
        assert found is not REFUSED
        assert server.reply("get_parameter_types", found)["types"] == bytes([INTEGER, BOOL])
        assert server.raw("get_parameter_types", body) is REFUSED


def test_undeclared_parameters(program: Path, codec: Codec) -> None:
    """As rclcpp: created with the type of the value, which may change, and deleted without one. rclcpp also declares a
    name without a value, which is refused here.
    """
    with serving(program, codec, "undeclared") as server:
        assert server.set(("new", INTEGER, 5), ("more", INTEGER, 6)) == [
            "ok",
            "no place for parameter 'more'",
        ]
        assert server.values("new", "missing") == [5, None]
        (new, missing) = server.call("describe_parameters", names=["new", "missing"])["descriptors"]
        assert (new["type"], new["dynamic_typing"]) == (INTEGER, True)
        assert (missing["name"], missing["type"]) == ("missing", 0)
        assert server.set(("new", DOUBLE, 0.5), ("a", 0, None)) == [
            "ok",
            "cannot undeclare a statically typed parameter",
        ]
        assert server.values("new") == [0.5]
        assert server.set(("new", 0, None), ("new", 0, None)) == [
            "ok",
            "parameter 'new' cannot be set because it was not declared",
        ]
        assert server.set(("x" * 50, BOOL, True)) == [f"parameter name '{'x' * 50}' is too long"]
        assert server.set(("x" * 90, BOOL, True)) == [f"parameter name '{'x' * 89}' is too long"]
        assert server.set(("text", STRING, "t")) == ["parameter 'text' cannot have a value of type {string}"]
        two = parameters(("one", BOOL, True), ("two", BOOL, True))
        assert server.call("set_parameters_atomically", parameters=two)["result"] == {
            "successful": False,
            "reason": "no place for parameter 'two'",
        }
        assert sorted(server.call("list_parameters", prefixes=[], depth=0)["result"]["names"]) == [
            "a",
            "b.gain",
            "b.steps",
        ]


IN_FLASH = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
pools: {parameters: 4}
nodes:
  - name: device
    namespace: /arm
    parameters:
      - {name: a, type: bool, default: true}
      - {name: b.steps, type: integer, default: 4}
      - {name: b.gain, type: double, default: 0.5}
"""


@pytest.fixture
def program_in_flash(images: Images, image_port: Relay, tmp_path: Path) -> Path:
    image = images.build(image_port.port, IN_FLASH)
    program = tmp_path / "in_flash"
    return image.application(C_FILES / "parameter_requests.c", program, "-std=c99", "-DREQUESTS_DECLARED")


def test_a_name_twice_in_a_request(program_in_flash: Path, codec: Codec) -> None:
    """As in rclcpp what is set and deleted is deleted, in either order; no request writes past the last place."""
    with serving(program_in_flash, codec, "undeclared") as server:

        def all_of(*values: tuple[str, int, Any]) -> str:
            found = server.call("set_parameters_atomically", parameters=parameters(*values))["result"]
            return str(found["reason"]) if not found["successful"] else "ok"

        def names() -> list[str]:
            return sorted(server.call("list_parameters", prefixes=[], depth=0)["result"]["names"])

        declared = ["a", "b.gain", "b.steps"]
        for request in (
            (("new", 0, None), ("new", INTEGER, 5)),
            (("new", INTEGER, 5), ("new", 0, None)),
            (("new", 0, None), ("new", 0, None)),
            (("new", 0, None), ("new", 0, None), ("new", DOUBLE, 1.5)),
        ):
            assert all_of(("new", INTEGER, 1)) == "ok"
            assert names() == [*declared, "new"]
            assert all_of(*request) == "ok"
            assert names() == declared
        assert all_of(("new", INTEGER, 1), ("new", DOUBLE, 0.5)) == "ok", "one place for both"
        assert server.values("new") == [0.5]
        assert all_of(("other", INTEGER, 1)) == "no place for parameter 'other'"
        assert server.values("a", "b.steps", "b.gain", "new") == [True, 4, 0.5, 0.5]


def test_an_unknown_name_in_a_request_that_is_applied_as_a_whole(program: Path, codec: Codec) -> None:
    """The words of rclcpp's parameter service, which differ from those for each parameter."""
    with serving(program, codec) as server:
        both = parameters(("a", BOOL, True), ("x", BOOL, True))
        assert server.call("set_parameters_atomically", parameters=both)["result"] == {
            "successful": False,
            "reason": "One or more parameters were not declared before setting",
        }
        assert server.set(("x", BOOL, True)) == ["parameter 'x' cannot be set because it was not declared"]


DECLARED = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
nodes:
  - name: device
    namespace: /arm
    parameters:
      - {name: on, type: bool, default: true}
      - {name: motor.gain, type: double, default: 0.5}
      - {name: steps, type: integer, default: -9223372036854775808}
      - {name: int, type: integer, one_of: [7, 0]}
      - {name: label, type: string, size: 5, default: left}
      - {name: integers, type: "integer[]", size: 3, default: [1, -2]}
      - {name: bytes, type: "byte[]", size: 2, default: [255]}
      - {name: names, type: "string[]", size: 2, default: [a]}
"""


@pytest.mark.parametrize("flags", [(), pytest.param(("-m32",), marks=pytest.mark.variant)], ids=["64", "32"])
def test_the_struct_of_declared_values(
    images: Images, image_port: Relay, tmp_path: Path, flags: tuple[str, ...]
) -> None:
    """It has every value, says what changed, and keeps what was deleted."""
    image = images.build(image_port.port, DECLARED, flags=(*SANITIZE, *flags) if flags else ())
    program = image.application(
        C_FILES / "parameter_values.c", tmp_path / "values", "-std=c99", "-Wall", "-Wextra", "-Werror"
    )
    run = subprocess.run([program], capture_output=True, text=True, timeout=seconds(20), check=False)
    assert (run.returncode, run.stderr) == (0, "")
    first = "on=1 motor_gain=0.5 steps=-9223372036854775808 int_=0 label=left 1 -2 255 'a'"
    changed = "on=1 motor_gain=-1.5 steps=-9223372036854775808 int_=0 label=right 4 5 6"
    assert run.stdout.splitlines() == [
        f"1 {first}",
        f"0 {first}",
        f"1 {changed} 255 '' 'second'",
        f"1 {changed} '' 'second'",
        f"0 {changed} '' 'second'",
    ]


def test_cut_and_changed_requests(program: Path, codec: Codec) -> None:
    """Each prefix of a request, and thousands of requests with wrong bytes: a reply or a refusal, and no error of a
    sanitizer."""
    chance = random.Random(14)
    with serving(program, codec, "undeclared") as server:
        three = parameters(("a", BOOL, True), ("b.steps", INTEGER, 7), ("c", DOUBLE, 1.5))
        bodies = {
            "get_parameters": server.request("get_parameters", names=["a", "b.gain"]),
            "describe_parameters": server.request("describe_parameters", names=["a", "b.gain"]),
            "list_parameters": server.request("list_parameters", prefixes=["b", "c"], depth=1),
            "set_parameters": server.request("set_parameters", parameters=three),
            "set_parameters_atomically": server.request("set_parameters_atomically", parameters=three),
        }
        for service, body in bodies.items():
            cut = {server.raw(service, body[:end]) for end in range(len(body)) if end != CUT_SIZE}
            assert cut == {REFUSED}
            for _ in range(300):
                changed = bytearray(body)
                for _ in range(chance.randint(1, 4)):
                    changed[chance.randrange(len(changed))] = chance.choice(
                        (0, 1, 255, chance.randrange(256))
                    )
                server.raw(service, bytes(changed), chance.choice(("", "big")))
        assert len(server.call("list_parameters", prefixes=[], depth=0)["result"]["names"]) <= 4
