# SPDX-License-Identifier: Apache-2.0
"""The settings of colcon.meta files → a proposed application file: each has a key, a reason why not, or a mark."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from microros_gen.application.kinds import KINDS
from microros_gen.application.model import MOST_HISTORY
from microros_gen.application.parser import LONGEST_BLOCK_MS
from microros_gen.application.session_times import LONGEST_SILENCE_MS, SHORTEST_SILENCE_MS
from microros_gen.diagnostics import nearest
from microros_gen.migrate.colcon_meta import MetaSetting
from microros_gen.migrate.draft import Draft, DraftValue, Flow, Remark, Setting, place
from microros_gen.migrate.meta_reasons import NOT_HERE_WHEN_ON, NOT_NEEDED, OF_A_BUILD, PREFIXES_OF_BUILDS
from microros_gen.migrate.profiles import profiles_of

MOST_ENTITIES = 250
_ON = ("ON", "TRUE", "YES", "Y", "1")
_TRANSPORTS = ("udp", "tcp", "serial", "custom")
_CREATION = {"bin": "binary", "refs": "reference"}
_ENTITIES = ("nodes", *(kind.key for kind in KINDS))
_QUEUE = "RMW_UXRCE_MAX_HISTORY"
# Setting → key of `pools`, least and most.
_POOLS = {
    **{f"RMW_UXRCE_MAX_{entity.upper()}": (entity, 0, MOST_ENTITIES) for entity in _ENTITIES},
    _QUEUE: ("queue", 1, MOST_ENTITIES),
    "RMW_UXRCE_MAX_WAIT_SETS": ("wait_sets", 1, MOST_ENTITIES),
    "RMW_UXRCE_MAX_GUARD_CONDITION": ("guard_conditions", 0, MOST_ENTITIES),
    "RMW_UXRCE_STREAM_HISTORY": ("history", 1, MOST_HISTORY),
    "RMW_UXRCE_STREAM_HISTORY_OUTPUT": ("history", 1, MOST_HISTORY),
    "RMW_UXRCE_STREAM_HISTORY_INPUT": ("input_history", 1, MOST_HISTORY),
}
_ENTITY_POOLS = (*tuple(f"RMW_UXRCE_MAX_{entity.upper()}" for entity in _ENTITIES), "RMW_UXRCE_MAX_HISTORY")
_NAME_LENGTHS = ("RMW_UXRCE_NODE_NAME_MAX_LENGTH", "RMW_UXRCE_TOPIC_NAME_MAX_LENGTH")
_LEAST_NAME, _MOST_NAME = 8, 256
_OTHERS = ("RMW_UXRCE_TRANSPORT", "RMW_UXRCE_CREATION_MODE", "RMW_UXRCE_PUBLISH_RELIABLE_TIMEOUT")
_OURS = ("RMW_UXRCE_", "UCLIENT_")
_HANDLED = ("RMW_UXRCE_DEFAULT_", "UCLIENT_HARD_LIVELINESS_CHECK")


def meta_draft(settings: Iterable[MetaSetting], declared: bool) -> Draft:
    """Return the proposal; of a setting that stands more than once the last one holds, as in colcon.

    `declared`: something else says which nodes there are, so the numbers of entities are not needed.
    """
    latest = {(s.package, s.name or s.value): s for s in settings}
    named = {s.name: s for s in latest.values() if s.name}
    return _Reader(named, tuple(latest.values()), declared).draft()


class _Reader:
    """Goes through the settings once; a later step looks at several of them together."""

    def __init__(
        self, named: Mapping[str, MetaSetting], settings: tuple[MetaSetting, ...], declared: bool
    ) -> None:
        self._named = named
        self._declared = declared
        self._settings = settings
        self._groups: dict[str, dict[str, DraftValue]] = {"transport": {}, "session": {}, "pools": {}}
        self._keys: dict[str, DraftValue] = {}
        self._components: list[str] = []
        self._remarks: list[Remark] = []

    def draft(self) -> Draft:
        """Return what was found."""
        self._transport()
        for setting in self._settings:
            self._take(setting)
        self._hard_liveliness()
        profiles = self._profiles()
        return Draft(
            profiles=profiles,
            components=tuple(sorted(self._components)),
            settings=self._keys,
            groups={name: values for name, values in self._groups.items() if values},
            remarks=tuple(self._remarks),
        )

    def _take(self, setting: MetaSetting) -> None:
        name = setting.name
        if self._declared and name in _ENTITY_POOLS:
            is_queue = name == _QUEUE
            self._without(
                setting, "each endpoint has its `queue`" if is_queue else "`nodes` declares the entities"
            )
        elif name in _POOLS:
            key, least, most = _POOLS[name]
            self._number("pools", key, setting, least, most)
        elif name in _NAME_LENGTHS:
            self._name_length(setting)
        elif name in NOT_HERE_WHEN_ON:
            self._without(setting, NOT_HERE_WHEN_ON[name], undecided=_is_on(setting))
        elif name == "RMW_UXRCE_CREATION_MODE":
            self._choice("entities", setting, _CREATION)
        elif name == "RMW_UXRCE_PUBLISH_RELIABLE_TIMEOUT":
            self._block(setting)
        elif name in ("UCLIENT_PROFILE_MULTITHREAD", "UCLIENT_PROFILE_DISCOVERY"):
            self._component(setting, name.removeprefix("UCLIENT_PROFILE_").lower())
        elif name.endswith("_TRANSPORT_MTU") or name == "RMW_UXRCE_TRANSPORT" or name.startswith(_HANDLED):
            return  # together with others
        elif name == "UCLIENT_PROFILE_STREAM_FRAMING" and "framing" in self._groups["transport"]:
            return
        elif name in NOT_NEEDED:
            self._without(setting, NOT_NEEDED[name])
        elif not name or name.startswith(PREFIXES_OF_BUILDS):
            self._without(setting, OF_A_BUILD)
        else:
            known = (*_POOLS, *_NAME_LENGTHS, *NOT_NEEDED, *NOT_HERE_WHEN_ON, *_OTHERS)
            hint = nearest(name, known) if name.startswith(_OURS) else None
            self._without(
                setting, f"not known here. {hint or 'Look whether it matters to you'}", undecided=True
            )

    def _transport(self) -> None:
        transport = self._groups["transport"]
        chosen = self._named.get("RMW_UXRCE_TRANSPORT")
        kind = chosen.value if chosen else ""
        if chosen and kind not in _TRANSPORTS:
            self._without(
                chosen,
                f"the transport '{kind}' is not known here: udp, tcp, serial or custom",
                undecided=True,
            )
            kind = ""
        elif chosen:
            transport["type"] = _value(kind, chosen)
        self._agent(kind or "udp")
        for other in _TRANSPORTS:
            mtu = self._named.get(f"UCLIENT_{other.upper()}_TRANSPORT_MTU")
            if mtu and other == (kind or "udp"):
                self._number("transport", "mtu", mtu, 64, 65_535)
            else:
                self._of_another_transport(mtu, kind or "udp")
        framing = self._named.get("UCLIENT_PROFILE_STREAM_FRAMING")
        if kind == "custom" and framing and not _is_on(framing):
            transport["framing"] = _value(False, framing)

    def _agent(self, kind: str) -> None:
        device = self._named.get("RMW_UXRCE_DEFAULT_SERIAL_DEVICE")
        if device and kind == "serial":
            self._groups["transport"]["device"] = _value(device.value, device)
        else:
            self._of_another_transport(device, kind)
        for other in ("udp", "tcp"):
            host = self._named.get(f"RMW_UXRCE_DEFAULT_{other.upper()}_IP")
            port = self._named.get(f"RMW_UXRCE_DEFAULT_{other.upper()}_PORT")
            first = host or port
            for setting in (host, port) if other != kind else ():
                self._of_another_transport(setting, kind)
            if first and other == kind:
                address = host.value if host else "127.0.0.1"
                shown = f"[{address}]" if ":" in address else address
                self._groups["transport"]["agent"] = _value(f"{shown}:{port.value if port else 8888}", first)

    def _of_another_transport(self, setting: MetaSetting | None, kind: str) -> None:
        if setting:
            self._without(setting, f"the transport is {kind}")

    def _name_length(self, setting: MetaSetting) -> None:
        number = self._within(setting, 1, _MOST_NAME)
        if number is None:
            return
        known = self._groups["pools"].get("name_size")
        smaller = known is None or (isinstance(known.value, int) and known.value < number)
        if smaller:
            self._groups["pools"]["name_size"] = _value(max(number, _LEAST_NAME), setting)

    def _block(self, setting: MetaSetting) -> None:
        number = self._within(setting, 0, LONGEST_BLOCK_MS)
        if number is not None:
            self._keys["on_full"] = _value(Flow(f"block {number} ms" if number else "error"), setting)

    def _component(self, setting: MetaSetting, component: str) -> None:
        if _is_on(setting):
            self._components.append(f"+{component}")
        else:
            self._without(setting, f"the component `{component}` comes in where it is asked for")

    def _hard_liveliness(self) -> None:
        check = self._named.get("UCLIENT_HARD_LIVELINESS_CHECK")
        timeout = self._named.get("UCLIENT_HARD_LIVELINESS_CHECK_TIMEOUT")
        if check and _is_on(check):
            number = self._within(timeout, SHORTEST_SILENCE_MS, LONGEST_SILENCE_MS) if timeout else 10_000
            if number is not None:
                self._groups["session"]["hard_liveliness"] = _value(Flow(f"{number} ms"), timeout or check)
        for setting in (check, timeout) if not (check and _is_on(check)) else ():
            if setting:
                self._without(
                    setting, "without `session.hard_liveliness` the agent decides when a client is gone"
                )

    def _choice(self, key: str, setting: MetaSetting, values: Mapping[str, str]) -> None:
        if setting.value in values:
            self._keys[key] = _value(values[setting.value], setting)
        else:
            self._without(setting, f"'{setting.value}' is not one of {', '.join(values)}", undecided=True)

    def _profiles(self) -> tuple[str, ...]:
        pools = self._groups["pools"]
        does = [kind for kind in KINDS if kind.key in pools and pools[kind.key].value]
        profiles = profiles_of({kind.name for kind in does})
        self._components += sorted(
            {f"+{kind.component}" for kind in does if kind.component not in profiles.components}
        )
        return profiles.names

    def _number(self, group: str, key: str, setting: MetaSetting, least: int, most: int) -> None:
        number = self._within(setting, least, most)
        if number is not None:
            self._groups[group][key] = _value(number, setting)

    def _within(self, setting: MetaSetting, least: int, most: int) -> int | None:
        """Return the whole number of a setting; None and a remark where it is none, or out of range here."""
        if not re.fullmatch(r"-?[0-9]{1,18}", setting.value):
            self._without(setting, f"'{setting.value}' is not a whole number", undecided=True)
        elif not least <= int(setting.value) <= most:
            self._without(setting, f"here it can be {least} to {most}", undecided=True)
        else:
            return int(setting.value)
        return None

    def _without(self, setting: MetaSetting, reason: str, *, undecided: bool = False) -> None:
        self._remarks.append(Remark(f"{setting}: {reason}", setting.span, undecided))


def _value(value: Setting, setting: MetaSetting) -> DraftValue:
    return DraftValue(value, f"{setting.name} ({place(setting.span)})")


def _is_on(setting: MetaSetting) -> bool:
    return setting.value.upper() in _ON
