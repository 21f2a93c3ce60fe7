# SPDX-License-Identifier: Apache-2.0
"""`init --from` on sources that use the parameters of other nodes, or have a parameter server."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from microros_gen.application.model import ParameterClientDecl
from tests.support.migrate.proposals import Init, application_in, undecided_in

HEAD = """\
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rclc/executor.h>
"""
CLIENT = "#include <rclc_parameter/parameter_client.h>\n"
NODE = '  rclc_node_init_default(&node, "device", "arm", &support);\n'
OPEN = '  rclc_parameter_client_init_default(&motor, &node, "/motor");\n'


def proposed(
    init: Init, folder: Path, body: str, before: str = "", header: str = CLIENT
) -> tuple[ParameterClientDecl, ...]:
    """Return the clients of the application file, which `init` has planned."""
    sources = folder / "sources"
    sources.mkdir()
    (sources / "main.c").write_text(f"{HEAD}{header}{before}int main(void)\n{{\n{NODE}{body}}}\n")
    status, out, err = init("app", "--from", str(sources))
    assert status == 0, out + err
    (node,) = application_in(folder / "app/microros.yaml").nodes
    return node.parameter_clients


def words(folder: Path) -> str:
    """Return the application file without the ends of its lines."""
    lines = (folder / "app/microros.yaml").read_text().splitlines()
    return " ".join(line.strip("# ") for line in lines)


def settings(client: ParameterClientDecl) -> tuple[object, ...]:
    return (client.node, client.operations, client.parameters, client.types, client.string, client.elements)


def test_operations_types_and_limits(init: Init, tmp_path: Path) -> None:
    body = OPEN + (
        '  rclc_parameter_client_get_double(&motor, "gain", &gain, 500);\n'
        '  rclc_parameter_client_set_int_array(&motor, "steps", steps, STEPS, 500);\n'
        '  rclc_parameter_client_get_type(&motor, "gain", &type, 500);\n'
    )
    (client,) = proposed(init, tmp_path, body, "#define STEPS 6\n")
    assert settings(client) == ("/motor", ("get", "set", "get_types"), 1, ("integer[]",), 49, 6)
    assert undecided_in(tmp_path / "app/microros.yaml") == []
    text = (tmp_path / "app/microros.yaml").read_text()
    assert re.search(r'types: \["integer\[\]"\], elements: 6\} # \S*main\.c:9\n', text), text


def test_several_parameters_of_a_call(init: Init, tmp_path: Path) -> None:
    body = (
        '  rclc_parameter_client_init_default(&wheel, &node, "wheel");\n'
        "  rclc_parameter_client_get(&wheel, names, 7, 500);\n"
        "  rclc_parameter_client_value(&wheel, 0, &value);\n"
        '  printf("%s", value.as.string_value);\n'
    ) + OPEN.replace("&motor", "&other")
    wheel, other = proposed(init, tmp_path, body)
    assert settings(wheel) == ("/arm/wheel", ("get",), 7, ("string",), 49, 0)
    assert other.operations == ("get", "set"), "the default where nothing is called"


def test_what_is_not_in_the_sources(init: Init, tmp_path: Path) -> None:
    body = OPEN + (
        "  rclc_parameter_client_set_async(&motor, parameters, count_of(parameters), 500, on_set, NULL);\n"
        '  rclc_parameter_client_get_string_array(&motor, "names", names, 4, &count, 500);\n'
        "  rclc_parameter_client_watch(&motor, on_change, NULL);\n"
    )
    (client,) = proposed(init, tmp_path, body)
    assert settings(client) == ("/motor", ("get", "set", "watch"), 4, ("string[]",), 49, 8)
    assert len(undecided_in(tmp_path / "app/microros.yaml")) == 2
    assert "how many parameters a call has" in words(tmp_path)
    assert "how many elements its arrays have is not in the sources: 8 are proposed" in words(tmp_path)
    components = {c.name for c in application_in(tmp_path / "app/microros.yaml").components}
    assert {"parameter_client", "subscribe"} <= components


def test_a_name_that_is_not_known_and_a_long_text(init: Init, tmp_path: Path) -> None:
    body = (
        "  rclc_parameter_client_init_default(&motor, &node, name_of_motor());\n"
        '  rclc_parameter_client_init_default(&wheel, &node, "/wheel");\n'
        f'  rclc_parameter_client_set_string(&wheel, "label", "{"x" * 60}", 500);\n'
    )
    (wheel,) = proposed(init, tmp_path, body)
    assert settings(wheel) == ("/wheel", ("set",), 1, ("string",), 60, 0)
    assert len(undecided_in(tmp_path / "app/microros.yaml")) == 1
    assert "the other node: " in words(tmp_path)
    assert '      # - {node: "?"' in (tmp_path / "app/microros.yaml").read_text()


def test_a_client_that_is_opened_again(init: Init, tmp_path: Path) -> None:
    """An application that connects again opens its client again; a helper's client may be any of them."""
    before = (
        "static void watch(rclc_parameter_client_t * client)\n{\n"
        "  rclc_parameter_client_list(client, NULL, 0, 0, 500);\n}\n"
    )
    (client,) = proposed(init, tmp_path, OPEN + "  watch(&motor);\n" + OPEN, before)
    assert settings(client)[:3] == ("/motor", ("list",), 4)


