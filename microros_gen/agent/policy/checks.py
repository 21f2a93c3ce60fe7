# SPDX-License-Identifier: Apache-2.0
"""Mistakes in a policy that its schema cannot express: what contradicts itself, and what can never take effect."""

from __future__ import annotations

import ipaddress
from collections.abc import Sequence

from microros_gen.agent.policy.model import LISTS, ClientRule, Keys, NameRule, Network, Policy
from microros_gen.agent.policy.patterns import covers
from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.documents.tree_values import bool_of, child, entries, items
from microros_gen.documents.yaml_tree import YamlNode, to_data

_WITH_REFUSE = ("name", "keys", "addresses", "devices", "refuse")
_QOS = ("reliability", "durability", "history", "depth")


def check_rules(policy: Policy, nodes: Sequence[YamlNode], diagnostics: Diagnostics) -> None:
    """Report the mistakes of all rules; `nodes` has the mapping of each in the file."""
    names: dict[str, ClientRule] = {}
    complete: list[ClientRule] = []
    for rule, node in zip(policy.rules, nodes, strict=True):
        first = names.setdefault(rule.name, rule)
        if first is not rule:
            message = f"duplicate rule '{rule.name}'; first in line {_line(first.span)}"
            diagnostics.error(message, rule.span, "Give it another name", id="MG-9508")
            continue
        _check_contents(rule, node, diagnostics)
        _check_places(rule, diagnostics)
        if _is_incomplete(rule, node):
            continue
        complete.append(rule)
        wider = next((r for r in complete[:-1] if _includes(r, rule)), None)
        if wider is not None:
            message = (
                f"the rule '{rule.name}' can never match: each of its clients is one of '{wider.name}' (line"
                f" {_line(wider.span)}), and the first rule that fits decides"
            )
            diagnostics.error(
                message, rule.span, f"Move it before '{wider.name}', or remove it", id="MG-9509"
            )


def check_domain(policy: Policy, domain: int | None, diagnostics: Diagnostics) -> None:
    """Report rules that contradict the domain into which the agent puts every client."""
    for rule in policy.rules if domain is not None else ():
        permitted = rule.domains if rule.domain is None else (rule.domain,)
        if permitted is not None and permitted != (domain,):
            listed = ", ".join(str(number) for number in permitted)
            message = f"the rule '{rule.name}' is for domain {listed}, but the agent puts every client into {domain}"
            hint = "Remove --domain (`domain:` of the configuration file), or the domain of the rule"
            diagnostics.error(message, rule.span, hint, id="MG-9510")


def _is_incomplete(rule: ClientRule, node: YamlNode) -> bool:
    """Return whether a faulty item was left out, so that the rule seems to be for more clients than it is."""
    found = (("keys", rule.keys), ("addresses", rule.addresses), ("devices", rule.devices))
    return any(len(items(child(node, key))) != len(kept) for key, kept in found)


def _check_contents(rule: ClientRule, node: YamlNode, diagnostics: Diagnostics) -> None:
    if rule.refuse:
        for entry in entries(node):
            if entry.key not in _WITH_REFUSE:
                message = f"the rule '{rule.name}' refuses its clients, so '{entry.key}' has no effect"
                diagnostics.error(message, entry.key_span, "Remove it, or `refuse: true`", id="MG-9511")
        return
    if rule.domain is not None and rule.domains is not None:
        message = f"the rule '{rule.name}' has both 'domain' and 'domains'"
        hint = "Keep 'domain' to put its clients there, or 'domains' to permit a choice"
        diagnostics.error(message, rule.span, hint, id="MG-9512")
    if not any(names for _, names in rule.lists) and not rule.graph:
        message = f"the clients of the rule '{rule.name}' may connect, but use nothing"
        hint = "Add `publish: [/name]`, or `refuse: true`"
        diagnostics.warning(message, rule.span, hint, id="MG-9513")
    _check_depth(rule.name, child(node, "qos"), diagnostics)
    for key in LISTS:
        _check_names(rule.names(key), key, diagnostics)
        for item in items(child(node, key)):
            _check_entry(item, diagnostics)
            _check_depth(rule.name, item, diagnostics)


