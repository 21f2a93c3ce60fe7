# SPDX-License-Identifier: Apache-2.0
"""Names that an application passes: the C library's judge and expansion against ROS 2's own."""

from __future__ import annotations

import ctypes
import subprocess
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.support.application.names import NAMES, accepted
from tests.support.examples import examples
from tests.support.plans import POOL, changed
from tests.support.runtime.harness import components, render

pytestmark = pytest.mark.ros

PROBE = """\
#include <stdlib.h>
#include "microros/rcl_names.h"
#include "microros/rcl_names_take.h"
#include "microros/rmw_names.h"
#include "rcl/expand_topic_name.h"
#include "rcl/validate_topic_name.h"

static void * give(size_t size, void * state)
{
  (void)state;
  return malloc(size);
}
static void take(void * pointer, void * state)
{
  (void)state;
  free(pointer);
}
static void * give_again(void * pointer, size_t size, void * state)
{
  (void)state;
  return realloc(pointer, size);
}
static void * give_zero(size_t count, size_t size, void * state)
{
  (void)state;
  return calloc(count, size);
}

void probe_topic(const char * topic, const char * node, const char * space, char * full);
void probe_topic(const char * topic, const char * node, const char * space, char * full)
{
  const rmw_name_t name = rmw_name_of_topic(topic, node, space);
  rmw_name_copy(&name, full);
}

const char * probe_take(const char * topic, const char * node, const char * space, char * full);
const char * probe_take(const char * topic, const char * node, const char * space, char * full)
{
  const rmw_node_t place = {.name = node, .namespace_ = space};
  rcl_names_topic_t taken;
  const char * fault = rcl_names_take(&taken, topic, &place);

  for (size_t i = 0; fault == NULL && (i == 0u || taken.name[i - 1u] != 0); ++i) {
    full[i] = taken.name[i];
  }
  return fault;
}

int probe_expand(const char * topic, const char * node, const char * space, char ** full);
int probe_expand(const char * topic, const char * node, const char * space, char ** full)
{
  const rcl_allocator_t heap = {give, take, give_again, give_zero, NULL};
  const rcutils_string_map_t none = rcutils_get_zero_initialized_string_map();
  return rcl_expand_topic_name(topic, node, space, &none, heap, full);
}

int probe_index(const char * topic);
int probe_index(const char * topic)
{
  int result = -1;
  size_t index = 0;
  if (rcl_validate_topic_name(topic, &result, &index) != RCL_RET_OK) {
    return -2;
  }
  return result == RCL_TOPIC_NAME_VALID ? -1 : (int)index;
}
"""
SOURCES = (
    "node/rcl_names.c",
    "node/rcl_names_expand.c",
    "node/rmw_names.c",
    "node/rcl_topic_name.c",
    "name_substitutions/rcl_names_substitute.c",
    "memory/rcutils_string_map.c",
    "memory/rcutils_allocator.c",
    "memory/arena_none.c",
    "session/microros_text.c",
    "support/error_code.c",
    "support/error_state.c",
)
SCOPES = st.tuples(st.sampled_from(["node", "n_2"]), st.sampled_from(["/", "/ns", "/a/b"]))
FRAGMENTS_PER_SAMPLE = [
    "a",
    "b2",
    "3",
    "/",
    "~",
    "_",
    "{node}",
    "{ns}",
    "{namespace}",
    "{x}",
    "{",
    "}",
    "-",
    "{1}",
    "{}",
]
MORE_NAMES = st.lists(st.sampled_from(FRAGMENTS_PER_SAMPLE), max_size=6).map("".join)


