# SPDX-License-Identifier: Apache-2.0
"""What sources call: the component that it selects, or what of it this version does not have, and where it stands."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping

from microros_gen.migrate.c_program import Call
from microros_gen.migrate.draft import Remark
from microros_gen.selection.component import NOT_READY, Catalogue

_KNOWN_BUT_NOT_DECLARED = ("rosidl_runtime_c__", "rmw_uros_set_custom_transport")
_UNKNOWN = "is not in this version"
_HINT = "Remove the call and what belongs to it"


def selected_by(
    function: str, declared: Mapping[str, str], catalogue: Catalogue, texts: Collection[str] = ()
) -> tuple[str, ...]:
    """Return what a call selects: the component that declares the function and those that list its very name in
    `calls`, else those that list it there in any way.

    `declared` says which component declares a function; `texts` are the strings among the arguments. Of the names under
    which it is listed, the longest counts.
    """
    if function in declared:
        named = {c.name for c in catalogue.values() for call in c.presence.calls if call.name == function}
        return tuple(sorted(named | {declared[function]}))
    listed = [
        (len(call.name), component.name)
        for component in catalogue.values()
        for call in component.presence.calls
        if call.matches(function, texts)
    ]
    longest, _ = max(listed, default=(0, ""))
    return tuple(sorted(component for length, component in listed if length == longest))


def find_missing(
    called: Iterable[Call], selected: Mapping[str, tuple[str, ...]], catalogue: Catalogue
) -> list[Remark]:
    """Return a remark for each component, or function of none, that is called and not there: its first call.

    `selected` says which components a function selects.
    """
    first: dict[str, Remark] = {}
    for call in called:
        names = selected.get(call.name, ())
        planned = next((name for name in names if not catalogue[name].ready), "")
        if (names and not planned) or call.name.startswith(_KNOWN_BUT_NOT_DECLARED):
            continue
        what = f"needs the component '{planned}', which {NOT_READY}" if planned else _UNKNOWN
        remark = Remark(f"{call.name} {what}", call.span, refused=_HINT)
        first.setdefault(planned or call.name, remark)
    return list(first.values())
