# SPDX-License-Identifier: Apache-2.0
"""What the component `parameters` plans: endpoints, places, sizes of names, texts and requests, the example."""

from __future__ import annotations

import json
import re
import subprocess
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.components.parameters.plan import ParametersPlan
from microros_gen.diagnostics import UserError
from microros_gen.interfaces.types import TypeName
from tests.support.components.rendered import planned
from tests.support.ids import without_id

BARE = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
nodes:
  - {name: arm, namespace: /left}
"""
DECLARED = """\
version: 1
profiles: [pure_sender]
nodes:
  - name: arm
    parameters:
      - {name: gain, type: double, default: 1, range: {min: 0, max: 2, step: 0.5}}
      - {name: steps, type: integer, default: -3, description: "Steps of \\"one\\" turn", read_only: true}
      - {name: on, type: bool, default: true}
  - name: leg
components: [+parameters]
"""
REASONS = Path("components/parameters/src/rclc_parameter_reason.c")
SERVICES = [
    *("describe_parameters", "get_parameter_types", "get_parameters"),
    *("list_parameters", "set_parameters", "set_parameters_atomically"),
]


def slice_of(found: compiler.Planned) -> ParametersPlan:
    part = found.project.runtime.features.of("parameters")
    assert isinstance(part, ParametersPlan)
    return part


def largest(found: compiler.Planned, name: str) -> int:
    kind, _, short = name.partition("/")
    wanted = TypeName("rcl_interfaces", kind, short)
    return next(t.max_encoded_size for t in found.project.types if t.name == wanted)


def text_size(characters: int) -> int:
    """Return what a string takes, with its length and NUL, up to the next multiple of 4."""
    return 4 + (characters + 1 + 3) // 4 * 4


def test_six_services_and_the_events_of_a_node(tmp_path: Path) -> None:
    found = planned(tmp_path, BARE)
    entities, executor = found.project.runtime.entities, found.project.runtime.executor
    assert [s.name for s in entities.services.declared] == [f"/left/arm/{name}" for name in SERVICES]
    assert [p.topic for p in entities.publishers.declared] == ["/parameter_events"]
    assert not any(m.storage for s in entities.services.declared for m in s.stored)
    assert executor.handles_max == len(SERVICES)
    assert {queue.slots for queue in found.project.runtime.input.queues} == {1}


def test_without_declared_parameters_there_is_room_as_in_rclc(tmp_path: Path) -> None:
    found = planned(tmp_path, BARE)
    part = slice_of(found)
    assert (part.max, part.name_size, part.text_size) == (4, 50, 50)
    assert part.request_size == largest(found, "srv/SetParameters_Request")
    assert largest(found, "srv/GetParameters_Request") == 4 + 3 * text_size(49) + 4 + 50
    more = slice_of(planned(tmp_path, BARE + "pools: {parameters: 9}\n"))
    assert more.max == 9
    assert more.request_size > 2 * part.request_size
    assert more.outcomes_max >= 9


def test_declared_parameters_have_places_of_their_sizes(tmp_path: Path) -> None:
    found = planned(tmp_path, DECLARED)
    part = slice_of(found)
    assert (part.max, part.name_size, part.text_size) == (3, len("steps") + 1, len('Steps of "one" turn') + 1)
    assert largest(found, "srv/GetParameters_Request") == 4 + 2 * text_size(5) + 4 + 6
    assert found.project.runtime.executor.handles_max == part.handles == 2 * len(SERVICES)
    more = slice_of(planned(tmp_path, DECLARED + "pools: {parameters: 5}\n"))
    assert (more.max, more.name_size) == (5, 50)


def test_an_event_has_room_for_every_parameter(tmp_path: Path) -> None:
    """Whatever it says of them: new, changed or deleted."""
    found = planned(tmp_path, BARE)
    value = largest(found, "srv/GetParameters_Response") // 4
    assert (
        largest(found, "msg/ParameterEvent")
        >= 4 * (text_size(49) + value) + 8 + text_size(len("/left/arm")) + 12
    )


@pytest.mark.parametrize(
    ("type_", "own"),
    [("type: integer", "integer"), ('type: "integer[]", size: 2', "integer_array"), ("type: bool", "bool")],
)
@pytest.mark.parametrize("characters", range(1, 5))
def test_a_reason_has_room_for_the_names_of_two_types(
    tmp_path: Path, type_: str, own: str, characters: int
) -> None:
    """A reply with the longest reason for each parameter would have no results if one byte was missing."""
    source = (Path(compiler.__file__).parents[1] / REASONS).read_text()
    (words,) = re.findall(r'"(Wrong parameter type[^"]*)"', source)
    names = re.findall(r'"([\w ]+)"', source.split("names[] =")[1].split("};")[0])
    assert own in names
    assert len(names) == 10  # rcl_interfaces/msg/ParameterType
    others = [name for name in names if name != own]
    name = "n" * characters
    text = f"{BARE[:-2]}, parameters: [{{name: {name}, {type_}}}]}}\n"
    longest = max(len(re.sub("%n", name, words).replace("%o", own).replace("%t", other)) for other in others)
    assert largest(planned(tmp_path, text), "msg/SetParametersResult") >= 4 + 4 + longest + 1


def test_limits_of_the_application_win(tmp_path: Path) -> None:
    limits = "limits: {rcl_interfaces/srv/SetParameters_Request: {parameters: 8}}\n"
    assert slice_of(planned(tmp_path, BARE + limits)).request_size > 800
    assert slice_of(planned(tmp_path, BARE)).request_size < 450


def test_another_number_makes_another_plan_id(tmp_path: Path) -> None:
    """`text_size` shows in no message: only in the struct that the application has."""
    texts = (BARE, BARE + "pools: {parameters: 5}\n", DECLARED, DECLARED.replace("turn", "full turn"))
    assert len({planned(tmp_path, text).project.runtime.plan_id for text in texts}) == len(texts)


def declaring(found: compiler.Planned) -> str:
    """Return the C that declares the parameters."""
    return compiler.render(found)["src/parameters/rclc_parameter_declared.c"].decode()


def test_only_declared_parameters_bring_the_files_for_them(tmp_path: Path) -> None:
    files = {"src/parameters/rclc_parameter_" + name for name in ("declare.c", "declared.c")}
    assert compiler.render(planned(tmp_path, DECLARED)).keys() >= files
    assert not compiler.render(planned(tmp_path, BARE)).keys() & files


def test_the_example_declares_and_uses_the_parameters(tmp_path: Path) -> None:
    """Of each node that declares any, in the server of that node."""
    text = DECLARED.replace("  - name: arm\n", "  - name: none\n  - name: arm\n    namespace: /left\n")
    example = compiler.render(planned(tmp_path, text))["examples/pure_sender/main.c"].decode()
    for line in (
        "static left_arm_parameters_t left_arm_values;",
        "&node_2_parameters, &node_2);",
        "left_arm_parameters_declare(&node_1_parameters)",
        "left_arm_parameters_update(&left_arm_values, &node_1_parameters)",
    ):
        assert line in example
    assert example.count("_declare(") == 1


def test_members_are_names_of_c(tmp_path: Path) -> None:
    declared = "".join(
        f"      - {{name: {name}, type: bool}}\n" for name in ("int", "a.b", "a_b", "changed", "a_b_2")
    )
    found = planned(
        tmp_path, BARE.partition("nodes:")[0] + f"nodes:\n  - name: arm\n    parameters:\n{declared}"
    )
    assert slice_of(found).servers[0].members == (
        *("bool int_;", "bool a_b;", "bool a_b_2;", "bool changed_2;", "bool a_b_2_2;"),
    )


def test_what_is_declared_is_constant(tmp_path: Path) -> None:
    found = planned(tmp_path, DECLARED)
    declarations = declaring(found)
    for line in (
        "static const rclc_parameter_range_t arm_range_0 = {.floating_point = {0.0, 2.0, 0.5}};",
        "static const rclc_parameter_declared_t arm_declared[] = {",
        '{.about = {.name = "gain", .range = &arm_range_0}, .type = RCLC_PARAMETER_DOUBLE, .has_value = true, '
        ".value = {.double_value = 1.0}},",
        r'{.about = {.name = "steps", .texts = "Steps of \"one\" turn\0" ""}, .type = RCLC_PARAMETER_INT, '
        ".has_value = true, .value = {.integer_value = -3}, .read_only = true},",
        '{.about = {.name = "on"}, .type = RCLC_PARAMETER_BOOL, .has_value = true, .value = {.bool_value = true}},',
        "parameter_server->floating_point_holds = rclc_parameter_floating_point_holds;",
    ):
        assert line in declarations


EVERY = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
nodes:
  - name: arm
    parameters:
      - {name: side, type: string, default: left, one_of: [left, right]}
      - {name: mode, type: integer, one_of: [0, -9223372036854775808], unit: mm, description: Way}
      - {name: bytes, type: "byte[]", size: 5, default: [1, 255]}
      - {name: names, type: "string[]", size: 3, default: [a, "ö"]}
      - {name: none, type: "double[]", size: 2, default: []}
"""


