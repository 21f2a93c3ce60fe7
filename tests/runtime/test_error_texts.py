# SPDX-License-Identifier: Apache-2.0
"""What error texts of the C library advise: the application file takes it."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.application.model import MOST_HISTORY
from microros_gen.application.parser import parse_application
from microros_gen.client.plan.declared import LARGEST_POOL
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.transport_sizes import LARGEST_MTU
from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.documents.templates import make_environment
from microros_gen.interfaces.types import NamedType, element_of
from microros_gen.selection.find_components import components_folder, load_catalogue
from tests.support.components.rendered import planned
from tests.support.ids import without_id
from tests.support.plans import POOL, changed

TEXT = re.compile(
    r'^const MICROROS_FLASH char (microros_error_\w+)\[\] =\n? *((?:"[^"\n]*"(?: XRCE_\w+ )?\s*)+);',
    re.MULTILINE,
)
VALUES = {"%m": "9", "%n": "8", "%s": "x", "%d": "true", "%D": "std_msgs/msg/Int32"}
PLACES = {"{%t: {%d}}": "{std_msgs/msg/String: {data: 8}}", "{node: %s, %d: %n}": "{node: x, string: 8}"}
"""The fragments in which %d is a key, as the functions that set the error fill it."""
POOL_KEYS = (
    "timers",
    "executors",
    "handles",
    "guard_conditions",
    "wait_sets",
    "ros_clocks",
    "jump_callbacks",
)
"""The values of %s in `pools: {%s: %m}`."""


def texts() -> dict[str, str]:
    """Return every error text of the library: of component.yaml, and those in plain files."""
    errors = [error for component in load_catalogue().values() for error in component.contributes.errors]
    found = {f"microros_error_{error.name}": error.text for error in errors if error.text}
    for path in sorted(components_folder().rglob("*.c")):
        for name, literals in TEXT.findall(path.read_text(encoding="utf-8")):
            found[name] = "".join(re.findall(r'"([^"]*)"', literals))
    return found


def advised(text: str) -> list[str]:
    """Return the lines of an application file that a text advises."""
    nested = r"\{(?:[^{}]|\{(?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*\})*\}"
    return re.findall(
        r"\b(?:pools|memory|transport): \{[^}]*\}|on_full: block \d+ ms|parameter_clients: \[.*?\]"
        rf"|set limits: {nested}",
        text,
    )


def refused(line: str) -> list[str]:
    diagnostics = Diagnostics()
    custom = (
        line.replace("{", "{type: custom, ") if line.startswith("transport") else line.removeprefix("set ")
    )
    if line.startswith("parameter_clients"):
        custom = f"nodes: [{{name: n, {line}}}]"
    parse_application(Source("f", f"version: 1\nprofiles: [pure_sender]\n{custom}\n"), diagnostics)
    return [without_id(d.headline()) for d in diagnostics]


def filled(text: str) -> str:
    for placeholder, value in {**PLACES, **VALUES}.items():
        text = text.replace(placeholder, value)
    return text


def test_every_key_that_a_text_names_is_taken() -> None:
    lines = {line for text in texts().values() for line in advised(text)}
    assert len(lines) > 5, "the pattern finds the texts"
    each = {
        filled(line.replace("{%s:", f"{{{key}:"))
        for line in lines
        for key in (POOL_KEYS if "{%s:" in line else ("",))
    }
    assert {line: hit for line in sorted(each) if (hit := refused(line))} == {}


def full_text(plan: RuntimePlan) -> str:
    template = make_environment().get_template("publish/src/error_text_full.c.j2")
    found = TEXT.search(template.render(plan=plan, selection=None, headers=[]))
    assert found
    return found[2]


@pytest.mark.parametrize(
    ("slots", "on_full", "advice"),
    [
        (4, "error", ["pools: {history: 5}"]),
        (15, "block", ["pools: {history: 16}"]),
        (MOST_HISTORY, "error", ["on_full: block 100 ms"]),
        (MOST_HISTORY, "block", []),
    ],
)
def test_a_full_stream_advises_what_helps(slots: int, on_full: str, advice: list[str]) -> None:
    text = full_text(
        changed(POOL, streams__reliable_slots=slots, streams__on_full=on_full, streams__on_full_block_ms=20)
    )
    assert advised(text) == advice
    assert [hit for line in advice for hit in refused(line)] == []
    assert advice[:1] == [f"pools: {{history: {slots + 1}}}"] or "publish less often" in text


def test_the_schema_has_the_numbers_that_advice_stops_at() -> None:
    schema = json.loads(
        (components_folder().parent / "application/application.schema.json").read_text(encoding="utf-8")
    )
    assert schema["properties"]["pools"]["properties"]["history"]["maximum"] == MOST_HISTORY
    template = (components_folder() / "base/variants/error_code.h.j2").read_text(encoding="utf-8")
    most = re.search(r"MICROROS_POOL_MOST (\d+)u", template)
    assert most
    assert int(most[1]) == LARGEST_POOL
    assert schema["properties"]["pools"]["properties"]["nodes"]["maximum"] == LARGEST_POOL
    assert schema["properties"]["transport"]["properties"]["mtu"]["maximum"] == LARGEST_MTU


BASE = "version: 1\nprofiles: [pure_sender]\n"
SENDER = "nodes: [{name: device, publishers: [{topic: t, type: %s}]}]\n"
ANY = "limits: {'*': {string: 8, sequence: 2}}\n"
STRING, CLOUD, JOINTS = (
    SENDER % name + ANY
    for name in ("std_msgs/msg/String", "sensor_msgs/msg/PointCloud2", "sensor_msgs/msg/JointState")
)
JOINTS = SENDER % "sensor_msgs/msg/JointState" + ANY
GRAPH, TOPIC = (f"nodes: [{{name: device}}]\ncomponents: [+{name}]\n" for name in ("graph", "graph_topic"))
ROSOUT = "nodes: [{name: device}]\nlogging: rosout\n"
TF = "nodes: [{name: device}]\ncomponents: [+tf_broadcaster]\n"
CLIENT = "nodes: [{name: device, parameter_clients: [{node: /motor}]}]\ncomponents: [+parameter_client]\n"
PARAMETERS = "nodes: [{name: device}]\ncomponents: [+parameters]\n"
Room = Callable[[compiler.Planned], int]


def slice_room(component: str, key: str) -> Room:
    """Return what tells a number of the plan of a component."""
    return lambda found: int(getattr(found.project.runtime.features.of(component), key))


def limit_room(name: str, *members: str, kind: str = "string") -> Room:
    """Return what tells the limit of a member, which may be in nested messages."""

    def room(found: compiler.Planned) -> int:
        types = {plan.name: plan for plan in found.project.types}
        plan = next(plan for plan in found.project.types if str(plan.name) == name)
        limits = plan.limits
        for member in members:
            assert limits is not None
            index = [field.name for field in plan.message.fields].index(member)
            field, element = limits.fields[index], element_of(plan.message.fields[index].type)
            assert field is not None
            limits, size = field.nested, getattr(field, kind) or 0
            plan = types[element.name] if isinstance(element, NamedType) else plan
        return int(size)

    return room


# Error, detail as the function gives it, name, found, fits → the application file that it is from, and what has room
# for `needed` when the fragment of the text is in the file.
FOLLOWED: tuple[tuple[str, str, str, int, int, str, Room, int], ...] = (
    (
        "field",
        "data: 99",
        "std_msgs/msg/String",
        99,
        8,
        STRING,
        limit_room("std_msgs/msg/String", "data"),
        99,
    ),
    (
        *("field", "fields: {name: 40}", "sensor_msgs/msg/PointCloud2", 40, 8, CLOUD),
        *(limit_room("sensor_msgs/msg/PointCloud2", "fields", "name"), 40),
    ),
    (
        *("field_capacity", "name: {string: 70}", "sensor_msgs/msg/JointState", 70, 8, JOINTS),
        *(limit_room("sensor_msgs/msg/JointState", "name"), 70),
    ),
    (
        *("field_capacity", "header: {frame_id: 70}", "sensor_msgs/msg/JointState", 70, 8, JOINTS),
        *(limit_room("sensor_msgs/msg/JointState", "header", "frame_id"), 70),
    ),
    (
        *("field", "changed_parameters: 9", "rcl_interfaces/msg/ParameterEvent", 9, 0, PARAMETERS),
        *(limit_room("rcl_interfaces/msg/ParameterEvent", "changed_parameters", kind="sequence"), 9),
    ),
    ("graph_limits", "", "", 190, 4, GRAPH, slice_room("graph", "name_size"), 191),
    ("graph_limits", "", "", 190, 4, GRAPH, slice_room("graph", "types"), 4),
    ("graph_topic_limits", "", "", 190, 0, TOPIC, slice_room("graph", "name_size"), 191),
    ("loggers_full", "", "a", 4, 5, ROSOUT, slice_room("logging", "loggers"), 5),
    ("subloggers_full", "", "a", 4, 5, ROSOUT, slice_room("logging", "loggers"), 5),
    ("logger_name", "", "a", 0, 80, ROSOUT, slice_room("logging", "name_size"), 80),
    ("logger_name", "", "a", 0, 80, ROSOUT, slice_room("logging_rosout", "name"), 79),
    ("parameters_full", "", "gain", 4, 5, PARAMETERS, slice_room("parameters", "max"), 5),
    *(
        ("parameter_client_limit", key, "/motor", 60, 49, CLIENT, slice_room("parameter_client", part), least)
        for key, part, least in (
            ("parameters", "parameters", 60),
            ("string", "string_size", 61),
            ("elements", "elements", 60),
        )
    ),
    ("tf_full", "", "d", 4, 0, TF, slice_room("tf_broadcaster", "transforms"), 4),
    ("tf_name", "", "d", 40, 0, TF, slice_room("tf_broadcaster", "frame"), 40),
)


@pytest.mark.parametrize(
    ("error", "detail", "name", "found", "fits", "file", "room", "needed"),
    FOLLOWED,
    ids=[f"{case[0]} {case[1] or case[-1]}" for case in FOLLOWED],
)
def test_what_did_not_fit_fits_when_the_text_is_followed(
    tmp_path: Path,
    error: str,
    detail: str,
    name: str,
    found: int,
    fits: int,
    file: str,
    room: Room,
    needed: int,
) -> None:
    text = texts()[f"microros_error_{error}"]
    values = {
        "%d": detail,
        "%s": name,
        "%t": name,
        "%n": str(found),
        "%m": str(fits),
        "%y": " in microros.yaml",
    }
    for placeholder, value in values.items():
        text = text.replace(placeholder, value)
    (advice,) = advised(text)
    pasted = advice.removeprefix("set ")
    key, _, value = pasted.partition(": ")
    if key == "parameter_clients":
        pasted = file.replace("parameter_clients: [{node: /motor}]", pasted)
    elif f"{key}: " in file:
        pasted = file.replace(f"{key}: {{", f"{value[:-1]}, ".replace("{", f"{key}: {{", 1))
    else:
        pasted = file + pasted
    assert room(planned(tmp_path, BASE + file)) < needed
    assert room(planned(tmp_path, f"{BASE}{pasted}\n")) >= needed
