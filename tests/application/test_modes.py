# SPDX-License-Identifier: Apache-2.0
"""Modes of a node in the application file: what they inherit, and each mistake with its place and a hint."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.application.mode_decl import DEFAULT_MODE
from microros_gen.application.model import NodeDecl
from microros_gen.application.modes import set_parameters, start_value, value_in
from microros_gen.application.parameter_find import with_parameter_files
from microros_gen.application.parser import parse_application
from microros_gen.diagnostics import Diagnostics, Source, UserError

TEXT = """\
version: 1
profiles: [managed_service]
components: [+node_modes]
nodes:
  - name: device
    parameters:
      - {name: speed, type: double, default: 0.5, range: {min: 0.0, max: 2.0, step: 0.5}}
      - {name: gains.p, type: integer, default: 3}
      - {name: label, type: string, default: calm, one_of: [calm, wild]}
      - {name: name, type: string}
      - {name: path, type: "byte[]", size: 2}
      - {name: serial, type: integer, default: 7, read_only: true}
      - {name: limit, type: double}
      - {name: on, type: bool}
    modes:
      __DEFAULT__: {limit: $(parent limit)}
      SLOW: {speed: 0, gains: {p: 1}}
      FAST: {label: wild, path: [3, 255], name: quick}
"""


def nodes_of(text: str, folder: Path = Path()) -> tuple[tuple[NodeDecl, ...], list[str]]:
    """Return the nodes, and what is reported of the text."""
    found = Diagnostics()
    application = parse_application(Source("microros.yaml", text), found)
    if application is None:
        return (), [diagnostic.render() for diagnostic in found]
    nodes = with_parameter_files(application, folder, found)[0].nodes
    return nodes, [diagnostic.render() for diagnostic in found]


def test_a_mode_inherits_what_it_leaves_out() -> None:
    """From `__DEFAULT__`, else from the declaration. A template there is inherited as well."""
    (node,), reported = nodes_of(TEXT)
    assert reported == []
    assert [mode.name for mode in node.modes] == [DEFAULT_MODE, "SLOW", "FAST"]
    assert [p.name for p in set_parameters(node)] == ["speed", "gains.p", "label", "name", "path", "limit"]
    values = {}
    for mode in node.modes:
        written = {p.name: (value_in(node, mode, p), start_value(p)) for p in set_parameters(node)}
        values[mode.name] = [(v.value, v.parent) if v else (start, "") for v, start in written.values()]
    shared = [("calm", ""), ("", ""), ((), ""), (None, "limit")]
    assert values == {
        DEFAULT_MODE: [(0.5, ""), (3, ""), *shared],
        "SLOW": [(0, ""), (1, ""), *shared],
        "FAST": [(0.5, ""), (3, ""), ("wild", ""), ("quick", ""), ((3, 255), ""), (None, "limit")],
    }


def test_the_default_mode_is_there_without_being_written() -> None:
    (node,), reported = nodes_of(TEXT.replace("      __DEFAULT__: {limit: $(parent limit)}\n", ""))
    assert reported == []
    assert [mode.name for mode in node.modes] == [DEFAULT_MODE, "SLOW", "FAST"]
    assert node.modes[0].values == ()


def test_the_default_mode_is_the_first() -> None:
    late = "      __DEFAULT__: {limit: $(parent limit)}\n"
    (node,), reported = nodes_of(TEXT.replace(late, "") + late)
    assert reported == []
    assert [mode.name for mode in node.modes] == [DEFAULT_MODE, "SLOW", "FAST"]


def test_values_follow_the_validation_of_a_parameter_file(tmp_path: Path) -> None:
    validation = "{unique<>: [], element_bounds<>: [0, 9]}"
    ids = f"  ids: {{type: int_array_fixed_2, default_value: [1, 2], validation: {validation}}}"
    (tmp_path / "p.yaml").write_text(f"device:\n{ids}\n")
    start = TEXT.index("    parameters:")
    text = TEXT[:start] + "    parameters: {file: p.yaml}\n    modes: {A: {ids: [3, 3]}, B: {ids: [1, 20]}}\n"
    _, reported = nodes_of(text, tmp_path)
    assert [line.partition("validation. ")[2] for line in reported[0].splitlines()[:1]] == [
        "Write [3]: Parameter 'ids' must only contain unique values [MG-3077]"
    ]
    assert "Write [1, 9]: Value '20' in parameter 'ids' must be within bounds '[0, 9]'" in reported[1]
    assert len(reported) == 2


MISTAKES = {
    "unknown": ("speed: 0,", "sped: 0,", "MG-3104", "sped", "Did you mean 'speed'?"),
    "unknown, nothing near": (
        "speed: 0,",
        "shade: 0,",
        "MG-3104",
        "shade",
        "Declare it below `parameters:`",
    ),
    "unknown in a group": ("{p: 1}", "{q: 1}", "MG-3104", "q", "Did you mean 'gains.p'?"),
    "type": ("speed: 0,", "speed: fast,", "MG-3005", "fast", "Write a number such as 1, or type: string"),
    "type of a bool": ("speed: 0,", "on: 1,", "MG-3005", "1", "Write true or false"),
    "scalar of an array": ("[3, 255]", "3", "MG-3005", "3", "Write a list of values of type byte"),
    "element": ("[3, 255]", "[3, 256]", "MG-3005", "[3, 256]", "Write a list of values of type byte"),
    "not finite": ("speed: 0,", "limit: .inf,", "MG-3063", ".inf", "Set it in the program"),
    "range": ("speed: 0,", "speed: 2.5,", "MG-3006", "2.5", "Write 2.0: it goes from 0.0 to 2.0"),
    "step": ("speed: 0,", "speed: 0.7,", "MG-3062", "0.7", "Write 0.5: its values are 0.5 apart, from 0.0"),
    "one of": ("label: wild", "label: mild", "MG-3056", "mild", "Available: calm, wild"),
    "size": ("[3, 255]", "[3, 2, 1]", "MG-3007", "[3, 2, 1]", "Set size: 3"),
    "read-only": ("speed: 0,", "serial: 7,", "MG-3105", "serial", "Remove it from the modes, or `read_only`"),
    "default": (
        "limit: $(parent limit)",
        "gains: {p: 4}",
        "MG-3106",
        "4",
        "Write this value as its `default`",
    ),
    "no value": ("{p: 1}", "{p: }", "MG-3102", "", "Write a value, or remove it"),
    "twice": ("gains: {p: 1}", "gains.p: 1, gains: {p: 2}", "MG-3011", "p", "Remove it"),
    "name of a mode": ("SLOW:", "SLOW-1:", "MG-1002", "SLOW-1", ""),
    "a list": ("{label: wild, path: [3, 255], name: quick}", "[label]", "MG-1005", "[label]", ""),
}
"""What is replaced, by what; the id, the text that is marked, words of the hint."""


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_shown_at_its_place(mistake: str) -> None:
    old, new, identifier, marked, hint = MISTAKES[mistake]
    assert TEXT.count(old) == 1
    text = TEXT.replace(old, new)
    _, reported = nodes_of(text)
    assert len(reported) == 1, reported
    headline, line, carets = reported[0].splitlines()
    place, _, message = headline.partition(": error: ")
    _, row, column = place.split(":")
    assert identifier in message
    assert hint in message
    assert line.strip() == text.splitlines()[int(row) - 1].strip()
    assert text.splitlines()[int(row) - 1][int(column) - 1 :].startswith(marked)
    assert carets.strip() == "^" + "~" * (len(marked) - 1) if marked else carets.strip().startswith("^")


def test_all_mistakes_are_shown_at_once() -> None:
    """In the order of the text."""
    _, reported = nodes_of(
        TEXT.replace("speed: 0,", "speed: 9, sped: 1, serial: 1,").replace("wild, p", "mild, p")
    )
    found = [text.splitlines()[0].rpartition("[")[2] for text in reported]
    assert found == ["MG-3006]", "MG-3104]", "MG-3105]", "MG-3056]"]


def test_modes_without_parameters() -> None:
    _, reported = nodes_of("version: 1\nnodes: [{name: n, modes: {SLOW: {}}}]\n")
    assert len(reported) == 1
    assert "2:26: error: the modes of 'n' set no parameter" in reported[0]


def test_too_many_modes() -> None:
    modes = ", ".join(f"M{i}: {{}}" for i in range(251))
    _, reported = nodes_of(
        f"nodes: [{{name: n, parameters: [{{name: a, type: bool}}], modes: {{A: {{a: true}}, {modes}}}}}]\n"
    )
    assert len(reported) == 1
    assert "a node has 252 modes, 250 at most" in reported[0]


PARAMETER_FILE = """\
device:
  speed: {type: double, default_value: 0.5, validation: {bounds<>: [0.0, 1.0]}}
