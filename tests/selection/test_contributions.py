# SPDX-License-Identifier: Apache-2.0
"""What components contribute: the format of component.yaml, and what the ones that ship with the tool declare."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import pytest

import microros_gen.selection
from microros_gen.diagnostics import Diagnostics, Source, UserError
from microros_gen.documents.schema import load_schema, validate
from microros_gen.documents.yaml_tree import parse_yaml
from microros_gen.selection.component import Catalogue, Component
from microros_gen.selection.component_sources import component_files
from microros_gen.selection.contribution import Contributions, ErrorCode, Handler, Hook, Replacement, State
from microros_gen.selection.find_components import load_catalogue

SCHEMA = Path(microros_gen.selection.__file__).with_name("component.schema.json")
HEAD = """\
component: x
summary: An example
layer: middleware
status: ready
"""
GOOD = f"""\
{HEAD}state:
  - {{declare: "uint32_t due[4]", section: parts, clocks: [due]}}
on: {{STATUS: xrce_x_on_status}}
hooks:
  step/receive: xrce_x_step(client, now)
  connected/endpoints:
    - {{call: xrce_x_reset(&client->x), when: {{streams.on_full: error}}}}
errors:
  x_full: {{code: 98, text: 'all %n x are in use'}}
  x_lost: 99
"""


def catalogue_of(folder: Path, text: str) -> Catalogue:
    (folder / "x").mkdir()
    (folder / "x" / "component.yaml").write_text(text, encoding="utf-8")
    return load_catalogue(folder)


def schema_words(name: str, text: str) -> list[str]:
    found, source = Diagnostics(), Source(name, text)
    validate(parse_yaml(source, found), source, load_schema(SCHEMA), found)
    return [diagnostic.headline() for diagnostic in found]


def test_contributions_are_read(tmp_path: Path) -> None:
    assert schema_words("x", GOOD) == []
    contributes = catalogue_of(tmp_path, GOOD)["x"].contributes
    assert contributes == Contributions(
        state=(State(declaration="uint32_t due[4]", section="parts", clocks=("due",)),),
        hooks=(
            Hook(point="step", phase="receive", call="xrce_x_step(client, now)"),
            Hook(
                point="connected",
                phase="endpoints",
                call="xrce_x_reset(&client->x)",
                when=(("streams.on_full", "error"),),
            ),
        ),
        handlers=(Handler(submessage="STATUS", function="xrce_x_on_status"),),
        errors=(
            ErrorCode(name="x_full", code=98, text="all %n x are in use"),
            ErrorCode(name="x_lost", code=99),
        ),
    )


@pytest.mark.parametrize(
    ("before", "after", "reported"),
    [
        ("step/receive", "stop/receive", "x/component.yaml:9:3: error: unknown hook point 'stop'"),
        ("step/receive", "step/recieve", "x/component.yaml:9:3: error: unknown phase 'recieve' of 'step'"),
        (
            "(client, now)",
            "(client, then)",
            "x/component.yaml:9:17: error: unknown variable 'then' of the hook",
        ),
        (
            "xrce_x_step(client, now)",
            "xrce_x_step",
            "x/component.yaml:9:17: error: 'xrce_x_step' is not a call",
        ),
    ],
)
def test_a_faulty_hook_is_refused(before: str, after: str, reported: str, tmp_path: Path) -> None:
    with pytest.raises(UserError) as caught:
        catalogue_of(tmp_path, GOOD.replace(before, after, 1))
    lines = [d.headline() for d in caught.value.diagnostics]
    assert any(line.startswith(reported) for line in lines), lines


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("section: parts", "section: bits"),
        ("STATUS:", "STATE:"),
        ("step/receive", "step/recieve"),
        ("code: 98", "code: 256"),
        ("declare:", "declares:"),
    ],
)
def test_the_schema_refuses_the_same(before: str, after: str) -> None:
    assert schema_words("x", GOOD.replace(before, after, 1)) != []


def test_every_component_fits_the_schema(real_catalogue: Catalogue) -> None:
    for name, component in real_catalogue.items():
        text = (component.folder / "component.yaml").read_text(encoding="utf-8")
        assert schema_words(name, text) == []


def test_each_error_has_a_unique_name_and_number(real_catalogue: Catalogue) -> None:
    errors = [error for component in real_catalogue.values() for error in component.contributes.errors]
    names, codes = Counter(e.name for e in errors), Counter(e.code for e in errors)
    assert [name for name, count in names.items() if count > 1] == []
    assert [code for code, count in codes.items() if count > 1] == []
    assert all(2 <= code <= 255 for code in codes)


def test_each_submessage_that_is_handled_is_received(real_catalogue: Catalogue) -> None:
    for component in real_catalogue.values():
        handled = {handler.submessage for handler in component.contributes.handlers}
        assert handled <= set(component.receives), component.name


def test_what_is_called_is_declared(real_catalogue: Catalogue) -> None:
    """Each function of a hook or handler is declared in a header that the component names for it."""
    for component in real_catalogue.values():
        parts = component.contributes
        calls = [hook.call for hook in parts.hooks] + [hook.test for hook in parts.hooks if hook.test]
        functions = {re.split(r"\W", call.removeprefix("(void)"))[0] for call in calls}
        functions |= {handler.function for handler in parts.handlers}
        named = [header.header for header in parts.hook_headers] + [state.header for state in parts.state]
        text = "".join(_header_text(component, header) for header in named if header)
        for function in functions - _always_there():
            assert re.search(rf"\b{function}\(", text), f"{component.name}: {function}"


def _header_text(component: Component, header: str) -> str:
    """Return the text of a header; of one with variants, that of the shortest, which declares the fewest functions."""
    path = component.folder / "include" / header
    variants = [
        component.folder / "variants" / v.file for v in component.contributes.variants if v.header == header
    ]
    found = [p for p in (path, path.with_name(f"{path.name}.j2"), *variants) if p.exists()]
    return min((p.read_text(encoding="utf-8") for p in found), key=len, default="")


def _always_there() -> set[str]:
    """Return what rcl/time.h and xrce_session.h declare, which the callers include anyway."""
    return {
        "xrce_session_step",
        "xrce_session_on_status_agent",
        "rcl_steady_clock_init",
        "rcl_ros_clock_init",
    } | {"rcl_ros_clock_fini", "xrce_session_drain"}


def test_two_components_do_not_replace_one_header() -> None:
    def component(name: str) -> Component:
        replaces = (Replacement(header="microros/lock.h"),)
        return Component(name, "", "middleware", True, contributes=Contributions(replaces=replaces))

    with pytest.raises(UserError) as caught:
        component_files((component("a"), component("b")), lambda when: True)
    (reported,) = [d.headline() for d in caught.value.diagnostics]
    assert "'a' and 'b' both replace 'microros/lock.h'" in reported


def test_a_member_of_two_components_has_one_comment() -> None:
    """It is printed once, where both are selected."""
    comments: dict[tuple[str, str], set[str]] = {}
    for component in load_catalogue().values():
        for state in component.contributes.state:
            comments.setdefault((state.section, state.declaration), set()).add(state.comment)
    assert {member: found for member, found in comments.items() if len(found) > 1} == {}
