# SPDX-License-Identifier: Apache-2.0
"""Where interfaces are found, and how requests become a closed set."""

from __future__ import annotations

import os
import time
from itertools import permutations
from pathlib import Path

import pytest

from microros_gen.diagnostics import Diagnostics, Source, Span
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import resolve_interfaces
from microros_gen.interfaces.find import InterfaceFinder, Origin, shipped_folder
from microros_gen.interfaces.types import NamedType, TypeName, element_of
from tests.support.ids import without_id
from tests.support.interfaces.resolving import names, package, resolve


def test_search_order_and_hiding(tmp_path: Path) -> None:
    for place in ("path", "ament/share", "pip/share", "shipped"):
        package(tmp_path / place, "all", **{place.split("/")[0].capitalize(): "int32 a"})
    package(tmp_path / "ament/share", "ament_too", A="")
    package(tmp_path / "pip/share", "ament_too", A="")
    package(tmp_path / "shipped", "only_shipped", A="")
    finder = InterfaceFinder(
        (tmp_path / "path",), (tmp_path / "ament",), (tmp_path / "pip",), tmp_path / "shipped"
    )
    assert [(p.name, p.origin) for p in finder.packages()] == [
        ("all", Origin.PATH),
        ("ament_too", Origin.AMENT),
        ("only_shipped", Origin.SHIPPED),
    ]
    assert finder.types("all") == (TypeName("all", "msg", "Path"),)
    _, messages = resolve(finder, "all/Ament")
    assert messages == [
        f"microros-gen: error: package 'all' ({tmp_path}/path/all) has no type 'Ament'. It hides "
        f"{tmp_path}/ament/share/all, which has this type: a package is taken from one place only"
    ]
    assert finder.read(TypeName("all", "msg", "Ament"), Diagnostics()) is None


def test_the_environment_gives_the_places(tmp_path: Path) -> None:
    prefixes = [tmp_path / "one", tmp_path / "two"]
    package(prefixes[0] / "share", "a", A="int8 one")
    package(prefixes[1] / "share", "a", A="int8 two")
    environ = {"AMENT_PREFIX_PATH": os.pathsep.join([str(p) for p in prefixes] + [""])}
    finder = InterfaceFinder.from_environment((), environ, tmp_path)
    assert finder.ament == tuple(prefixes)
    assert finder.shipped == shipped_folder()
    source = finder.read(TypeName("a", "msg", "A"), Diagnostics())
    assert source == Source(str(prefixes[0] / "share/a/msg/A.msg"), "int8 one")


def test_a_path_is_a_package_or_a_folder_of_packages(tmp_path: Path) -> None:
    inner = package(tmp_path / "src", "folder_name", A="")
    (inner / "package.xml").write_text("<package><name>real_name</name></package>", encoding="utf-8")
    package(tmp_path / "src", "b", B="")
    for path, expected in ((tmp_path / "src", ["b", "real_name"]), (inner, ["real_name"])):
        finder = InterfaceFinder((path,))
        assert [p.name for p in finder.packages()] == expected
        interfaces, messages = resolve(finder, "real_name")
        assert (names(interfaces), messages) == (["real_name/msg/A"], [])


def test_a_path_is_printed_as_the_user_gave_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package(tmp_path / "src", "b", B="int32 X")
    monkeypatch.chdir(tmp_path)
    _, messages = resolve(InterfaceFinder((Path("src"),)), "b")
    assert messages[0].startswith("src/b/msg/B.msg:1:7: error: 'X' is not a field name")


def manifest(folder: Path, name: str) -> None:
    (folder / "package.xml").write_text(f"<package><name>{name}</name></package>", encoding="utf-8")


def test_a_workspace_is_searched_as_colcon_does(tmp_path: Path) -> None:
    manifest(package(tmp_path / "src/group/deep", "one", A=""), "one")
    manifest(package(tmp_path / "src", "two", B="one/A a"), "two_by_manifest")
    for hidden in ("build", "install/share", ".git"):
        manifest(package(tmp_path / hidden, "one", A=""), "one")
    (tmp_path / "build/COLCON_IGNORE").touch()
    (tmp_path / "install/COLCON_IGNORE").touch()
    package(tmp_path / "src/group", "no_manifest", A="")  # a folder msg/ that deep may be anything
    manifest(package(tmp_path / "src/two", "inside", A=""), "inside")  # colcon does not look below a package
    finder = InterfaceFinder((tmp_path,), shipped=shipped_folder())
    assert [p.name for p in finder.packages() if p.origin is Origin.PATH] == ["one", "two_by_manifest"]
    interfaces, messages = resolve(finder, "two_by_manifest")
    assert (names(interfaces), messages) == (["one/msg/A", "two_by_manifest/msg/B"], [])
    deciding = set(finder.deciding(["one"]))
    assert {tmp_path / "src/group/deep", tmp_path / "src/group/deep/one/package.xml"} <= deciding