def test_arrays_and_lists_of_values_take_what_is_declared(tmp_path: Path) -> None:
    found = planned(tmp_path, EVERY)
    part = slice_of(found)
    assert (part.array_size, part.strings_max, part.array_string_size) == (3 * 50, 3, 50)
    assert part.text_size == len("one of: 0, -9223372036854775808") + 1
    declarations = declaring(found)
    for line in (
        "static const char * const arm_values_0[] = {",
        "static const int64_t arm_values_1[] = {0, INT64_MIN};",
        '.name = "side", .texts = "\\0" "one of: left, right", .one_of = arm_values_0, .one_of_count = 2u, ',
        '.name = "mode", .texts = "Way [mm]\\0" "one of: 0, -9223372036854775808", .one_of = arm_values_1, ',
        "static const uint8_t arm_start_2[] = {1u, 255u};",
        '.name = "bytes", .array_most = 5u}, .type = RCLC_PARAMETER_BYTE_ARRAY, .has_value = true, '
        ".start = arm_start_2, .start_bytes = (uint32_t)sizeof(arm_start_2), .start_count = 2u}",
        'static const char arm_start_3[] = "a\\0" "\\303\\266";',
        '{.about = {.name = "none", .array_most = 2u}, .type = RCLC_PARAMETER_DOUBLE_ARRAY},',
    ):
        assert line in declarations
    limits = "limits: {rcl_interfaces/msg/ParameterValue: {string_array_value: {sequence: 3, string: 9}}}\n"
    assert slice_of(planned(tmp_path, EVERY + limits)).array_size == 3 * 10
    plain = slice_of(planned(tmp_path, DECLARED))
    assert "floating_point_holds" not in declarations
    assert (plain.array_size, plain.strings_max, plain.one_of) == (0, 0, False)