@pytest.mark.parametrize(
    ("calls", "line"),
    [
        ("", "    # parameters: {at: agent}\n"),
        ("  rclc_parameter_check_held(&server);\n", "    parameters: {at: agent}\n"),
    ],
)
def test_parameters_that_a_server_holds(calls: str, line: str, init: Init, tmp_path: Path) -> None:
    """A server on the device can be one at the agent: a comment. What only the latter has decides it."""
    body = "  rclc_parameter_server_init_default(&server, &node);\n" + calls
    header = "#include <rclc_parameter/rclc_parameter.h>\n"
    assert proposed(init, tmp_path, body, header=header) == ()
    text = (tmp_path / "app/microros.yaml").read_text()
    assert text.count("parameters: {at: agent}") == 1
    assert line in text


SERVER = "#include <rclc_parameter/rclc_parameter.h>\n"


def proposal(init: Init, folder: Path, body: str, before: str = "") -> str:
    """Return the application file of a program with a parameter server."""
    assert proposed(init, folder, body, before, header=SERVER) == ()
    return (folder / "app/microros.yaml").read_text()


def with_options(value: str, after: str = "") -> str:
    options = f"  rclc_parameter_options_t options = {value};\n{after}"
    return f"{options}  rclc_parameter_server_init_with_option(&server, &node, &options);\n"


@pytest.mark.parametrize(
    "body",
    [
        with_options("{.notify_changed_over_dds = true, .max_params = 2 * STEPS}"),
        with_options("{true, 12, false, false}"),
        with_options("{true, 2, false, false}", "  options.max_params = 12;\n"),
        "  for (int i = 0; i < 12; ++i) {\n    rclc_add_parameter(&server, names[i], RCLC_PARAMETER_INT);\n  }\n",
        '  rclc_add_parameter(&server, "a", RCLC_PARAMETER_INT);\n' * 12,
    ],
)
def test_a_server_with_more_parameters_than_usual(body: str, init: Init, tmp_path: Path) -> None:
    text = proposal(init, tmp_path, body, "#define STEPS 6\n")
    assert re.search(r"^  parameters: 12 # rclc_\w+ \(\S*main\.c:\d+\)$", text, re.MULTILINE), text


@pytest.mark.parametrize("body", [with_options("{true, 4, false, false}"), with_options("defaults()"), ""])
def test_a_server_with_the_usual_parameters(body: str, init: Init, tmp_path: Path) -> None:
    opened = "  rclc_parameter_server_init_default(&server, &node);\n"
    added = '  rclc_add_parameter(&server, "a", RCLC_PARAMETER_INT);\n'
    text = proposal(init, tmp_path, body + opened + added)
    assert "pools:" not in text
    assert "limits:" not in text


def test_strings_and_arrays_of_a_server_get_room(init: Init, tmp_path: Path) -> None:
    body = "".join(
        f'  rclc_add_parameter(&server, "{name}", RCLC_PARAMETER_{kind});\n'
        for name, kind in (
            ("label", "STRING"),
            ("side", "STRING"),
            ("ports", "INT_ARRAY"),
            ("names", "STRING_ARRAY"),
        )
    ) + (
        '  rclc_add_parameter_constraint_string(&server, "label", 80);\n'
        '  rclc_add_parameter_constraint_array(&server, "ports", 3);\n'
    )
    text = proposal(init, tmp_path, body)
    values = "string_value: 80, integer_array_value: 3, string_array_value: {sequence: 8, string: 49}"
    assert f"  rcl_interfaces/msg/ParameterValue: {{{values}}} # rclc_add_parameter (" in text
    assert len(undecided_in(tmp_path / "app/microros.yaml")) == 1
    assert 'how many elements "names" has at most: 8 is a guess' in words(tmp_path)
