# SPDX-License-Identifier: Apache-2.0
"""Files of generate_parameter_library: what they declare, and what a device does not check."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Any

import pytest

from microros_gen import compiler
from microros_gen.application.model import ParameterDecl
from microros_gen.application.parameter_file import parse_parameter_file
from microros_gen.diagnostics import Diagnostics, Source, UserError
from microros_gen.output.tree import MANIFEST
from tests.support.ids import without_id

LARGEST = sys.float_info.max
GOOD = """\
motor:
  gains:
    p: {type: double, default_value: 1.5, description: "Part: p", validation: {bounds<>: [0.0, 10.0]}}
    i: {type: double, default_value: 0, validation: {gt_eq<>: [0.0]}}
    d: {type: double, default_value: 0.0, validation: {lt_eq<>: [5]}}
  steps: {type: int, default_value: 3, read_only: true, validation: {gt<>: [0], lt<>: [9], lower_bounds<>: [2]}}
  mode: {type: string, default_value: slow, validation: {one_of<>: [["slow", "fast"]]}}
  label: {type: string_fixed_8, default_value: "left"}
  name: {type: string, default_value: a, validation: {size_lt<>: [6]}}
  on: {type: bool, default_value: false}
  ports: {type: int_array_fixed_4, default_value: [1, 2], validation: {size_lt<>: [4]}}
  flags: {type: bool_array, default_value: [], validation: {size_lt<>: [3]}}
  scales: {type: double_array_fixed_2, default_value: [1.0, 2.5]}
  joints: {type: string_array_fixed_2, default_value: ["a", "b"]}
  filters: {type: none, description: Declared by another program}