@pytest.mark.parametrize(
    ("parameter", "limit", "message", "hint"),
    [
        (
            "{name: p, type: string, size: 20, default: fifteen letters}",
            "string_value: {string: 10}",
            "the default of the parameter 'p' has a text of 15 bytes, and the limit of string_value is 10",
            "string_value: {string: 20}",
        ),
        (
            '{name: p, type: "string[]", size: 3, default: [a, fifteen letters]}',
            "string_array_value: {sequence: 3, string: 9}",
            "the default of the parameter 'p' has a text of 15 bytes, and the limit of string_array_value is 9",
            "string_array_value: {string: 15}",
        ),
        (
            '{name: p, type: "integer[]", size: 3, default: [1, 2, 3]}',
            "integer_array_value: 2",
            "the default of the parameter 'p' has 3 elements, and the limit of integer_array_value is 2",
            "integer_array_value: {sequence: 3}",
        ),
    ],
)
def test_a_default_above_a_limit(tmp_path: Path, parameter: str, limit: str, message: str, hint: str) -> None:
    text = EVERY.split("    parameters:")[0] + f"    parameters: [{parameter}]\n"
    with pytest.raises(UserError) as error:
        planned(tmp_path, f"{text}limits: {{rcl_interfaces/msg/ParameterValue: {{{limit}}}}}\n")
    [found] = error.value.diagnostics
    assert (found.message, found.id) == (message, "MG-3098")
    assert found.hint == f"Raise it: `limits: {{rcl_interfaces/msg/ParameterValue: {{{hint}}}}}`"


