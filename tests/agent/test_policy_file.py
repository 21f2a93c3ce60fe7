# SPDX-License-Identifier: Apache-2.0
"""Policy files: what they say, and every mistake with its place, in one run."""

from __future__ import annotations

import fnmatch
import itertools
import json
import re
from ipaddress import ip_network

import pytest
from jsonschema import Draft202012Validator

from microros_gen.agent.limits import Limits
from microros_gen.agent.policy.checks import check_domain
from microros_gen.agent.policy.model import CLIENT_LIMITS, ClientRule, Keys, NameRule, Policy, QosRule
from microros_gen.agent.policy.parser import SCHEMA, parse_policy
from microros_gen.agent.policy.patterns import covers, is_pattern, matches
from microros_gen.diagnostics import Diagnostics, Source, Span

WHOLE = """\
version: 1
clients:
  - name: arm
    keys: [0xA1B2C3D4, "0x10-0x1F"]
    addresses: [192.168.10.0/24, 10.1.2.3, "fd00::/8"]
    devices: [/dev/serial/by-id/usb-*, can0]
    domain: 7
    nodes: [/arm]
    qos: {durability: volatile, depth: 10}
    publish:
      - /arm/**
      - {name: /map, durability: [volatile, transient_local], depth: 1}
    subscribe: [{name: /secret/*, refuse: true}, "/**"]
    call: [/lift/*]
    serve: [/arm/reset]
    call_actions: [/dock]
    serve_actions: [/move]
    graph: true
    limits: {objects: 8, messages_per_second: 100, work_ms_per_second: 50}
  - name: others
    domains: [0, 3]
    publish: [/x]
    refuse: false
  - {name: strangers, refuse: true, addresses: ["::/0"], keys: [0x1]}
"""


def parse(text: str) -> tuple[Policy, list[str]]:
    """Return the policy, and of each diagnostic the line, the text at its place and the id."""
    diagnostics = Diagnostics()
    policy = parse_policy(Source("p.yaml", text), diagnostics)
    return policy, [f"{d.span.line} {word_at(d.span)} {d.id}" for d in diagnostics if d.span is not None]


def word_at(span: Span) -> str:
    """Return the text at a place up to the end of the item."""
    found = re.match(r"[^,\]}:]*", span.source.line(span.line)[span.column - 1 :])
    return found[0] if found else ""


def mistakes(rule: str) -> list[str]:
    """Return what `parse` found in one rule or several, whose text begins in line 3."""
    return parse(f"version: 1\nclients:\n{rule}")[1]


def test_everything_that_a_file_can_say() -> None:
    text = WHOLE.replace("  - {name: strangers", "  - {name: late").replace(", keys: [0x1]", "")
    text = text.replace("  - name: others\n", "  - name: others\n    devices: [/dev/ttyS*]\n")
    policy, found = parse(text)
    assert found == []
    common = QosRule(durability=("volatile",), depth=10)
    own = QosRule(durability=("volatile", "transient_local"), depth=1)
    assert policy.rules[0] == ClientRule(
        name="arm",
        keys=(Keys(0xA1B2C3D4, 0xA1B2C3D4), Keys(0x10, 0x1F)),
        addresses=tuple(map(ip_network, ("192.168.10.0/24", "10.1.2.3/32", "fd00::/8"))),
        devices=("/dev/serial/by-id/usb-*", "can0"),
        domain=7,
        nodes=(NameRule("/arm"),),
        lists=(
            ("publish", (NameRule("/arm/**", qos=common), NameRule("/map", qos=own))),
            ("subscribe", (NameRule("/secret/*", True, common), NameRule("/**", qos=common))),
            ("call", (NameRule("/lift/*", qos=common),)),
            ("serve", (NameRule("/arm/reset", qos=common),)),
            ("call_actions", (NameRule("/dock", qos=common),)),
            ("serve_actions", (NameRule("/move", qos=common),)),
        ),
        graph=True,
        limits=(("objects", 8), ("messages_per_second", 100)),
        work_ms=50,
    )
    assert policy.rules[1].domains == (0, 3)
    assert policy.rules[2].refuse
    limits = policy.rules[0].limited(Limits())
    assert (limits.objects, limits.messages_per_second, limits.streams) == (8, 100, Limits().streams)
    assert policy.rules[2].limited(limits) is limits


def test_a_policy_without_rules_refuses_everybody() -> None:
    assert parse("version: 1\nclients: []\n") == (Policy(), [])