def _check_entry(item: YamlNode, diagnostics: Diagnostics) -> None:
    for entry in entries(item) if bool_of(child(item, "refuse")) else ():
        if entry.key in _QOS:
            message = f"the names are refused, so '{entry.key}' has no effect"
            diagnostics.error(message, entry.key_span, "Remove it, or `refuse: true`", id="MG-9514")


def _check_depth(rule: str, node: YamlNode | None, diagnostics: Diagnostics) -> None:
    histories, depth = child(node, "history"), child(node, "depth")
    if histories is None or depth is None:
        return
    named = to_data(histories)
    if "keep_all" in (named if isinstance(named, list) else [named]):
        message = f"keep_all has no depth, so that 'depth' contradicts it (rule '{rule}')"
        diagnostics.error(message, depth.span, "Remove the depth, or keep_all", id="MG-9515")


def _check_names(names: tuple[NameRule, ...], key: str, diagnostics: Diagnostics) -> None:
    for number, entry in enumerate(names):
        wider = next((e for e in names[:number] if covers(e.pattern, entry.pattern)), None)
        if wider is not None:
            message = (
                f"'{entry.pattern}' in '{key}' can never match: '{wider.pattern}' (line {_line(wider.span)}) has all of"
                " its names, and the first entry that fits decides"
            )
            hint = f"Move it before '{wider.pattern}', or remove it"
            diagnostics.error(message, entry.span, hint, id="MG-9516")


def _check_places(rule: ClientRule, diagnostics: Diagnostics) -> None:
    """Report items of `keys`, `addresses` and `devices` that another item of the list includes."""
    keys, networks, devices = rule.keys, rule.addresses, rule.devices
    repeated: list[tuple[str, str]] = []
    repeated += [(_key_text(a), _key_text(b)) for a in keys for b in keys if a is not b and b.covers(a)]
    repeated += [(str(a), str(b)) for a in networks for b in networks if a is not b and _within(a, b)]
    repeated += [(a, b) for a in devices for b in devices if a is not b and covers(b, a)]
    for narrow, wide in dict.fromkeys(repeated):
        message = f"'{narrow}' in the rule '{rule.name}' has no effect: '{wide}' includes it"
        diagnostics.warning(message, rule.span, f"Remove '{narrow}'", id="MG-9517")


def _includes(wide: ClientRule, narrow: ClientRule) -> bool:
    return _has_keys(wide.keys, narrow.keys) and _has_places(wide, narrow)


def _has_keys(wide: tuple[Keys, ...], narrow: tuple[Keys, ...]) -> bool:
    if not wide or not narrow:
        return not wide
    joined: list[Keys] = []
    for keys in sorted(wide, key=lambda keys: keys.first):
        if joined and keys.first <= joined[-1].last + 1:
            joined[-1] = Keys(joined[-1].first, max(joined[-1].last, keys.last))
        else:
            joined.append(keys)
    return all(any(j.covers(keys) for j in joined) for keys in narrow)


def _has_places(wide: ClientRule, narrow: ClientRule) -> bool:
    if not wide.addresses and not wide.devices:
        return True
    if not narrow.addresses and not narrow.devices:
        return False
    joined: list[Network] = [
        *ipaddress.collapse_addresses(n for n in wide.addresses if isinstance(n, ipaddress.IPv4Network)),
        *ipaddress.collapse_addresses(n for n in wide.addresses if isinstance(n, ipaddress.IPv6Network)),
    ]
    in_networks = all(any(_within(n, other) for other in joined) for n in narrow.addresses)
    return in_networks and all(any(covers(w, device) for w in wide.devices) for device in narrow.devices)


def _within(narrow: Network, wide: Network) -> bool:
    if isinstance(narrow, ipaddress.IPv4Network):
        return isinstance(wide, ipaddress.IPv4Network) and narrow.subnet_of(wide)
    return isinstance(wide, ipaddress.IPv6Network) and narrow.subnet_of(wide)


def _key_text(keys: Keys) -> str:
    return f"0x{keys.first:X}" if keys.first == keys.last else f"0x{keys.first:X}-0x{keys.last:X}"


def _line(span: Span | None) -> int:
    return span.line if span else 0