@pytest.mark.parametrize(
    ("parameter", "limit", "message", "hint"),
    [
        (
            "{name: p, type: string, size: 20}",
            "string_value: 3",
            "the size of the parameter 'p' is 20, and the limit of string_value is 3",
            "size: 3",
        ),
        (
            '{name: p, type: "double[]", size: 5, default: [1.0]}',
            "double_array_value: 4",
            "the size of the parameter 'p' is 5, and the limit of double_array_value is 4",
            "size: 4",
        ),
        (
            '{name: p, type: "string[]", size: 5}',
            "string_array_value: {sequence: 2, string: 9}",
            "the size of the parameter 'p' is 5, and the limit of string_array_value is 2",
            "size: 2",
        ),
    ],
)
def test_a_size_above_a_limit(tmp_path: Path, parameter: str, limit: str, message: str, hint: str) -> None:
    """It would promise room that the server does not have; the size of the hint is one that is accepted."""
    text = EVERY.split("    parameters:")[0] + f"    parameters: [{parameter}]\n"
    limits = f"limits: {{rcl_interfaces/msg/ParameterValue: {{{limit}}}}}\n"
    with pytest.raises(UserError) as error:
        planned(tmp_path, text + limits)
    [found] = error.value.diagnostics
    assert (found.message, found.id) == (message, "MG-9852")
    own, separator, raised = str(found.hint).partition(", or ")
    assert (own, separator) == (f"Write {hint}", ", or ")
    assert planned(tmp_path, text + raised.strip("`") + "\n").project
    assert planned(tmp_path, re.sub("size: [0-9]+", hint, text) + limits).project


LABELED = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
nodes:
  - name: arm
    parameters:
      - {name: label, type: string, default: "left \\"a\\"", size: 12}
      - {name: comment, type: string}