@pytest.mark.parametrize(
    ("rule", "expected"),
    [
        ("  - {name: a, publish: [/a], keys: [0x0]}", ["3 0x0 MG-9503"]),
        (
            "  - {name: a, publish: [/a], keys: [12, arm, 0x123456789]}",
            ["3 12 MG-9503", "3 arm MG-9503", "3 0x123456789 MG-9503"],
        ),
        ("  - {name: a, publish: [/a], keys: [0x20-0x10]}", ["3 0x20-0x10 MG-9504"]),
        ("  - {name: a, publish: [/a], addresses: [10.0.0.1/8]}", ["3 10.0.0.1/8 MG-9505"]),
        (
            "  - {name: a, publish: [/a], addresses: [10.0.0.0/33, host]}",
            ["3 10.0.0.0/33 MG-9505", "3 host MG-9505"],
        ),
        (
            "  - {name: a, publish: [/a], devices: [dev/ttyUSB0, ttyUSB0]}",
            ["3 dev/ttyUSB0 MG-9506", "3 ttyUSB0 MG-9506"],
        ),
        (
            "  - {name: a, publish: [a, ~/b, /a b, //x, /]}",
            ["3 a MG-9507", "3 ~/b MG-9507", "3 /a b MG-9507", "3 //x MG-9507", "3 / MG-9507"],
        ),
        ("  - {name: a, publish: [/a], nodes: [arm]}", ["3 arm MG-9507"]),
        ("  - {name: a, publish: [/a]}\n  - {name: a, publish: [/a]}", ["4 a MG-9508"]),
        ("  - {name: a, publish: [/a]}\n  - {name: b, publish: [/a], keys: [0x1]}", ["4 b MG-9509"]),
        (
            "  - {name: a, refuse: true, publish: [/a], limits: {objects: 1}}",
            ["3 publish MG-9511", "3 limits MG-9511"],
        ),
        ("  - {name: a, publish: [/a], domain: 1, domains: [1, 2]}", ["3 a MG-9512"]),
        ("  - {name: a}", ["3 a MG-9513"]),
        ("  - {name: a, publish: [{name: /a, refuse: true, depth: 1}]}", ["3 depth MG-9514"]),
        ("  - {name: a, publish: [/a], qos: {history: keep_all, depth: 1}}", ["3 1 MG-9515"]),
        ("  - {name: a, publish: [{name: /a, history: [keep_all], depth: 1}]}", ["3 1 MG-9515"]),
        ("  - {name: a, publish: [/a/**, /a/b]}", ["3 /a/b MG-9516"]),
        ("  - {name: a, publish: [/a], keys: [0x1-0x9, 0x5]}", ["3 a MG-9517"]),
        ("  - {name: a, publish: [/a], addresses: [10.0.0.0/8, 10.1.0.0/16]}", ["3 a MG-9517"]),
        ("  - {name: a, publish: [/a], devices: [/dev/tty*, /dev/ttyS0]}", ["3 a MG-9517"]),
        ("  - {name: a, pubblish: [/a]}", ["3 pubblish MG-1002"]),
        ("  - {publish: [/a]}", ["3 {publish MG-1003"]),
        ("  - {name: a, call: [{name: /a, depth: 1}]}", ["3 depth MG-1002"]),
        ("  - {name: a, publish: [/a], qos: {durability: latched}}", ["3 latched MG-1005"]),
        ("  - {name: a, publish: [/a], limits: {clients: 3}}", ["3 clients MG-1002"]),
        ("  - {name: a, publish: [/a], domain: 233}", ["3 233 MG-1005"]),
    ],
)
def test_mistakes_with_their_places(rule: str, expected: list[str]) -> None:
    assert mistakes(rule) == expected


def test_mistakes_of_several_rules_in_one_run() -> None:
    text = (
        "  - {name: a, keys: [0x0], publish: [b]}\n  - {name: b, addresses: [x], domain: 1, domains: [1]}\n"
    )
    assert sorted(mistakes(text)) == [
        "3 0x0 MG-9503",
        "3 b MG-9507",
        "4 b MG-9512",
        "4 b MG-9513",
        "4 x MG-9505",
    ]


@pytest.mark.parametrize(
    ("earlier", "later", "covered"),
    [
        ("keys: [0x1-0xF]", "keys: [0x3, 0x7]", True),
        ("keys: [0x1-0x5, 0x6-0xF]", "keys: [0x3-0x7]", True),
        ("keys: [0x1-0x5, 0x7-0xF]", "keys: [0x3-0x8]", False),
        ("keys: [0x1]", "addresses: [10.0.0.0/8]", False),
        ("addresses: [10.0.0.0/9, 10.128.0.0/9]", "addresses: [10.0.0.0/8]", True),
        ("addresses: [0.0.0.0/0]", "addresses: ['fd00::/8']", False),
        ("addresses: [10.0.0.0/8]", "addresses: [10.1.0.0/16], devices: [/dev/x]", False),
        ("devices: ['/dev/*']", "devices: [/dev/ttyS0], keys: [0x1]", True),
        ("devices: ['/dev/*']", "devices: [/dev/serial/by-id/x]", False),
        ("devices: ['/dev/**']", "devices: ['/dev/serial/by-id/*']", True),
        ("addresses: [10.0.0.0/8], keys: [0x1]", "addresses: [10.1.1.1]", False),
        ("refuse: true", "addresses: [10.1.1.1]", True),
    ],
)
def test_a_rule_that_can_never_match(earlier: str, later: str, covered: bool) -> None:
    first = f"  - {{name: a, {earlier}" + ("}" if "refuse" in earlier else ", publish: [/a]}")
    assert ("4 b MG-9509" in mistakes(f"{first}\n  - {{name: b, publish: [/a], {later}}}")) == covered


