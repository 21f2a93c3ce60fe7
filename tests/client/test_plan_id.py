# SPDX-License-Identifier: Apache-2.0
"""The plan id follows from the plan alone: from all of it, and from no name in Python."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from pathlib import Path
from typing import Any, cast

import pytest

from microros_gen import compiler
from microros_gen.client.plan.entities import Places
from microros_gen.client.plan.plan_id import plan_id
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.runtime_entities import NodePlan, PublisherPlan, SubscriptionPlan, TimerPlan
from microros_gen.client.plan.services import ServicePlan, StoredMessage
from microros_gen.interfaces.find import shipped_folder
from microros_gen.interfaces.types import TypeName
from microros_gen.typesupport.plan.message_pools import BlockSize, MessagePool
from tests.support.plans import EXECUTOR, INT32, POOL, changed

SET_BOOL = TypeName("std_srvs", "srv", "SetBool")
STORED = StoredMessage("request", "x", "x.h", "x_t", ("x.data == NULL",))
EVERYTHING = changed(
    EXECUTOR,
    entities__declared=True,
    entities__nodes=Places(1, (NodePlan(0, "imu", "/arm", "/arm/imu", 77, "given", "/given"),)),
    entities__publishers=Places(1, (PublisherPlan(0, 0, "/a", "rt/a", INT32, True, "own", "/given"),)),
    entities__subscriptions=Places(
        2, (SubscriptionPlan(0, 0, "/b", "rt/b", INT32, True, "x", "x.h", "x_t", ("1",), True, "/given"),), 1
    ),
    entities__services=Places(1, (ServicePlan("service", 0, 0, "/c", SET_BOOL, "own", (STORED,), "/given"),)),
    entities__clients=Places(1, (ServicePlan("client", 0, 0, "/d", SET_BOOL, "own", (STORED,), "/given"),)),
    timers__declared=(TimerPlan(0, 0, "tick", 10, "rtos"),),
    memory__message_pools=(MessagePool("text", "char", "x.h", (BlockSize(9, 2),), (1, 1, 1)),),
)
"""One of each thing that a plan can have."""

FOLLOWING = {"plan_id", "index", "kind", "messages"}
"""Fields that the record has otherwise: `index` is a place in a list, `kind` of a service which list that is;
`messages` follows from the types."""


def variants(value: Any) -> Iterator[tuple[str, Any]]:
    """Yield `value` with one thing changed, for each thing in it, and the path of that."""
    if is_dataclass(value):
        for field in fields(value):
            if field.name in FOLLOWING and not (field.name == "kind" and not isinstance(value, ServicePlan)):
                continue
            for path, other in variants(getattr(value, field.name)):
                yield f".{field.name}{path}", replace(cast(Any, value), **{field.name: other})
    elif isinstance(value, tuple):
        yield "[…]", (*value, value[-1]) if value else ("one",)
        for i, part in enumerate(value):
            yield from (
                (f"[{i}]{path}", (*value[:i], other, *value[i + 1 :])) for path, other in variants(part)
            )
    elif isinstance(value, bool):
        yield "", not value
    elif isinstance(value, int):
        yield "", value + 1
    elif value is None:
        yield "", 1
    else:
        assert isinstance(value, str), value
        yield "", f"{value}x"


def identity(plan: RuntimePlan) -> str:
    return plan_id(plan, ("publish", "session"), ())


def test_each_thing_of_a_plan_changes_the_id() -> None:
    known = {identity(EVERYTHING): "the plan itself"}
    count = 0
    for path, other in variants(EVERYTHING):
        if path.endswith("[…]") and not path.endswith("declared[…]"):
            continue  # a table grows by rows of one kind; each row's values are changed below
        found = identity(other)
        assert found not in known, f"{path} and {known[found]}"
        known[found] = path
        count += 1
    assert count > 120, "every slice was looked at"
    assert any(path.startswith(".memory.message_pools[0].blocks[0]") for path in known.values())


def test_components_and_their_order_change_the_id() -> None:
    ids = {plan_id(POOL, names, ()) for names in ((), ("a",), ("b",), ("a", "b"), ("ab",))}
    assert len(ids) == 5


def test_names_in_python_do_not_change_the_id() -> None:
    """The id of a plan that is written down here: users' libraries are named after it.

    Where a field of the plan gets another name this test is not to be changed. Where the record changes on purpose,
    VERSION in plan_id.py is raised, and this number with it.
    """
    assert identity(POOL) == "b4802b15eb73d4e3"
    assert identity(EVERYTHING) == "5d6ca1b96d5d7c29"


def test_the_representation_of_python_objects_has_no_part_in_it(monkeypatch: pytest.MonkeyPatch) -> None:
    before = identity(EVERYTHING)
    classes = {
        type(part) for part in (EVERYTHING, *(getattr(EVERYTHING, f.name) for f in fields(EVERYTHING)))
    }
    for changed_class in classes - {str}:
        monkeypatch.setattr(changed_class, "__repr__", lambda self: "something else")
    assert identity(EVERYTHING) == before


def test_limits_that_leave_all_sizes_alone_change_the_id(tmp_path: Path) -> None:
    """Two strings that swap their limits: messages are as large as before, and lie elsewhere in their storage."""
    package = tmp_path / "x_msgs" / "msg"
    package.mkdir(parents=True)
    (package / "Two.msg").write_text("string a\nstring b\n")
    (tmp_path / "x_msgs" / "package.xml").write_text("<package><name>x_msgs</name></package>\n")
    assert planned(tmp_path, 16, 32) == planned(tmp_path, 16, 32)
    assert planned(tmp_path, 16, 32) != planned(tmp_path, 32, 16)


def planned(folder: Path, first: int, second: int) -> str:
    config = folder / "microros.yaml"
    config.write_text(
        "version: 1\nprofiles: [pure_sender]\ninterfaces: [x_msgs/msg/Two]\n"
        f"limits: {{x_msgs/msg/Two: {{a: {first}, b: {second}}}}}\n"
    )
    options = compiler.Options(config=config, interface_paths=(folder, shipped_folder()))
    return compiler.plan(compiler.resolve(compiler.read(options))).project.runtime.plan_id
