# SPDX-License-Identifier: Apache-2.0
"""How long the lock is held: the longest path from each place that takes it to where it is released, in instructions.

A function is looked at for each depth of the lock with which it is called, since the lock may be taken again by its
holder. A path ends where the depth becomes 0, in whichever function that is, as in one that releases the lock to wait.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import field, replace

from microros_gen.image.flow import Flow, Step
from microros_gen.image.paths import NOTHING, Length, longer, longest
from microros_gen.image.shares import HOLD
from microros_gen.records import dataclass

TAKE, RELEASE = "port_lock", "port_unlock"
"""The functions of the port (microros/port.h)."""
DEEPEST = 8
"""How often its holder takes the lock, at most; more is no bound."""

Key = tuple[int, int, int | None]
"""A function, the depth of the lock with which it is called, and the bytes that it is told to handle."""
Place = tuple[int, int]
"""An instruction, and the depth of the lock before it."""


@dataclass(frozen=True)
class Hold:
    """The lock is taken by the call at `address` in `function`, or below it, and held for `length`."""

    function: str
    address: int
    length: Length


@dataclass(frozen=True)
class Rules:
    """What the code does not say.

    `rounds`: the most rounds of a loop: by its function, where it is entered, its places, and the bytes that the
    function is told to handle (None: nobody knows). `through`: where the call through a register at an address goes;
    None: nobody knows. `bytes`: those that a call is told to handle at most, by what its function is told; None: nobody
    knows. `of_port`: what counts for a function of the port, by its name and what was found.
    `zero`: functions that return zero at each call.
    `calls`: in how many rounds of its loop a call is reached at most; None: in all of them. `anywhere`: functions whose
    loops may be entered in several places, as each way round is one of `rounds`. `of_call`: the length of
    a call, by its caller, what it calls, and what was found of that. `size`: the most bytes of a message.
    """

    rounds: Callable[[Flow, int, frozenset[int], int | None], Length]
    through: Callable[[int], frozenset[int] | None]
    bytes: Callable[[Flow, Step, int | None], int | None]
    of_port: Callable[[str, Length], Length]
    zero: frozenset[int] = frozenset()
    calls: Callable[[Flow, Step], int | None] = lambda flow, step: None
    anywhere: Callable[[Flow], bool] = lambda flow: False
    of_call: Callable[[Flow, Step, int, Length], Length] = lambda flow, step, to, length: length
    size: int = 0


@dataclass
class _Summary:
    """A function called with the lock at some depth. By the depth in which it ends: `ends`, the longest path that keeps
    the lock from its begin; `taken`, from where it takes the lock. `released`: up to where it releases it. `unseen`:
    where nobody knows what it calls without the lock, and what is called may take it."""

    ends: dict[int, Length] = field(default_factory=dict)
    taken: dict[int, Length] = field(default_factory=dict)
    released: Length | None = None
    depths: set[int] = field(default_factory=set)
    unseen: frozenset[str] = frozenset()


class Holds:
    """The holds of an image; what was looked at is kept."""

    def __init__(self, flows: Mapping[int, Flow], names: Mapping[int, str], rules: Rules) -> None:
        """Take functions by address, and the names of all, those without code included."""
        self._flows, self._names, self._rules = flows, names, rules
        self._known: dict[Key, _Summary] = {}
        self._holds: dict[Key, list[Hold]] = {}
        self._called: dict[Key, set[Key]] = {}
        self._open: set[Key] = set()

    def below(self, address: int) -> tuple[Hold, ...]:
        """Return the holds of the function at `address` and all that it calls, the longest first."""
        start: Key = (address, 0, None)
        self._summary(*start)
        seen, waiting = {start}, [start]
        while waiting:
            for key in self._called.get(waiting.pop(), ()):
                if key not in seen:
                    seen.add(key)
                    waiting.append(key)
        found: dict[tuple[str, int], Length] = {}
        for hold in (hold for key in seen for hold in self._holds.get(key, ())):
            place = (hold.function, hold.address)
            found[place] = longer(found.get(place), hold.length)
        holds = (Hold(name, at, length) for (name, at), length in found.items())
        return tuple(sorted(holds, key=lambda hold: (-hold.length.count, hold.function, hold.address)))

    def called(self, address: int) -> Length | None:
        """Return the longest path of the function at `address`, called with the lock; None: it never returns."""
        found = self._summary(address, 1, None).ends.get(1)
        return found.within(HOLD) if found is not None else None

    def unseen(self, address: int) -> frozenset[str]:
        """Return why the function at `address` may have further holds: calls without the lock that nobody knows."""
        return self._summary(address, 0, None).unseen

    def _summary(self, address: int, depth: int, size: int | None) -> _Summary:
        key = (address, depth, size)
        if key in self._known:
            return self._known[key]
        name = self._names.get(address, f"{address:#x}")
        flow = self._flows.get(address)
        why = ""
        if key in self._open:
            why = f"{name}: recursion"
        elif flow is not None and "@plt" in flow.name:
            why = f"{name.partition('@')[0]}: in a shared library, whose code is not in the image"
        elif flow is None or not flow.steps:
            why = f"{name}: its code is not in the image"
        elif depth > DEEPEST:
            why = f"{name}: takes the lock more than {DEEPEST} times"
        if why or flow is None:
            return self._closed(name, depth, Length(0, frozenset({why})))
        self._open.add(key)
        found = _Walk(self, flow, key).summary()
        self._open.discard(key)
        found = _within(found, name.partition(".")[0])
        if name.startswith("port_") and depth in found.ends:
            found.ends[depth] = self._rules.of_port(name, found.ends[depth])
        if name.startswith("port_"):
            found.unseen = frozenset()  # what is below all layers calls none that takes the lock
        self._known[key] = found
        return found

    def _closed(self, name: str, depth: int, length: Length) -> _Summary:
        if name.startswith("port_"):
            length = self._rules.of_port(name, length)
        return _Summary({depth: length} if depth else {}, depths={depth})

    def call(self, caller: Key, flow: Flow, step: Step, depth: int) -> _Summary:
        """Return what a step calls, with the lock at `depth`."""
        if step.call is None and not step.through:
            return _Summary({depth: NOTHING} if depth else {}, depths={depth})
        if step.through:
            targets = self._rules.through(step.address)
            if targets is None:
                why = f"{flow.name}: a call through a pointer at {step.address:#x}"
                found = self._closed("", depth, Length(0, frozenset({why})))
                found.unseen = frozenset() if depth else frozenset({why})
                return found
            joined = [self._called_at(caller, flow, step, to, depth) for to in sorted(targets)]
            return _join(joined) if joined else _Summary({depth: NOTHING} if depth else {}, depths={depth})
        assert step.call is not None
        return self._called_at(caller, flow, step, step.call, depth)

    def _called_at(self, caller: Key, flow: Flow, step: Step, to: int, depth: int) -> _Summary:
        name = self._names.get(to, "")
        if name == TAKE:
            after = depth + 1
            return _Summary({after: NOTHING} if depth else {}, {} if depth else {1: NOTHING}, depths={after})
        if name == RELEASE:
            after = max(depth - 1, 0)
            return _Summary(
                {after: NOTHING} if after else {}, released=NOTHING if depth == 1 else None, depths={after}
            )
        key = (to, depth, self._rules.bytes(flow, step, caller[2]))
        self._called.setdefault(caller, set()).add(key)
        found = self._summary(*key)
        if not found.ends:
            return found
        ends = {after: self._rules.of_call(flow, step, to, length) for after, length in found.ends.items()}
        return replace(found, ends=ends)

    @property
    def visited(self) -> frozenset[int]:
        """The functions that were looked at."""
        return frozenset(address for address, _, _ in self._known)

    def keep(self, key: Key, hold: Hold) -> None:
        """Keep a hold that ends in the function of `key`, or below it."""
        self._holds.setdefault(key, []).append(replace(hold, length=hold.length.within(HOLD)))

    @property
    def rules(self) -> Rules:
        """What the code does not say."""
        return self._rules


def _within(found: _Summary, function: str) -> _Summary:
    """Return what a caller has to know of a call of `function`: what has a total in each call of it counts as that."""
    return replace(
        found,
        ends={depth: length.within(function) for depth, length in found.ends.items()},
        taken={depth: length.within(function) for depth, length in found.taken.items()},
        released=found.released.within(function) if found.released is not None else None,
    )


def _join(parts: list[_Summary]) -> _Summary:
    joined = _Summary()
    for part in parts:
        for depth, length in part.ends.items():
            joined.ends[depth] = longer(joined.ends.get(depth), length)
        for depth, length in part.taken.items():
            joined.taken[depth] = longer(joined.taken.get(depth), length)
        if part.released is not None:
            joined.released = longer(joined.released, part.released)
        joined.unseen |= part.unseen
        joined.depths |= part.depths
    return joined


class _Walk:
    """One function with the lock at one depth: the graph of its places that hold the lock, and what begins there."""

    def __init__(self, holds: Holds, flow: Flow, key: Key) -> None:
        self._holds, self._flow, self._key = holds, flow, key
        self._edges: dict[Place, dict[Place, Length]] = {}
        self._ends: dict[Place, dict[int, Length]] = {}
        self._releases: dict[Place, Length] = {}
        self._begins: dict[int, dict[Place, Length]] = {}
        self._found = _Summary()

    def summary(self) -> _Summary:
        """Return what a caller has to know, and keep the holds that end here."""
        first = (self._flow.address, self._key[1])
        seen, waiting = {first}, [first]
        while waiting:
            for place in self._follow(*waiting.pop()):
                if place not in seen:
                    seen.add(place)
                    waiting.append(place)
        if self._key[1]:
            self._found.released, self._found.ends = self._measure({first: NOTHING})
        for address, begins in sorted(self._begins.items()):
            released, ends = self._measure(begins)
            if released is not None:
                own = released.within(self._flow.name.partition(".")[0])
                self._holds.keep(self._key, Hold(self._flow.name, address, own))
            for depth, length in ends.items():
                self._found.taken[depth] = longer(self._found.taken.get(depth), length)
        return self._found

    def _follow(self, address: int, depth: int) -> Iterator[Place]:
        step = self._flow.steps[address]
        called = self._holds.call(self._key, self._flow, step, depth)
        here, following = (address, depth), step.next
        if step.tested in self._holds.rules.zero:
            following = step.next[:1]
        lost = Length(1, frozenset({f"{self._flow.name}: a jump at {address:#x}"} if step.lost else ()))
        self._found.unseen |= called.unseen if depth else called.unseen | lost.open
        if called.released is not None:
            self._releases[here] = called.released
        for after, length in called.ends.items():
            for to in following:
                edges = self._edges.setdefault(here, {})
                edges[(to, after)] = longer(edges.get((to, after)), lost + length)
            if step.returns or step.lost:
                self._ends.setdefault(here, {})[after] = lost + length
        for after, length in called.taken.items():
            for to in following:
                begins = self._begins.setdefault(address, {})
                begins[(to, after)] = longer(begins.get((to, after)), length)
            if step.returns:
                self._found.taken[after] = longer(self._found.taken.get(after), length)
        for after in called.depths:
            if step.returns:
                self._found.depths.add(after)
            yield from ((to, after) for to in following)

    def _measure(self, begins: Mapping[Place, Length]) -> tuple[Length | None, dict[int, Length]]:
        """Return the longest paths from `begins` to where the lock is released, and to each end."""
        rules = self._holds.rules
        reached = longest(
            self._edges, begins, self._rounds, self._limit, lambda _: rules.anywhere(self._flow), rules.size
        )
        released: Length | None = None
        ends: dict[int, Length] = {}
        for place, length in reached.items():
            if place in self._releases:
                released = longer(released, length + Length(1) + self._releases[place])
            for depth, more in self._ends.get(place, {}).items():
                ends[depth] = longer(ends.get(depth), length + more)
        return released, ends

    def _limit(self, place: Place) -> int | None:
        step = self._flow.steps[place[0]]
        return None if step.call is None else self._holds.rules.calls(self._flow, step)

    def _rounds(self, head: Place, part: frozenset[Place]) -> Length:
        return self._holds.rules.rounds(self._flow, head[0], frozenset(at for at, _ in part), self._key[2])