"""


@pytest.mark.parametrize(("speed", "is_right"), [("0.75", True), ("1.5", False)])
def test_parameters_of_a_file_count(tmp_path: Path, speed: str, is_right: bool) -> None:
    """Those of generate_parameter_library, which are read after the application file."""
    (tmp_path / "device.yaml").write_text(PARAMETER_FILE, encoding="utf-8")
    text = f"nodes: [{{name: n, parameters: {{file: device.yaml}}, modes: {{SLOW: {{speed: {speed}}}}}}}]\n"
    (node,), reported = nodes_of(text, tmp_path)
    assert [p.name for p in node.parameters] == ["speed"]
    assert len(reported) == (0 if is_right else 1)
    assert is_right or "1:74: error: the value of the parameter 'speed' is not in its range" in reported[0]


def test_a_file_that_cannot_be_read_is_the_only_mistake(tmp_path: Path) -> None:
    text = "nodes: [{name: n, parameters: {file: none.yaml}, modes: {SLOW: {speed: 1.0}}}]\n"
    _, reported = nodes_of(text, tmp_path)
    assert len(reported) == 1
    assert "cannot read the parameter file" in reported[0]


def built(tmp_path: Path, text: str) -> str:
    """Return what `generate` reports of an application."""
    (tmp_path / "microros.yaml").write_text(text, encoding="utf-8")
    with pytest.raises(UserError) as raised:
        compiler.generate(compiler.Options(config=tmp_path / "microros.yaml"), tmp_path / "out")
    return "\n".join(d.render() for d in raised.value.diagnostics)


def test_modes_select_their_component(tmp_path: Path) -> None:
    """The component brings parameters and life cycle along."""
    files = []
    for name, text in (("by_key", TEXT.replace("components: [+node_modes]\n", "")), ("by_name", TEXT)):
        config = tmp_path / f"{name}.yaml"
        config.write_text(text, encoding="utf-8")
        compiler.generate(compiler.Options(config=config), tmp_path / name)
        files.append({p.relative_to(tmp_path / name) for p in (tmp_path / name / "src").rglob("*.c")})
    assert files[0] == files[1]
    assert any(path.parts[1] == "node_modes" for path in files[0])


def test_modes_and_a_dropped_component_contradict(tmp_path: Path) -> None:
    reported = built(tmp_path, TEXT.replace("+node_modes", "-node_modes"))
    assert "MG-4034" in reported
    assert "'-node_modes' drops a component that is selected by modes: of a node" in reported
    assert "Change `modes:`, or remove '-node_modes'" in reported


def test_the_component_needs_modes(tmp_path: Path) -> None:
    reported = built(tmp_path, TEXT.partition("    modes:")[0])
    assert "3:1: error: the component 'node_modes' is for nodes with modes, and no node has any" in reported
    assert "MG-7091" in reported


def test_a_text_longer_than_its_storage(tmp_path: Path) -> None:
    """A text parameter without `size` has 49 bytes."""
    reported = built(tmp_path, TEXT.replace("name: quick", f"name: {'q' * 50}"))
    assert "MG-7092" in reported
    assert "Write size: 50 at the parameter" in reported


def test_a_value_longer_than_the_limits_of_the_application(tmp_path: Path) -> None:
    limits = "limits: {rcl_interfaces/msg/ParameterValue: {string_value: {string: 4}}}\n"
    reported = built(tmp_path, TEXT + limits)
    assert (
        "the value of the parameter 'name' has a text of 5 bytes, and the limit of string_value is 4"
        in reported
    )