class Names:
    """The functions of the C library, in this process; with `name_substitutions`."""

    def __init__(self, library: Path) -> None:
        self._library = ctypes.CDLL(str(library))
        for kind in ("node", "namespace", "topic"):
            getattr(self._library, f"rcl_names_check_{kind}").restype = ctypes.c_char_p
        self._library.probe_take.restype = ctypes.c_char_p

    def accepts(self, kind: str, name: str) -> bool:
        check = getattr(self._library, f"rcl_names_check_{kind}")
        return check(name.encode()) is None

    def expand(self, topic: str, node: str, namespace: str) -> str:
        full = ctypes.create_string_buffer(1000)
        self._library.probe_topic(topic.encode(), node.encode(), namespace.encode(), full)
        return full.value.decode()

    def taken(self, topic: str, node: str, namespace: str) -> str | None:
        """Return what rcl_publisher_init & co. hand on; None: they refuse it."""
        full = ctypes.create_string_buffer(1000)
        fault = self._library.probe_take(topic.encode(), node.encode(), namespace.encode(), full)
        return None if fault else full.value.decode()

    def expanded(self, topic: str, node: str, namespace: str) -> str | int:
        """Return what rcl_expand_topic_name gives: a name, or its return code."""
        full = ctypes.c_char_p()
        words = (topic.encode(), node.encode(), namespace.encode())
        code = self._library.probe_expand(*words, ctypes.byref(full))
        return code or (full.value or b"").decode()

    def index(self, topic: str) -> int | None:
        """Return where rcl_validate_topic_name finds a fault; None without one."""
        index = self._library.probe_index(topic.encode())
        return None if index == -1 else index


@pytest.fixture(scope="module")
def names(tmp_path_factory: pytest.TempPathFactory) -> Names:
    folder = tmp_path_factory.mktemp("names")
    plan = changed(POOL, errors__text_size=0)
    tree = render(folder, plan, [*components(plan), "name_substitutions"])
    (folder / "probe.c").write_text(PROBE, encoding="utf-8")
    command = ["gcc", "-shared", "-fPIC", "-Wall", "-Wextra", "-Werror", f"-I{tree.include}"]
    sources = [str(folder / "src" / source) for source in SOURCES]
    parts = [str(folder / "probe.c"), *sources, "-Wl,--no-undefined", "-o", str(folder / "names.so")]
    subprocess.run([*command, *parts], check=True)
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
@settings(max_examples=examples(400))
def test_topics(names: Names, ros: Any, name: str, namespace: str) -> None:
    """Without `name_substitutions`: no substitutions, and no `~x`, which rcl accepts with a single character.

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
@settings(max_examples=examples(300))
def test_nodes_and_namespaces(names: Names, ros: Any, name: str) -> None:
    if len(name) > 200:
        return
    assert names.accepts("node", name) == accepted(ros.validate_node_name.validate_node_name, name)
    full = name if name.startswith("/") else f"/{name}"
    assert names.accepts("namespace", name) == accepted(ros.validate_namespace.validate_namespace, full)


@given(name=st.one_of(NAMES, MORE_NAMES), scope=SCOPES)
@settings(max_examples=examples(600))
def test_names_with_substitutions(names: Names, ros: Any, name: str, scope: tuple[str, str]) -> None:
    """What is passed to rcl_publisher_init, and what rcl_expand_topic_name gives."""
    node, namespace = scope
    if len(name) == 2 and name[0] == "~":
        return

    def expand() -> str:
        full: str = ros.expand_topic_name.expand_topic_name(name, node, namespace)
        return full

    def judge(_: str) -> None:
        ros.validate_full_topic_name.validate_full_topic_name(expand())

    ours = names.expanded(name, node, namespace)
    if accepted(lambda _: expand(), name):
        assert ours == expand()
        assert names.taken(name, node, namespace) == (ours if accepted(judge, name) else None)
    else:
        assert ours in (103, 105)
        assert names.taken(name, node, namespace) is None


@given(name=st.one_of(NAMES, MORE_NAMES))
@settings(max_examples=examples(600))
def test_where_a_topic_is_wrong(names: Names, ros: Any, name: str) -> None:
    from rclpy.impl.implementation_singleton import rclpy_implementation

    fault = rclpy_implementation.rclpy_get_validation_error_for_topic_name(name)
    if "\0" in name or (len(name) == 2 and name[0] == "~"):
        return  # rcl takes ~x, and refuses ~xy: it does not look at what is last
    assert names.index(name) == (fault[1] if fault else None)
