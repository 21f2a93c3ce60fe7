# SPDX-License-Identifier: Apache-2.0
"""The plan of the client is made of slices by subject; no class of it grows into a record of everything."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
from dataclasses import fields, is_dataclass

import pytest

import microros_gen.client
from tests.support.plans import POOL, changed

MOST_FIELDS = 25


def classes() -> dict[str, type]:
    """Return every class below microros_gen.client by its full name."""
    found: dict[str, type] = {}
    for module in pkgutil.walk_packages(microros_gen.client.__path__, "microros_gen.client."):
        members = inspect.getmembers(importlib.import_module(module.name), inspect.isclass)
        found |= {f"{c.__module__}.{c.__name__}": c for _, c in members if c.__module__ == module.name}
    return found


def test_no_class_of_the_plan_has_more_fields_than_one_can_read() -> None:
    many = {name: len(fields(c)) for name, c in classes().items() if is_dataclass(c)}
    assert "microros_gen.client.plan.runtime.RuntimePlan" in many
    assert {name: count for name, count in many.items() if count > MOST_FIELDS} == {}


def test_slices_cannot_be_changed() -> None:
    for name in (field.name for field in fields(POOL)):
        part = getattr(POOL, name)
        assert not is_dataclass(part) or hash(part) == hash(changed(POOL).__dict__[name])


def test_changed_names_a_field_by_its_path() -> None:
    other = changed(POOL, streams__mtu=64, entities__publishers__max=9, plan_id="x")
    assert (other.streams.mtu, other.entities.publishers.max, other.plan_id) == (64, 9, "x")
    assert other.streams.reliable_slots == POOL.streams.reliable_slots
    with pytest.raises(AttributeError):
        changed(POOL, stream__mtu=64)
    with pytest.raises(TypeError):
        changed(POOL, mtu=64)