"""


def parsed(text: str) -> tuple[tuple[ParameterDecl, ...], list[str]]:
    diagnostics = Diagnostics()
    found = parse_parameter_file(Source("p.yaml", text), diagnostics)
    return found, [without_id(d.headline()) for d in diagnostics]


def test_everything_that_a_device_has() -> None:
    found, faults = parsed(GOOD)
    assert faults == []
    shown: dict[str, tuple[Any, ...]] = {
        p.name: (p.type, p.default, p.minimum, p.maximum, p.one_of, p.size) for p in found
    }
    assert shown == {
        "gains.p": ("double", 1.5, 0.0, 10.0, (), None),
        "gains.i": ("double", 0, 0.0, LARGEST, (), None),
        "gains.d": ("double", 0.0, -LARGEST, 5, (), None),
        "steps": ("integer", 3, 2, 8, (), None),
        "mode": ("string", "slow", None, None, ("slow", "fast"), None),
        "label": ("string", "left", None, None, (), 8),
        "name": ("string", "a", None, None, (), 5),
        "on": ("bool", False, None, None, (), None),
        "ports": ("integer[]", (1, 2), None, None, (), 3),
        "flags": ("bool[]", (), None, None, (), 2),
        "scales": ("double[]", (1.0, 2.5), None, None, (), 2),
        "joints": ("string[]", ("a", "b"), None, None, (), 2),
    }
    assert [p.name for p in found if p.read_only] == ["steps"]
    assert found[0].description == "Part: p"


def test_constraints_in_words_are_shown_with_those_that_are_checked(tmp_path: Path) -> None:
    """As the library passes them on: in the descriptor, where nobody checks them."""
    rule = "validation: {one_of<>: [[1, 2]]}"
    (tmp_path / "config").mkdir()
    (tmp_path / "config/motor.yaml").write_text(
        "a:\n"
        "  x: {type: int, default_value: 1, additional_constraints: not while it turns}\n"
        f"  y: {{type: int, default_value: 1, {rule}, additional_constraints: odd}}\n"
        f"  z: {{type: int, default_value: 1, {rule}}}\n"
    )
    declared = compiler.render(planned(tmp_path))["src/parameters/rclc_parameter_declared.c"].decode()
    texts = re.findall(r'"(x|y|z)", \.texts = "\\0" "([^"]*)"', declared)
    assert texts == [("x", "not while it turns"), ("y", "one of: 1, 2; odd"), ("z", "one of: 1, 2")]


FAULTS = {
    "nothing": ("", "p.yaml:1:1: error: a file of generate_parameter_library has one key"),
    "infinite bounds": (
        "a:\n  x: {type: double, default_value: 1.0, validation: {bounds<>: [-.inf, 2]}}\n",
        "p.yaml:2:53: error: the range of the parameter 'x' has a number that is not finite. Write finite numbers",
    ),
    "constraints that are no text": (
        "a:\n  x: {type: int, default_value: 1, additional_constraints: [odd]}\n",
        "p.yaml:2:60: error: this value must be a text: 'additional_constraints'. Put it into quotes",
    ),
    "a list": ("- 1\n", "p.yaml:1:1: error: a file of generate_parameter_library has one key"),
    "two roots": (
        "a: {}\nb: {}\n",
        "p.yaml:2:1: error: a file of generate_parameter_library has one key, with the parameters below it. "
        "Move `b:` to the parameter file of another node",
    ),
    "parameters without a root": (
        "x: {type: int, default_value: 1}\ny: {type: int, default_value: 1}\n",
        "p.yaml:1:1: error: a file of generate_parameter_library has one key, with the parameters below it. "
        "Write `motor:` above them, and indent them",
    ),
    "YAML without an end": (
        "a:\n  x: {type: int\n",
        "p.yaml:2:6: error: not valid YAML: a mapping in { } is not closed",
    ),
    "a tab": ("a:\n\tx: {type: int}\n", "p.yaml:2:1: error: "),
    "a default without a type": (
        "a:\n  x: {default_value: [1, 2]}\n",
        "p.yaml:2:3: error: 'x' has no type. Add `type: int_array_fixed_2`",
    ),
    "values of a node's parameter file": (
        "a:\n  ros__parameters: {x: fast}\n",
        "p.yaml:2:21: error: 'ros__parameters.x' has no type. Write x: {type: string, default_value: \"fast\"}",
    ),
    "an array of another program": (
        "a:\n  x: {type: 'float64[]', default_value: [1.0]}\n",
        "p.yaml:2:13: error: the type 'float64[]' of 'x' is not supported. Write type: double_array_fixed_8",
    ),
    "the key of an application file": (
        "a:\n  x: {type: int, default: 1}\n",
        "p.yaml:2:18: error: 'default' of a parameter is not supported. Did you mean 'default_value'?",
    ),
    "no room for any element": (
        "a:\n  x: {type: int_array_fixed_0, default_value: []}\n",
        "p.yaml:2:3: error: the array 'x' has no largest size. Write type: int_array_fixed_8, or validation",
    ),
    "default longer than its type": (
        "a:\n  x: {type: int_array_fixed_1, default_value: [1, 2]}\n",
        "p.yaml:2:47: error: the default of the parameter 'x' is longer than its size. Write type: int_array_fixed_2",
    ),
    "default longer than its rule": (
        "a:\n  x: {type: string, default_value: abc, validation: {size_lt<>: [3]}}\n",
        "p.yaml:2:36: error: the default of the parameter 'x' is longer than its size. Write size_lt<>: [4]",
    ),
    "default that is a list": (
        "a:\n  x: {type: int, default_value: [1, 2]}\n",
        "p.yaml:2:33: error: the default of the parameter 'x' is not of type integer. "
        "Write type: int_array_fixed_2, or a single value",
    ),
    "rules that exclude each other": (
        "a:\n  x: {type: int, default_value: 3, validation: {gt<>: [5], lt<>: [2]}}\n",
        "p.yaml:2:48: error: the range of the parameter 'x' is empty: min is above max. Write bounds<>: [1, 6], or "
        "remove one of the rules",
    ),
    "a rule that is misspelled": (
        "a:\n  x: {type: int, default_value: 3, validation: {bound<>: [0, 5]}}\n",
        "p.yaml:2:49: error: a device does not check 'bound<>'. Did you mean 'bounds<>'?",
    ),
    "a string for nothing": (
        "a:\n  x: {type: string_fixed_0, default_value: ''}\n",
        "p.yaml:2:3: error: the string 'x' has a size of 0: it holds nothing. Write type: string_fixed_8",
    ),
    "a name with a dash": (
        "a:\n  x-y: {type: int, default_value: 3}\n",
        "p.yaml:2:3: error: 'x-y' is no name of a parameter. Write x_y: letters, digits and underscores",
    ),
    "mapped without a group": (
        "a:\n  __map_joints: {type: int, default_value: 1}\n",
        "p.yaml:2:3: error: '__map_joints' is no name of a parameter. Write joints: letters, digits and underscores",
    ),
    "mapped by nothing": (
        "a:\n  joints: {type: int, default_value: 1}\n  b:\n    __map_joints: {x: {type: int, default_value: 1}}\n",
        "p.yaml:4:5: error: '__map_joints' names no list of texts. Declare joints: {type: string_array",
    ),
    "mapped by what is no name": (
        'a:\n  j: {type: string_array, default_value: ["b c"]}\n  __map_j: {x: {type: int, default_value: 1}}\n',
        "p.yaml:2:43: error: 'b c' is no part of a name. Write b_c: letters, digits and underscores",
    ),
    "mapped, wrong for each": (
        "a:\n  j: {type: string_array, default_value: [b, c]}\n  __map_j: {x: {type: float}}\n",
        "p.yaml:3:23: error: the type 'float' of 'b.x' is not supported",
    ),
    "no type": ("a:\n  x: 3\n", "p.yaml:2:3: error: 'x' has no type. Write x: {type: int, default_value: 3}"),
    "unknown type": (
        "a:\n  x: {type: float, default_value: 1.0}\n",
        "p.yaml:2:13: error: the type 'float' of 'x' is not supported. Write type: double",
    ),
    "a type that is nothing": (
        "a:\n  x: {type: color, default_value: 1.0}\n",
        "p.yaml:2:13: error: the type 'color' of 'x' is not supported. Available: bool, int, double",
    ),
    "no default": (
        "a:\n  x: {type: int}\n",
        "p.yaml:2:3: error: 'x' has no default_value, and nothing sets parameters when a device starts. "
        "Add `default_value: 0`",
    ),
    "array without an end": (
        "a:\n  x: {type: int_array, default_value: [1]}\n",
        "p.yaml:2:3: error: the array 'x' has no largest size. Write type: int_array_fixed_8, or validation",
    ),
    "unknown key": (
        "a:\n  x: {type: int, default_value: 1, unit: mm}\n",
        "p.yaml:2:36: error: 'unit' of a parameter is not supported. Remove it; available: type, default_value",
    ),
    "a rule that is not checked": (
        "a:\n  x: {type: string, default_value: a, validation: {ends_with<>: [b]}}\n",
        "p.yaml:2:52: error: a device does not check 'ends_with<>'. Check it in the callback of "
        "rclc_executor_add_parameter_server; available: bounds<>",
    ),
    "a rule without its brackets": (
        "a:\n  x: {type: string, default_value: a, validation: {not_empty: []}}\n",
        "p.yaml:2:52: error: a device does not check 'not_empty'. Write not_empty<>",
    ),
    "a rule of another program": (
        'a:\n  x: {type: int, default_value: 1, validation: {"own::even": []}}\n',
        "p.yaml:2:49: error: a device does not check 'own::even'",
    ),
    "default at an end that is not accepted": (
        "a:\n  x: {type: double, default_value: 1, validation: {gt<>: [1]}}\n",
        "p.yaml:2:36: error: the default of the parameter 'x' is not in its range. Write a number above 1",
    ),
    "default below the only end": (
        "a:\n  x: {type: int, default_value: 1, validation: {gt_eq<>: [2]}}\n",
        "p.yaml:2:33: error: the default of the parameter 'x' is not in its range. Write a number from 2 on",
    ),
    "bounds of a text": (
        "a:\n  x: {type: string, default_value: a, validation: {bounds<>: [0, 1]}}\n",
        "p.yaml:2:62: error: 'bounds<>' does not fit 'x' of type string. Write bounds<>: [0, 10], for an int or double",
    ),
    "one bound": (
        "a:\n  x: {type: int, default_value: 1, validation: {bounds<>: [0]}}\n",
        "p.yaml:2:59: error: 'bounds<>' does not fit 'x' of type integer",
    ),
    "list of values without its list": (
        "a:\n  x: {type: int, default_value: 1, validation: {one_of<>: [1, 2]}}\n",
        "p.yaml:2:59: error: 'one_of<>' does not fit 'x' of type integer. Write one_of<>: [[1, 2]]",
    ),
    "a value of another type": (
        "a:\n  x: {type: int, default_value: 1, validation: {one_of<>: [[1, b]]}}\n",
        "p.yaml:2:64: error: a value of `one_of` is not of type integer",
    ),
    "default out of range": (
        "a:\n  x: {type: int, default_value: 11, validation: {bounds<>: [0, 10]}}\n",
        "p.yaml:2:33: error: the default of the parameter 'x' is not in its range. Write 10: it goes from 0 to 10",
    ),
    "default of another type": (
        "a:\n  x: {type: int, default_value: 1.5}\n",
        "p.yaml:2:33: error: the default of the parameter 'x' is not of type integer. Write 2, or type: double",
    ),
    "YAML 1.1": (
        "a:\n  x: {type: int, default_value: 1, read_only: yes}\n",
        "p.yaml:2:47: error: this value must be true or false: 'read_only'. Write true, or remove `read_only`",
    ),
    "rules in a list": (
        "a:\n  x: {type: int, default_value: 1, validation: [bounds]}\n",
        "p.yaml:2:48: error: 'validation' must be a mapping of rules. Write {bounds<>: [0, 10]}",
    ),
}

RULES = [
    ("string", '""', "not_empty<>: []", "Parameter 'x' cannot be empty"),
    ("string", "ab", "fixed_size<>: [1]", None),
    ("string", "ab", "size_gt<>: [2]", "Length of parameter 'x' is '2' but must be greater than '2'"),
    ("int_array_fixed_4", "[]", "not_empty<>: null", "Parameter 'x' cannot be empty"),
    (
        "int_array_fixed_4",
        "[1]",
        "fixed_size<>: 2",
        "Length of parameter 'x' is '1' but must be equal to '2'",
    ),
    ("int_array_fixed_4", "[1, 1]", "unique<>: []", "Parameter 'x' must only contain unique values"),
    (
        *("int_array_fixed_4", "[1, 9]", "element_bounds<>: [0, 8]"),
        "Value '9' in parameter 'x' must be within bounds '[0, 8]'",
    ),
    (
        *("double_array_fixed_4", "[1]", "lower_element_bounds<>: 1.5"),
        "Value '1' in parameter 'x' must be above lower bound of '1.5'",
    ),
    (
        *("double_array_fixed_4", "[2]", "upper_element_bounds<>: [1]"),
        "Value '2' in parameter 'x' must be below upper bound of '1'",
    ),
    (
        *("string_array_fixed_4", "[a, c]", "subset_of<>: [[a, b]]"),
        "Entry 'c' in parameter 'x' is not in the set '{a, b}'",
    ),
]


@pytest.mark.parametrize(("kind", "default", "rule", "reason"), RULES)
def test_a_default_follows_the_rules(kind: str, default: str, rule: str, reason: str | None) -> None:
    """The reason is that which a set request would get; what is too long for the device has another one.

    A value that is proposed follows all rules.
    """
    declared = f"a:\n  x: {{{{type: {kind}, default_value: {{}}, validation: {{{{{rule}}}}}}}}}\n"
    found, faults = parsed(declared.format(default))
    assert found == ()
    column = len(f"  x: {{type: {kind}, default_value: ") + 1
    begin = f"p.yaml:2:{column}: error: the default of the parameter 'x' "
    if reason is None:
        assert faults == [f"{begin}is longer than its size. Write fixed_size<>: [2]"]
        return
    (fault,) = faults
    assert fault.startswith(f"{begin}does not follow its validation. Write ")
    assert fault.endswith(f": {reason}")
    proposed = fault.removesuffix(f": {reason}").rpartition("Write ")[2]
    if proposed != "another value":
        assert parsed(declared.format(proposed))[1] == []


MISFITS = [
    *(
        ("int", "1", rule)
        for rule in ("not_empty<>: []", "unique<>: []", "size_gt<>: [1]", "fixed_size<>: 1")
    ),
    *(("string", "a", rule) for rule in ("unique<>: []", "subset_of<>: [[a]]", "element_bounds<>: [0, 1]")),
    ("string_array_fixed_2", "[a]", "lower_element_bounds<>: [0]"),
    ("int_array_fixed_2", "[1]", "subset_of<>: [[1, b]]"),
    ("int_array_fixed_2", "[1]", "subset_of<>: [1]"),
    ("int_array_fixed_2", "[1]", "element_bounds<>: [0, 1.5]"),
    ("int_array_fixed_2", "[1]", "unique<>: [1]"),
    ("double_array_fixed_2", "[1]", "upper_element_bounds<>: [.inf]"),
    ("int_array_fixed_2", "[1]", "size_gt<>: [-1]"),
    ("int_array_fixed_2", "[1]", "fixed_size<>: [0]"),
]


@pytest.mark.parametrize(("kind", "default", "rule"), MISFITS)
def test_a_rule_fits_the_type(kind: str, default: str, rule: str) -> None:
    found, faults = parsed(f"a:\n  x: {{type: {kind}, default_value: {default}, validation: {{{rule}}}}}\n")
    assert found == ()
    name = rule.partition(":")[0]
    assert len(faults) == 1
    assert f"error: '{name}' does not fit 'x' of type " in faults[0]
    assert f". Write {name}: [" in faults[0]


MAPPED = """\
a:
  joints: {type: string_array, default_value: [l, r, l]}
  pid:
    __map_joints:
      gain: {type: double, default_value: 1.0}
      __map_axes: {limit: {type: int, default_value: 2}}
    axes: {type: string_array_fixed_3, default_value: [x, y]}
  axes: {type: string_array_fixed_3, default_value: [z]}
  __map_axes: {on: {type: bool, default_value: true}}
