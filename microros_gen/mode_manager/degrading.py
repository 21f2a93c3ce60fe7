# SPDX-License-Identifier: Apache-2.0
"""Which rules have led systems to their targets, how often, and which one is undone."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from microros_gen.mode_manager.settings import Settings
from microros_gen.modes.manager import rule_of
from microros_gen.modes.model import Model, Part, Reported, Rule, Status
from microros_gen.modes.recovery import History, extended, recovery_of


class Degrading:
    """`rules`: the rule that was applied last to a system; `oscillating`: systems whose rules are not applied now."""

    def __init__(self, model: Model, settings: Settings, log: Callable[[str], object]) -> None:
        """`log` gets a line about each rule."""
        self.rules: dict[str, str] = {}
        self.oscillating: set[str] = set()
        self._model = model
        self._settings = settings
        self._log = log
        self._applied: dict[str, int] = {}
        self._resting: dict[str, float] = {}
        self._histories: dict[str, History] = {}
        self._causes: dict[tuple[str, str], str] = {}
        self._recovered: dict[str, list[float]] = {}

    def next(
        self,
        system: Part,
        target: Status | None,
        statuses: Mapping[str, Status],
        reported: Reported,
        now: float,
    ) -> Status | None:
        """Return the next target of a system that is at rest; None: it stays. `reported` is of /diagnostics."""
        rule = rule_of(system, target, statuses, reported)
        history = self._histories.get(system.name, ())
        rests_since = self._resting.setdefault(system.name, now)
        if now - rests_since >= self._settings.rest_s:
            self._applied.pop(system.name, None)  # rules that oscillate leave no time in between
        if rule is None:
            undone = recovery_of(history, statuses, reported)
            return None if undone is None else self._recover(system, undone, history, now)
        self._resting.pop(system.name)
        self._applied[system.name] = self._applied.get(system.name, 0) + 1
        if self._applied[system.name] > 2 * len(self._model.targets(system)):
            self.oscillating.add(system.name)
            self._log(f"{system.name}: its rules oscillate, and are not applied until the next request")
            return None
        cause = rule.cause(reported)
        self._log(f"{system.name}: rule {rule.name}: {rule.new_target}{f' ({cause})' if cause else ''}")
        self.rules[system.name] = rule.name
        self._causes[system.name, rule.name] = cause
        self._histories[system.name] = extended(history, rule)
        return rule.new_target

    def cause(self, system: str) -> str:
        """Return the status for which the last rule of a system was applied, as RuleDiagnostics.first; empty: none."""
        return self._causes.get((system, self.rules.get(system, "")), "")

    def command(self, system: str) -> None:
        """Note that a system is commanded from above, or requested."""
        self._histories.pop(system, None)

    def change(self) -> None:
        """Note that something has changed from outside, so that rules may be applied again."""
        self._applied.clear()

    def request(self) -> None:
        """Note a request: rules begin again."""
        self._applied.clear()
        self._recovered.clear()
        self.rules.clear()
        self.oscillating.clear()

    def _recover(self, system: Part, rule: Rule, history: History, now: float) -> Status | None:
        since = now - self._settings.recover_s
        times = [time for time in self._recovered.get(system.name, []) if time > since]
        if len(times) >= self._settings.attempts:
            self._histories.pop(system.name)
            self._log(f"{system.name}: it recovered again and again, and stays so until the next request")
            return None
        self._recovered[system.name] = [*times, now]
        self._applied.pop(system.name, None)
        self._log(f"{system.name}: rule {rule.name} is over: {rule.if_target}")
        self._histories[system.name] = history[:-1]
        if history[:-1]:
            self.rules[system.name] = history[-2].name
        else:
            self.rules.pop(system.name, None)
        return rule.if_target
