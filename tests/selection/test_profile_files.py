# SPDX-License-Identifier: Apache-2.0
"""Profiles of the user's own: where they are found, what they extend, and what is wrong with them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from microros_gen.diagnostics import Diagnostics, Source, UserError
from microros_gen.documents.named import Named
from microros_gen.documents.shipped import profiles_folder
from microros_gen.selection.find_profiles import (
    load_builtin_profiles,
    load_middleware,
    load_profiles,
)
from microros_gen.selection.profile_file import parse_middleware, parse_profile
from microros_gen.selection.profiles import resolve_profiles
from tests.support.ids import without_id
from tests.support.selection.small_catalogue import Outcome

Resolve = Callable[..., Outcome]


def write(folder: Path, **files: str) -> None:
    for name, text in files.items():
        (folder / f"{name}.yaml").write_text(text, encoding="utf-8")


def fold(folder: Path, *names: str) -> tuple[list[str], dict[str, tuple[str, ...]]]:
    """Return the messages (without the folder) and the components of each resolved profile."""
    found_diagnostics = Diagnostics()
    resolved = resolve_profiles(
        load_profiles([Named(n) for n in names], folder, found_diagnostics), found_diagnostics
    )
    lines = [without_id(d.headline()).replace(f"{folder.as_posix()}/", "") for d in found_diagnostics]
    return lines, {p.name: tuple(sorted(a.name for a in p.adds)) for p in resolved}


def test_a_profile_extends_adds_and_drops(tmp_path: Path, resolve: Resolve) -> None:
    write(
        tmp_path,
        quiet="profile: quiet\nextends: [configurable_sender_with_diagnostics]\n"
        "components: [-logging, +timers, clock]\nliveliness: none\n",
    )
    found_diagnostics, found = fold(tmp_path, "quiet")
    assert found_diagnostics == []
    assert found == {"quiet": ("clock", "node", "parameters", "publish", "timers")}
    outcome = resolve("quiet", folder=tmp_path)
    assert outcome.messages == ()
    assert "logging" not in outcome.names()
    assert outcome.selection.liveliness == "none"
    assert outcome.reasons("timers") == ("profile quiet",)


def test_a_profile_is_found_by_name_and_by_path(tmp_path: Path) -> None:
    (tmp_path / "own").mkdir()
    write(tmp_path, one="profile: one\nextends: [own/two.yaml]\n")
    write(tmp_path / "own", two="profile: two\nextends: [three]\ncomponents: [+clock]\n")
    (tmp_path / "own" / "three.yml").write_text("profile: three\nextends: [pure_sender]\n")
    assert fold(tmp_path, "one") == ([], {"one": ("clock", "node", "publish")})
    assert fold(tmp_path, "own/two.yaml") == ([], {"two": ("clock", "node", "publish")})
    assert fold(tmp_path, str(tmp_path / "one.yaml"))[1] == {"one": ("clock", "node", "publish")}


def test_the_same_profile_twice_is_one(tmp_path: Path) -> None:
    assert fold(tmp_path, "pure_sender", "pure_sender")[1] == {"pure_sender": ("node", "publish")}


def test_the_nearest_definition_wins(tmp_path: Path, resolve: Resolve) -> None:
    write(
        tmp_path,
        far="profile: far\nextends: [pure_sender]\nentities: xml\ncomponents: [+clock]\n",
        near="profile: near\nextends: [far]\nentities: reference\ncomponents: [-clock]\n",
    )
    outcome = resolve("near", folder=tmp_path)
    assert outcome.messages == ()
    assert outcome.selection.entities == "reference"
    assert "clock" not in outcome.names()


BASES = {
    "a": "profile: a\ncomponents: [+node]\nliveliness: ping\n",
    "b": "profile: b\ncomponents: [+node]\nliveliness: none\n",
}


def test_profiles_that_disagree_about_an_axis(tmp_path: Path, resolve: Resolve) -> None:
    write(tmp_path, **BASES)
    place = f"{tmp_path.as_posix()}"
    found_diagnostics = resolve("b", "a", folder=tmp_path).messages
    assert found_diagnostics == (
        f"{place}/b.yaml:3:13: error: the profile 'b' has liveliness: none, and the profile 'a' has "
        f"liveliness: ping ({place}/a.yaml:3). Decide in the application with `liveliness: none`",
    )
    decided = resolve("b", "a", folder=tmp_path, text="liveliness: none\n")
    assert decided.messages == ()


def test_a_component_that_one_profile_drops_and_another_has(tmp_path: Path, resolve: Resolve) -> None:
    write(
        tmp_path,
        less="profile: less\nextends: [configurable_sender_with_diagnostics]\ncomponents: [-logging]\n",
    )
    write(tmp_path, more="profile: more\ncomponents: [+node, +logging]\n")
    found_diagnostics = resolve("less", "more", folder=tmp_path).messages
    place = tmp_path.as_posix()
    assert found_diagnostics == (
        f"{place}/less.yaml:3:14: error: the profile 'less' drops 'logging' and the profile 'more' has it "
        f"({place}/more.yaml:2). Decide in the application: `components: [+logging]` or `[-logging]`",
    )
    for sign, selected in (("+", True), ("-", False)):
        decided = resolve("less", "more", folder=tmp_path, text=f"components: ['{sign}logging']\n")
        assert decided.messages == ()
        assert ("logging" in decided.names()) is selected


def test_a_profile_that_drops_what_another_component_needs(tmp_path: Path, resolve: Resolve) -> None:
    write(tmp_path, broken="profile: broken\nextends: [pure_reader]\ncomponents: [-executor]\n")
    found_diagnostics = resolve("broken", folder=tmp_path).messages
    assert found_diagnostics[0].startswith(
        f"{tmp_path.as_posix()}/broken.yaml:3:14: error: '-executor' of the profile broken drops a component "
        "that subscribe needs (selected by profile broken"
    )


ERRORS = {
    "bases disagree about an axis": (
        {**BASES, "x": "profile: x\nextends: [a, b]\n"},
        "x.yaml:1:10: error: the profile 'x' extends liveliness: ping (a.yaml:3) and liveliness: "
        "none (b.yaml:3). "
        "Choose with `liveliness:` in it",
    ),
    "bases disagree about a component": (
        {
            "c": "profile: c\nextends: [pure_sender]\ncomponents: [-publish]\n",
            "x": "profile: x\nextends: [c, pure_sender]\n",
        },
        "x.yaml:1:10: error: the profile 'x' extends one that has 'publish' "
        "(profiles/pure_sender.yaml:4) and one "
        "that drops it (c.yaml:3). Decide with +publish or -publish in its components",
    ),
    "add and drop": (
        {"x": "profile: x\nextends: [pure_sender]\ncomponents: [+clock, -clock]\n"},
        "x.yaml:3:22: error: '-clock' contradicts '+clock' (x.yaml:3). Remove one of them",
    ),
    "extends itself": (
        {"x": "profile: x\nextends: [y]\n", "y": "profile: y\nextends: [x]\n"},
        "y.yaml:2:11: error: the profile 'x' extends itself (x → y → x). Remove one of the `extends`",
    ),
    "unknown base": (
        {"x": "profile: x\nextends: [pure_sendr]\n"},
        "x.yaml:2:11: error: unknown profile 'pure_sendr'. Did you mean 'pure_sender'?",
    ),
    "missing file": (
        {"x": "profile: x\nextends: [own/base.yaml]\n"},
        "x.yaml:2:11: error: profile file 'own/base.yaml' not found in",
    ),
    "name of a built-in profile": (
        {"x": "profile: pure_sender\n"},
        "x.yaml:1:10: error: the profile name 'pure_sender' is taken by the built-in pure_sender. "
        "Give it a different name",
    ),
    "empty": ({"x": "# nothing\n"}, "x.yaml:1:1: error: the file is empty. Write `key: value` lines"),
    "no name": (
        {"x": "summary: y\n"},
        "x.yaml:1:1: error: missing key 'profile' in the file. Add `profile: …`",
    ),
    "unknown key": (
        {"x": "profile: x\ncomponent: [+clock]\n"},
        "x.yaml:2:1: error: unknown key 'component' in the file. Did you mean 'components'?",
    ),
    "bad axis": (
        {"x": "profile: x\nentities: binaries\n"},
        "x.yaml:2:11: error: 'entities' must be preconfigured, reference, xml or binary; it is the text "
        "'binaries'. Did you mean 'binary'?",
    ),
    "bad component": (
        {"x": "profile: x\ncomponents: ['~clock']\n"},
        "x.yaml:2:14: error: 'components[0]' must be a component to add or drop such as +timers or -ping; "
        "it is the text '~clock'",
    ),
    "not YAML": (
        {"x": "profile: x\ncomponents: [+clock\n"},
        "x.yaml:2:13: error: not valid YAML: a list in [ ] is not closed or lacks a comma. Add ',' or ']'",
    ),
    "drops from nothing": (
        {"x": "profile: x\ncomponents: [+node, -clock]\n"},
        "x.yaml:2:21: warning: '-clock' drops nothing: the profile 'x' extends no other. "
        "Add `extends: […]`, or remove it",
    ),
}


@pytest.mark.parametrize("case", ERRORS)
def test_faulty_profiles_are_reported_with_their_place(case: str, tmp_path: Path) -> None:
    files, expected = ERRORS[case]
    write(tmp_path, **files)
    found_diagnostics, _ = fold(tmp_path, "x")
    assert any(line.startswith(expected) for line in found_diagnostics), found_diagnostics


def test_a_profile_that_there_is_not(tmp_path: Path) -> None:
    write(tmp_path, my_sender="profile: my_sender\n")
    assert fold(tmp_path, "pur_sender")[0] == [
        "microros-gen: error: unknown profile 'pur_sender'. Did you mean 'pure_sender'?"
    ]
    assert fold(tmp_path, "my_sendr")[0] == [
        "microros-gen: error: unknown profile 'my_sendr'. Did you mean 'my_sender'?"
    ]
    assert "Built-in: pure_sender, pure_reader," in fold(tmp_path, "qqq")[0][0]


def test_a_profile_that_is_no_text(tmp_path: Path) -> None:
    (tmp_path / "x.yaml").write_bytes(b"profile: \xff\n")
    found_diagnostics, _ = fold(tmp_path, "x")
    assert found_diagnostics == ["microros-gen: error: 'x.yaml' is not UTF-8. Save the file as UTF-8"]


def test_profiles_are_found_in_the_repository() -> None:
    assert (profiles_folder() / "middleware.yaml").is_file()


def test_profiles_are_found_in_a_wheel(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A wheel has them below the package, see force-include in pyproject.toml."""
    installed = tmp_path / "microros_gen" / "profiles"
    installed.mkdir(parents=True)
    (tmp_path / "profiles").mkdir()
    module = tmp_path / "microros_gen"
    monkeypatch.setattr("microros_gen.documents.shipped._PACKAGE", module.resolve())
    assert profiles_folder() == installed.resolve()
    installed.rmdir()
    assert profiles_folder() == (tmp_path / "profiles").resolve()


