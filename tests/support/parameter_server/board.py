# SPDX-License-Identifier: Apache-2.0
"""A board in Python: the device's side of the contract of docs/howto/parameter_server.md, with a made clock."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from microros_gen.parameter_server.declared import Declared
from microros_gen.parameter_server.exchange import (
    ACKNOWLEDGE,
    BEGIN,
    LIST_CHANGES,
    OK,
    OLD,
    OTHER_BOARD,
    OTHER_SESSION,
    SET,
)
from microros_gen.parameter_server.node import CHANGED, DECLARED, DELETED, UNCHANGED
from microros_gen.parameter_server.values import NOTHING, ParameterValue, value_of

Value = dict[str, Any]
GAIN = Declared("gain", 3, "How strong.", range=(0.0, 10.0, 0.0))
COUNT = Declared("count", 2, range=(0, 100, 5))
NAME = Declared("name", 4, size_max=8)
FIXED = Declared("fixed", 1, read_only=True)
DEFAULTS: Mapping[Declared, ParameterValue] = {
    GAIN: ParameterValue(3, 1.0),
    COUNT: ParameterValue(2, 10),
    NAME: ParameterValue(4, "arm"),
    FIXED: ParameterValue(1, True),
}


@dataclass
class Place:
    """A parameter of the board."""

    declared: Declared
    value: ParameterValue
    change: int = DECLARED
    revision: int = 0
    changed_s: float = 0.0


class Board:
    """It may lose its power; `page` parameters fit a response."""

    def __init__(
        self,
        clock: Callable[[], float],
        key: int = 0xA1,
        defaults: Mapping[Declared, ParameterValue] = DEFAULTS,
        page: int = 2,
    ) -> None:
        self.key, self.page, self.defaults, self._clock = key, page, defaults, clock
        self.veto: Callable[[str, ParameterValue], bool] = lambda name, value: False
        self.sets = 0
        self.overruled: list[str] = []
        self.start()

    def start(self) -> None:
        """Begin with the defaults."""
        self.places = {d.name: Place(d, value) for d, value in self.defaults.items()}
        self.session = self.number = self.revision = 0

    def set(self, name: str, value: Any) -> None:
        """Let the program set a value."""
        place = self.places[name]
        self.revision = (self.revision + 1) % (1 << 32)
        place.value = ParameterValue(place.declared.type, value)
        place.change, place.revision, place.changed_s = CHANGED, self.revision, self._clock()

    def delete(self, name: str) -> None:
        """Let the program delete a parameter."""
        self.set(name, self.places[name].value.value)
        self.places[name].change = DELETED

    def value(self, name: str) -> Any:
        """Return a value."""
        return self.places[name].value.value

    @property
    def values(self) -> Value:
        """Return all values."""
        return {name: place.value.value for name, place in self.places.items()}

    @property
    def has_news(self) -> bool:
        """Return whether a notice is due."""
        return self.session == 0 or any(p.change in (CHANGED, DELETED) for p in self.places.values())

    def notice(self, node: str = "/arm") -> Value:
        """Return what it publishes."""
        return {"node": node, "board": self.key, "session": self.session, "revision": self.revision}

    def answer(self, request: Value) -> Value:
        """Return the response to a request of the server."""
        status = self._status(request)
        response: Value = {
            "status": status,
            "board": self.key,
            "number": request["number"],
            "revision": self.revision,
            "request_size": 400,
            "parameters": [],
        }
        if status != OK:
            return response
        self.session, self.number = request["session"], request["number"]
        what = request["what"]
        if what == ACKNOWLEDGE:
            self._acknowledge(request["revision"])
        elif what == SET:
            response.update(self._set(request["parameters"]))
        else:
            response.update(self._page(request.get("first", 0), what == LIST_CHANGES))
        return response

    def _status(self, request: Value) -> int:
        if request["board"] != self.key:
            return OTHER_BOARD
        if request["what"] == BEGIN:
            return OK
        if request["session"] != self.session:
            return OTHER_SESSION
        return OK if request["number"] > self.number else OLD

    def _page(self, first: int, changes: bool) -> Value:
        every = [p for p in self.places.values() if not changes or p.change in (CHANGED, DELETED)]
        items = [self._item(place) for place in every[first : first + self.page]]
        return {"parameters": items, "total": len(every), "next": min(len(every), first + self.page)}

    def _item(self, place: Place) -> Value:
        age = int((self._clock() - place.changed_s) * 1000)
        return {
            "descriptor": {
                "integer_range": [],
                "floating_point_range": [],
                **place.declared.descriptor(),
            },
            "value": place.value.message() if place.change != DELETED else NOTHING.message(),
            "integers": [],
            "doubles": [],
            "strings": list(place.declared.one_of),
            "size_max": place.declared.size_max,
            "change": place.change,
            "age": min(age, 2**32 - 1),
        }

    def _acknowledge(self, revision: int) -> None:
        for name, place in list(self.places.items()):
            if place.change == DECLARED:
                place.change = UNCHANGED
            elif place.change != UNCHANGED and (revision - place.revision) % (1 << 32) < 1 << 31:
                if place.change == DELETED:
                    del self.places[name]
                place.change = UNCHANGED

    def _set(self, parameters: list[Value]) -> Value:
        wanted = [(p["name"], value_of(p["value"])) for p in parameters]
        for name, value in wanted:
            if name not in self.places:
                reason = f"parameter '{name}' cannot be set because it was not declared"
                return {"successful": False, "reason": reason}
            reason = self.places[name].declared.refusal_of_request(value)
            reason = reason or ("rejected by the callback" if self.veto(name, value) else "")
            if reason:
                return {"successful": False, "reason": reason}
        for name, value in wanted:
            if self.places[name].change == CHANGED:
                self.overruled.append(name)
            self.places[name].value, self.places[name].change = value, UNCHANGED
            self.sets += 1
        return {"successful": True, "reason": ""}
