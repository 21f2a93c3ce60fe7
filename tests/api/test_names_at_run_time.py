# SPDX-License-Identifier: Apache-2.0
"""Names that an application passes: the C library's judge and expansion against ROS 2's own."""

from __future__ import annotations

import ctypes
import subprocess
from pathlib import Path
from typing import Any

import pytest
from application.test_names import NAMES, accepted
from hypothesis import given, settings
from hypothesis import strategies as st

from microros_gen.sources.components import components_folder

pytestmark = pytest.mark.ros

PROBE = """\
#include "microros/rcl_names.h"
#include "microros/rmw_names.h"
void probe_topic(const char * topic, const char * node, const char * space, char * full);
void probe_topic(const char * topic, const char * node, const char * space, char * full)
{
  const rmw_name_t name = rmw_name_of_topic(topic, node, space);
  rmw_name_copy(&name, full);
}
"""


class Names:
    """The functions of the C library, in this process."""

    def __init__(self, library: Path) -> None:
        self._library = ctypes.CDLL(str(library))
        for kind in ("node", "namespace", "topic"):
            getattr(self._library, f"rcl_names_check_{kind}").restype = ctypes.c_char_p

    def accepts(self, kind: str, name: str) -> bool:
        check = getattr(self._library, f"rcl_names_check_{kind}")
        return check(name.encode()) is None

    def expand(self, topic: str, node: str, namespace: str) -> str:
        full = ctypes.create_string_buffer(1000)
        self._library.probe_topic(topic.encode(), node.encode(), namespace.encode(), full)
        return full.value.decode()


@pytest.fixture(scope="module")
def names(tmp_path_factory: pytest.TempPathFactory) -> Names:
    folder = tmp_path_factory.mktemp("names")
    (folder / "probe.c").write_text(PROBE, encoding="utf-8")
    root = components_folder()
    sources = [
        root / "node/src/rcl_names.c",
        root / "node/src/rmw_names.c",
        root / "session/src/microros_text.c",
    ]
    command = ["gcc", "-shared", "-fPIC", "-Wall", "-Wextra", "-Werror", "-o", str(folder / "names.so")]
    includes = [f"-I{root / name / 'include'}" for name in ("node", "session")]
    subprocess.run([*command, *includes, str(folder / "probe.c"), *map(str, sources)], check=True)
    return Names(folder / "names.so")


@pytest.fixture(scope="module")
def ros() -> Any:
    pytest.importorskip("rclpy")
    import rclpy.expand_topic_name
    import rclpy.validate_full_topic_name
    import rclpy.validate_namespace
    import rclpy.validate_node_name
    import rclpy.validate_topic_name

    return rclpy


@given(name=NAMES, namespace=st.sampled_from(["/", "/ns", "/a/b"]))
@settings(max_examples=400)
def test_topics(names: Names, ros: Any, name: str, namespace: str) -> None:
    """Substitutions are for the application file alone, and so is `~x`, which rcl joins to the node's name.

    How long a name may be is a matter of the plan: it is declared, or `pools: {name_size: …}` bounds it.
    """

    def judge(text: str) -> None:
        ros.validate_topic_name.validate_topic_name(text)
        full = ros.expand_topic_name.expand_topic_name(text, "node", namespace)
        ros.validate_full_topic_name.validate_full_topic_name(full)

    if len(name) > 200:
        return
    theirs = accepted(judge, name)
    if "{" in name or (name.startswith("~") and name[1:2] not in ("", "/")):
        assert not names.accepts("topic", name)
        return
    assert names.accepts("topic", name) == theirs
    if theirs:
        full = ros.expand_topic_name.expand_topic_name(name, "node", namespace)
        assert names.expand(name, "node", namespace) == full


@given(name=NAMES)
@settings(max_examples=300)
def test_nodes_and_namespaces(names: Names, ros: Any, name: str) -> None:
    if len(name) > 200:
        return
    assert names.accepts("node", name) == accepted(ros.validate_node_name.validate_node_name, name)
    full = name if name.startswith("/") else f"/{name}"
    assert names.accepts("namespace", name) == accepted(ros.validate_namespace.validate_namespace, full)