def test_an_installed_prefix_can_be_named(tmp_path: Path) -> None:
    manifest(package(tmp_path / "share", "a", A=""), "a")
    package(tmp_path / "include/a", "a", A="")  # generated headers lie in a folder msg/ too
    interfaces, messages = resolve(InterfaceFinder((tmp_path,)), "a")
    assert (names(interfaces), messages) == (["a/msg/A"], [])


def test_paths_that_hold_nothing_are_errors(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    (tmp_path / "empty").mkdir()
    paths = tuple(tmp_path / name for name in ("none", "file", "empty"))
    diagnostics = Diagnostics()
    InterfaceFinder(paths).check_paths(diagnostics)
    messages = [without_id(d.headline()) for d in diagnostics]
    assert len(messages) == 3
    assert "'" + str(tmp_path / "none") + "' does not exist" in messages[0]
    assert "file' is not a folder" in messages[1]
    assert (
        "empty' contains no interface package. A package has a folder msg/, srv/ or action/; itself"
        in messages[2]
    )


def test_a_package_that_colcon_ignores_can_be_named_itself(tmp_path: Path) -> None:
    folder = package(tmp_path, "arm", A="int32 x")
    (folder / "COLCON_IGNORE").write_text("")
    diagnostics = Diagnostics()
    InterfaceFinder((tmp_path,)).check_paths(diagnostics)
    (found,) = diagnostics
    assert f"contains no interface package. '{folder}' has a file COLCON_IGNORE: name" in found.headline()
    assert resolve(InterfaceFinder((folder,)), "arm")[1] == []


def test_a_folder_with_another_name_in_its_manifest_is_named(tmp_path: Path) -> None:
    folder = package(tmp_path, "arm", A="int32 x")
    (folder / "package.xml").write_text("<package><name>arm_msgs</name></package>")
    _, messages = resolve(InterfaceFinder((tmp_path,), shipped=shipped_folder()), "arm/msg/A")
    assert (
        f"package 'arm'. The folder '{folder}' is the package 'arm_msgs': its package.xml says" in messages[0]
    )


def test_a_file_that_is_not_utf8_is_an_error(tmp_path: Path) -> None:
    folder = package(tmp_path, "a")
    (folder / "msg/A.msg").write_bytes(b"int32 a\n# caf\xe9\nint32 b\n")
    _, messages = resolve(InterfaceFinder((tmp_path,)), "a")
    assert len(messages) == 1
    assert f"{folder / 'msg/A.msg'}:2:" in messages[0]
    assert "error: the file is not UTF-8: byte 0xe9" in messages[0]


@pytest.mark.skipif(os.geteuid() == 0, reason="root reads everything")
def test_an_unreadable_file_is_an_error(tmp_path: Path) -> None:
    path = package(tmp_path, "a", A="int32 a") / "msg/A.msg"
    path.chmod(0)
    _, messages = resolve(InterfaceFinder((tmp_path,)), "a")
    assert f"cannot read '{path}': Permission denied" in messages[0]


def test_a_folder_with_the_name_of_a_file_is_an_error(tmp_path: Path) -> None:
    (package(tmp_path, "a") / "msg/A.msg").mkdir()
    _, messages = resolve(InterfaceFinder((tmp_path,)), "a/A")
    assert "cannot read" in messages[0]


def idl(package_name: str, kind: str, struct: str) -> str:
    return f"module {package_name} {{ module {kind} {{ {struct} }}; }};"


def test_an_idl_file_alone_is_read(tmp_path: Path) -> None:
    folder = package(tmp_path, "a", B="A field")
    (folder / "msg/A.idl").write_text(idl("a", "msg", "struct A { long number; };"), encoding="utf-8")
    (folder / "srv").mkdir()
    parts = "struct Do_Request { a::msg::A a; }; struct Do_Response { boolean done; };"
    text = f'#include "a/msg/A.idl"\n{idl("a", "srv", parts)}'
    (folder / "srv/Do.idl").write_text(text, encoding="utf-8")
    interfaces, messages = resolve(InterfaceFinder((tmp_path,), shipped=shipped_folder()), "a")
    assert messages == []
    assert [str(root) for root in interfaces.roots] == ["a/msg/A", "a/msg/B", "a/srv/Do"]
    assert interfaces.message(TypeName("a", "msg", "A")).fields[0].name == "number"
    assert interfaces.interfaces[TypeName("a", "srv", "Do")].source.name == str(folder / "srv/Do.idl")


def test_an_idl_file_next_to_another_one_is_not_read(tmp_path: Path) -> None:
    folder = package(tmp_path, "a", A="int8 x")
    (folder / "msg/A.idl").write_text("not IDL", encoding="utf-8")
    interfaces, messages = resolve(InterfaceFinder((tmp_path,)), "a")
    assert messages == []
    assert interfaces.interfaces[TypeName("a", "msg", "A")].source.text == "int8 x"


def test_faults_of_idl_files(tmp_path: Path) -> None:
    folder = package(tmp_path, "a")
    (folder / "msg/A.idl").write_text(idl("a", "msg", "struct B { long x; };"), encoding="utf-8")
    (folder / "msg/C.idl").write_text("module a {", encoding="utf-8")
    (folder / "msg/D.idl").write_text(idl("a", "msg", "struct D { b::msg::E e; };"), encoding="utf-8")
    _, messages = resolve(InterfaceFinder((tmp_path,)), "a")
    at = {line.removeprefix(f"{folder}/msg/").split(":")[0]: line for line in messages}
    assert set(at) == {"A.idl", "C.idl", "D.idl"}
    assert "the file declares a/msg/B and not a/msg/A" in at["A.idl"]
    assert "unknown interface package 'b'" in at["D.idl"]


@pytest.mark.parametrize("request_", ["std_msgs/Header", "std_msgs/msg/Header", "/std_msgs/Header"])
def test_forms_of_a_request(request_: str) -> None:
    interfaces, messages = resolve(InterfaceFinder(shipped=shipped_folder()), request_)
    assert messages == []
    assert names(interfaces) == ["builtin_interfaces/msg/Time", "std_msgs/msg/Header"]
    assert interfaces.roots == (TypeName("std_msgs", "msg", "Header"),)
    assert interfaces.closure(interfaces.roots[0]) == (TypeName("builtin_interfaces", "msg", "Time"),)


@pytest.mark.parametrize(
    ("request_", "messages"),
    [
        (
            "std_msg",
            "unknown interface package 'std_msg'. Did you mean 'std_msgs'? Add --interface-path and the folder of",
        ),
        ("std_msgs/Strin", "has no type 'Strin'. Did you mean 'String'?"),
        ("std_msgs/imu", "has no type 'imu'"),
        ("std_msgs/Imu", "has no type 'Imu'. Did you mean 'sensor_msgs/Imu'?"),
        ("pico_msgs", "unknown interface package 'pico_msgs'. Add --interface-path"),
        ("std_srv/srv/Empty", "unknown interface package 'std_srv'. Did you mean 'std_srvs'?"),
        ("std_msgs/srv/Empty", "has no type 'Empty'. It has std_msgs/msg/Empty"),
        ("std_srvs/msg/SetBool", "has no type 'SetBool'. It has std_srvs/srv/SetBool"),
        ("std_srvs/srv/SetBol", "has no type 'SetBol'. Did you mean 'SetBool'?"),
        ("std_srvs/srv/SetBool_Goals", "has no type 'SetBool_Goals'. Did you mean 'SetBool'?"),
        ("nav_msgs/srv/SetBool", "has no type 'SetBool'. Did you mean 'example_interfaces/srv/SetBool'?"),
        ("std_msgs/idl/Empty", "the kinds of interfaces are msg, srv, action, not 'idl'. Write std_msgs/msg"),
        (
            "a/b/c/d",
            "'a/b/c/d' names no interface. Write pkg, pkg/Type, pkg/msg/Type, pkg/srv/Type or pkg/ac",
        ),
        ("", "unknown interface package ''"),
        ("..", "unknown interface package '..'"),
        ("../idl/std_msgs", "unknown interface package '..'"),
    ],
)
def test_requests_that_name_nothing(request_: str, messages: str) -> None:
    interfaces, found = resolve(InterfaceFinder(shipped=shipped_folder()), request_)
    assert len(interfaces) == 0
    assert len(found) == 1
    assert messages in found[0]


def test_a_fault_is_reported_at_the_request() -> None:
    span = Span(Source("microros.yaml", "interfaces: [nope]"), 1, 14, 18)
    diagnostics = Diagnostics()
    resolve_interfaces((Named("nope", span),), InterfaceFinder(), diagnostics)
    (found,) = diagnostics
    assert without_id(found.headline()).startswith(
        "microros.yaml:1:14: error: unknown interface package 'nope'"
    )
    assert "looked in nowhere" in without_id(found.headline())


def test_a_missing_dependency_is_reported_at_the_field_that_needs_it(tmp_path: Path) -> None:
    package(tmp_path, "a", A="int8 x\nHeader header\nnope/Type[3] other\nstd_msgs/Int33 number")
    _, messages = resolve(InterfaceFinder((tmp_path,), shipped=shipped_folder()), "a")
    place = f"{tmp_path}/a/msg/A.msg"
    assert messages[0].startswith(
        f"{place}:2:1: error: package 'a' ({tmp_path}/a) has no type 'Header', which"
    )
    assert (
        "Did you mean 'std_msgs/Header'? A type without its package is one of the same package" in messages[0]
    )
    assert messages[1].startswith(
        f"{place}:3:1: error: unknown interface package 'nope', which the field 'other'"
    )
    assert f"looked in {tmp_path}, the definitions that ship" in messages[1]
    assert messages[2].startswith(f"{place}:4:1: error: ")
    assert "Did you mean 'Int32'?" in messages[2]


def test_faults_of_every_file_are_reported_in_one_run(tmp_path: Path) -> None:
    package(tmp_path, "a", A="int32 X\nb/B b", C="int33 c")
    package(tmp_path, "b", B="int32 Y")
    _, messages = resolve(InterfaceFinder((tmp_path,)), "a", "b", "c")
    assert len(messages) == 4


def test_cycles_are_reported_once_each_at_a_field(tmp_path: Path) -> None:
    package(tmp_path, "a", Self="int8 x\nSelf me", A="B b", B="c/C[] c", Outside="A a")
    package(tmp_path, "c", C="int8 x\na/A a")
    interfaces, messages = resolve(InterfaceFinder((tmp_path,)), "a")
    assert len(messages) == 2
    assert any(
        s.startswith(f"{tmp_path}/a/msg/Self.msg:2:1: error: a message contains itself") for s in messages
    )
    ring = "a message contains itself: a/msg/A → a/msg/B → c/msg/C → a/msg/A"
    assert any(s.startswith(f"{tmp_path}/a/msg/A.msg:1:1: error: {ring}") for s in messages)
    assert names(interfaces) == ["a/msg/Outside"]


def test_dependencies_are_first_and_the_order_is_fixed() -> None:
    finder = InterfaceFinder(shipped=shipped_folder())
    requests = ["nav_msgs", "sensor_msgs/Imu", "std_msgs/Header"]
    orders = [names(resolve(finder, *order)[0]) for order in permutations(requests)]
    assert all(order == orders[0] for order in orders)
    interfaces, _ = resolve(finder, *requests)
    before: set[TypeName] = set()
    for interface in interfaces:
        for message in interface.messages:
            needs = [element_of(field.type) for field in message.fields]
            assert {n.name for n in needs if isinstance(n, NamedType)} <= before
            before.add(message.name)
    assert before == set(interfaces.messages)
    assert len(before) > len(interfaces)


def test_all_of_common_interfaces_resolves_quickly() -> None:
    finder = InterfaceFinder(shipped=shipped_folder())
    requests = [p.name for p in finder.packages()]
    best = 1.0
    for _ in range(3):
        start = time.process_time()
        interfaces, messages = resolve(finder, *requests)
        best = min(best, time.process_time() - start)
    assert messages == []
    assert len(interfaces) > 180
    assert best < 0.4, f"{best:.3f} s"