def test_built_in_profiles_fit_the_schema() -> None:
    for path in sorted(profiles_folder().glob("*.yaml")):
        if path.name != "middleware.yaml":
            found_diagnostics = Diagnostics()
            source = Source(path.name, path.read_text(encoding="utf-8"))
            assert parse_profile(source, found_diagnostics) is not None, [
                without_id(d.headline()) for d in found_diagnostics
            ]


def test_a_built_in_profile_is_named_as_its_file(tmp_path: Path) -> None:
    write(tmp_path, x="profile: y\n", z="components: 3\n")
    with pytest.raises(UserError) as caught:
        load_builtin_profiles(tmp_path)
    assert [without_id(d.headline()) for d in caught.value.diagnostics] == [
        "profiles/x.yaml:1:10: error: 'x.yaml' describes 'y'. Rename one of them",
        "profiles/z.yaml:1:1: error: missing key 'profile'. Add `profile: …`",
        "profiles/z.yaml:1:13: error: 'components' must be a list. Write `components: [a, b]`",
    ]


def test_a_faulty_middleware_table_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UserError, match=r"cannot read 'profiles/middleware\.yaml'"):
        load_middleware(tmp_path)
    text = (profiles_folder() / "middleware.yaml").read_text(encoding="utf-8")
    for before, after, reported in (
        ("all_but: [CREATE, INFO, WRITE_DATA", "all_but: [CREATE, INFOS, WRITE_DATA", "Did you mean 'INFO'"),
        ("  publish: [write]", "  publish: [writes]", "Did you mean 'write'"),
        ("default: ping", "default: pong", "Did you mean 'ping'"),
        ("  complete:", "  completes:", "unknown key 'completes'. Did you mean 'complete'"),
    ):
        assert before in text
        found_diagnostics = Diagnostics()
        parse_middleware(Source("m.yaml", text.replace(before, after)), found_diagnostics)
        assert any(reported in without_id(d.headline()) for d in found_diagnostics), [
            without_id(d.headline()) for d in found_diagnostics
        ]