"""


def test_strings_take_what_is_declared(tmp_path: Path) -> None:
    found = planned(tmp_path, LABELED)
    assert slice_of(found).string_size == 49 + 1  # without a size, as names and descriptions
    declarations = declaring(found)
    for line in (
        r'static const char arm_start_0[] = "left \"a\"";',
        '{.about = {.name = "label", .string_most = 12u}, .type = RCLC_PARAMETER_STRING, .has_value = true, ',
        '{.about = {.name = "comment", .string_most = 49u}, .type = RCLC_PARAMETER_STRING},',
    ):
        assert line in declarations
    first = largest(found, "srv/SetParameters_Request")
    own = "limits: {rcl_interfaces/msg/ParameterValue: {string_value: 100}}\n"
    more = planned(tmp_path, LABELED + own)
    assert slice_of(more).string_size == 100 + 1
    assert largest(more, "srv/SetParameters_Request") > first + 2 * 48


def test_texts_reach_the_image_as_they_are_written(tmp_path: Path) -> None:
    """The C compiler reads them back: trigraphs, controls, a digit after an escape, and other than ASCII."""
    text = "what??! ??/ \x01" + '2 \x7f "é" \\n \t'
    declared = f"{{name: label, type: string, default: {json.dumps(text)}}}"
    servers = slice_of(planned(tmp_path, BARE.replace("left", f"left, parameters: [{declared}]"))).servers
    (table,) = servers[0].tables
    source, program = tmp_path / "texts.c", tmp_path / "texts"
    source.write_text(
        f"#include <stdio.h>\n{table}\nint main(void) {{ return puts(left_arm_start_0) < 0; }}\n"
    )
    subprocess.run(["gcc", "-std=c99", "-Wall", "-Wextra", "-Werror", source, "-o", program], check=True)
    assert subprocess.run([program], check=True, capture_output=True).stdout.decode() == f"{text}\n"


def test_free_places_take_what_is_declared_and_what_rclc_takes(tmp_path: Path) -> None:
    """A declared name and text above those of rclc still fit in the messages, as without free places."""
    parameter = f"{{name: {'n' * 60}, type: bool, description: {'d' * 70}}}"
    declared = BARE.replace("left", f"left, parameters: [{parameter}]")
    for places in (1, 2):
        found = planned(tmp_path, f"{declared}pools: {{parameters: {places}}}\n")
        assert (slice_of(found).name_size, slice_of(found).text_size) == (61, 71)
        descriptor = text_size(60) + 4 + 2 * text_size(70)
        assert largest(found, "srv/DescribeParameters_Response") > places * descriptor
    short = planned(tmp_path, BARE.replace("left", "left, parameters: [{name: a, type: bool}]"))
    free = planned(
        tmp_path,
        BARE.replace("left", "left, parameters: [{name: a, type: bool}]") + "pools: {parameters: 2}\n",
    )
    assert [slice_of(found).name_size for found in (short, free)] == [2, 50]


def test_a_file_that_says_nothing_of_entities_has_one_node(tmp_path: Path) -> None:
    """As the profile has without a file."""
    found = planned(tmp_path, BARE.partition("nodes:")[0])
    services = found.project.runtime.entities.services.declared
    assert [s.name for s in services] == [f"/device/{name}" for name in SERVICES]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            BARE + 'endpoints: {"~/get_parameters": {limits: {names: {sequence: 9, string: 9}}}}\n',
            "error: the limits of '~/get_parameters' cannot differ from those of its type",
        ),
        (
            BARE.partition("nodes:")[0] + "interfaces: [std_msgs/msg/Int32]\n",
            "error: the service '~/describe_parameters' (and 6 more), which a component opens by itself, "
            "needs a declared node",
        ),
    ],
    ids=["limits of one", "no node"],
)
def test_what_cannot_be_served_is_refused(tmp_path: Path, text: str, expected: str) -> None:
    with pytest.raises(UserError) as caught:
        planned(tmp_path, text)
    assert any(expected in without_id(d.headline()) for d in caught.value.diagnostics)


@pytest.mark.parametrize(
    ("pools", "expected"),
    [
        ("parameters: 1", ("'pools.parameters' is 1, and a node declares 3 parameters", "MG-7049")),
        ("parameters: 2", ("'pools.parameters' is 2, and a node declares 3 parameters", "MG-7049")),
        (
            "handles: 2",
            ("'pools.handles' is 2, and a parameter server needs 6 handles of its executor", "MG-7050"),
        ),
        (
            "handles: 5",
            ("'pools.handles' is 5, and a parameter server needs 6 handles of its executor", "MG-7050"),
        ),
    ],
)
def test_a_pool_below_what_is_declared_is_refused(
    tmp_path: Path, pools: str, expected: tuple[str, str]
) -> None:
    with pytest.raises(UserError) as caught:
        planned(tmp_path, DECLARED + f"pools: {{{pools}}}\n")
    [found] = caught.value.diagnostics
    assert (found.message, found.id) == expected
    assert found.span is not None
    assert found.hint


@pytest.mark.parametrize("pools", ["parameters: 3", "handles: 6", "parameters: 3, handles: 20"])
def test_a_pool_that_is_large_enough_is_accepted(tmp_path: Path, pools: str) -> None:
    assert slice_of(planned(tmp_path, DECLARED + f"pools: {{{pools}}}\n")).max == 3