"""


def test_a_map_has_a_group_for_each_text_of_the_nearest_list() -> None:
    """By the names that the library gives; the lists are read-only, as a device has what is declared."""
    found, faults = parsed(MAPPED)
    assert faults == []
    names = [f"pid.{joint}.{name}" for joint in "lr" for name in ("gain", "x.limit", "y.limit")]
    assert [p.name for p in found] == ["joints", *names, "pid.axes", "axes", "z.on"]
    assert [(p.name, p.size) for p in found if p.read_only] == [("joints", 3), ("pid.axes", 3), ("axes", 3)]


@pytest.mark.parametrize("case", FAULTS)
def test_what_a_device_does_not_check_is_reported_at_its_place(case: str) -> None:
    text, expected = FAULTS[case]
    found, faults = parsed(text)
    assert found == ()
    assert len(faults) == 1, faults
    assert faults[0].startswith(expected), faults


APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
nodes:
  - name: arm
    parameters:
      file: config/motor.yaml
      declare: [{name: own, type: integer, default: 4}]
"""


def planned(folder: Path) -> compiler.Planned:
    config = folder / "microros.yaml"
    config.write_text(APPLICATION)
    return compiler.plan(compiler.resolve(compiler.read(compiler.Options(config=config))))


def test_a_node_has_those_of_the_file_first(tmp_path: Path) -> None:
    (tmp_path / "config").mkdir()
    file = tmp_path / "config/motor.yaml"
    file.write_text(GOOD)
    found = planned(tmp_path)
    names = [p.name for p in found.resolved.request.application.nodes[0].parameters]
    assert (names[0], names[-1], len(names)) == ("gains.p", "own", 13)
    files = compiler.render(found)
    declared = files["src/parameters/rclc_parameter_declared.c"].decode()
    [symbol] = re.findall(r'\{\.name = "gains\.p",[^}]* \.range = &(\w+)\}', declared)
    assert f"{symbol} = {{.floating_point = {{0.0, 10.0, 0.0}}}};" in declared
    assert b"parameter file motor.yaml" in files[MANIFEST]
    assert file in set(compiler.read_paths(found))


def test_a_file_is_read_once(tmp_path: Path) -> None:
    """What is declared and what the manifest has are of the same bytes, whatever happens to the file meanwhile."""
    opened: list[str] = []

    def count(event: str, arguments: tuple[Any, ...]) -> None:
        if event == "open" and str(arguments[0]).endswith("motor.yaml") and watched:
            opened.append(str(arguments[0]))

    watched = [True]
    sys.addaudithook(count)
    (tmp_path / "config").mkdir()
    (tmp_path / "config" / "motor.yaml").write_text(GOOD)
    opened.clear()
    compiler.render(planned(tmp_path))
    watched.clear()
    assert len(opened) == 1


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (None, "cannot read the parameter file"),
        (
            "m:\n  own: {type: bool, default_value: true}\n",
            "motor.yaml:2. Write another name such as own_2",
        ),
    ],
    ids=["missing", "twice"],
)
def test_a_file_that_does_not_fit(tmp_path: Path, text: str | None, expected: str) -> None:
    if text is not None:
        (tmp_path / "config").mkdir()
        (tmp_path / "config/motor.yaml").write_text(text)
    with pytest.raises(UserError) as caught:
        planned(tmp_path)
    assert any(expected in without_id(d.headline()) for d in caught.value.diagnostics)
