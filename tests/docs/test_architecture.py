# SPDX-License-Identifier: Apache-2.0
"""docs/architecture.md: its example is a component file, and what it says of where to add things is so."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import microros_gen
from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.selection.component_file import parse_component
from tests.support.paths import ROOT

PAGE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
PACKAGE = Path(microros_gen.__file__).parent
_MADE_UP = re.compile(r"[<*…]|/(?:name|x)\b")


def folders() -> list[str]:
    """Return the folders of the package that have Python modules."""
    return sorted({p.relative_to(PACKAGE).parts[0] for p in PACKAGE.rglob("*.py") if p.parent != PACKAGE})


def test_the_example_is_a_component_file() -> None:
    (example,) = re.findall(r"^```yaml\n(component: .*?)^```", PAGE, re.MULTILINE | re.DOTALL)
    diagnostics = Diagnostics()
    component = parse_component(Source("component.yaml", example), diagnostics)
    assert [d.headline() for d in diagnostics] == []
    assert component is not None
    assert (component.name, component.sends) == ("publish", ("WRITE_DATA",))


def test_every_folder_is_in_the_table() -> None:
    first_section = PAGE.partition("\n## ")[0]
    named = re.findall(r"^\| `(\w+)/`", first_section, re.MULTILINE)
    assert sorted({*named, "components"}) == sorted({*folders(), "components"}), "C, and what C is planned by"


def test_the_modules_that_it_names_exist() -> None:
    """`client/plan/entities.py`, below the package or in the repository."""
    named = set(re.findall(r"`((?:\w+/)+\w+\.(?:py|json|yaml|schema\.json))`", PAGE))
    places = (PACKAGE, ROOT)
    missing = [n for n in named if not _MADE_UP.search(n) and not any((p / n).exists() for p in places)]
    assert sorted(missing) == []
    assert len(named) > 20


@pytest.mark.parametrize(
    ("module", "words"),
    [
        ("application/kinds.py", ("KINDS",)),
        ("client/plan/plan_id.py", ("VERSION",)),
        ("selection/extension.py", ("class Extensions",)),
        ("cli/main.py", ("_COMMANDS",)),
        ("migrate/rclc_calls.py", ("ENDPOINT_CALLS",)),
        ("platform/provide.py", ("def provide",)),
    ],
)
def test_what_is_said_to_be_there_is_there(module: str, words: tuple[str, ...]) -> None:
    assert f"`{module}`" in PAGE
    text = (PACKAGE / module).read_text(encoding="utf-8")
    assert [word for word in words if word not in text] == []


def test_a_command_is_a_module_and_a_line() -> None:
    from microros_gen.cli.main import _COMMANDS

    for name in _COMMANDS:
        module = PACKAGE / "cli" / name.replace("-", "_")
        modules = (module.with_suffix(".py"), module)
        assert any(path.exists() for path in modules), name