def test_a_faulty_item_makes_no_other_rule_unreachable() -> None:
    """Without it, the rule would seem to be for every client."""
    text = "  - {name: a, keys: [0x0], publish: [/a]}\n  - {name: b, publish: [/a]}"
    assert mistakes(text) == ["3 0x0 MG-9503"]


@pytest.mark.parametrize(
    ("rule", "domain", "contradicts"),
    [("domain: 3", 3, False), ("domain: 3", 4, True), ("domains: [3, 4]", 4, True), ("domains: [4]", 4, False),
     ("graph: true", 4, False), ("domain: 3", None, False)],
)  # fmt: skip
def test_the_domain_of_the_agent_contradicts_that_of_a_rule(
    rule: str, domain: int | None, contradicts: bool
) -> None:
    policy, found = parse(f"version: 1\nclients:\n  - {{name: a, publish: [/a], {rule}}}")
    assert found == []
    diagnostics = Diagnostics()
    check_domain(policy, domain, diagnostics)
    assert [d.id for d in diagnostics] == (["MG-9510"] if contradicts else [])


def test_the_schema_is_one_and_has_the_limits_of_the_agent() -> None:
    schema = json.loads(SCHEMA.read_text())
    Draft202012Validator.check_schema(schema)
    assert [*schema["$defs"]["rule"]["properties"]["limits"]["properties"]] == [
        *CLIENT_LIMITS,
        "work_ms_per_second",
    ]
    assert set(CLIENT_LIMITS) <= set(Limits.__dataclass_fields__)


# Patterns


@pytest.mark.parametrize(
    ("pattern", "fits", "others"),
    [
        ("/a", ["/a"], ["/a/b", "/ab", "/"]),
        ("/a/*", ["/a/b", "/a/bcd"], ["/a", "/a/b/c", "/b/a"]),
        ("/a/**", ["/a/b", "/a/b/c"], ["/a", "/ab"]),
        ("/a**", ["/a", "/ab", "/a/b"], ["/b"]),
        ("/*/state", ["/a/state", "/bc/state"], ["/state", "/a/b/state"]),
        ("/**/state", ["/a/state", "/a/b/state"], ["/state", "/astate"]),
        ("/leg_?", ["/leg_1", "/leg_x"], ["/leg_", "/leg_12", "/leg_/"]),
        ("/a.b", [], ["/a.b", "/axb"]),
    ],
)
def test_patterns(pattern: str, fits: list[str], others: list[str]) -> None:
    assert is_pattern(pattern) == ("." not in pattern)
    if is_pattern(pattern):
        assert [name for name in (*fits, *others) if matches(pattern, name)] == fits


PARTS = ("a", "b", "*", "**", "?", "/")
SHORT = [f"/{''.join(p)}" for length in (1, 2, 3) for p in itertools.product(PARTS, repeat=length)]
PATTERNS = sorted({text for text in SHORT if is_pattern(text) and "***" not in text})
NAMES = [f"/{''.join(p)}" for length in range(0, 5) for p in itertools.product("abc/", repeat=length)]


def test_one_pattern_covers_another_if_it_has_all_of_its_names() -> None:
    """Compared with all names of up to four characters, for pairs of patterns of up to three parts."""
    fitting = {pattern: frozenset(n for n in NAMES if matches(pattern, n)) for pattern in PATTERNS}
    pairs = list(itertools.product(PATTERNS[::3], PATTERNS[::2]))
    assert len(pairs) > 2000
    wrong = [
        (wide, narrow) for wide, narrow in pairs if covers(wide, narrow) != (fitting[narrow] <= fitting[wide])
    ]
    assert wrong == []


def test_without_slashes_a_pattern_is_that_of_a_shell() -> None:
    for pattern in ("/a*", "/?b", "/*a*b", "/a?*"):
        names = [name for name in NAMES if "/" not in name[1:]]
        assert [n for n in names if matches(pattern, n)] == fnmatch.filter(names, pattern)
