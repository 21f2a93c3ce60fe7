# SPDX-License-Identifier: Apache-2.0
"""Licenses of interface packages, as their package.xml says (REP-149), in the words of SPDX."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from xml.sax.saxutils import unescape

from microros_gen.documents.files import read_text
from microros_gen.interfaces.find import PackagePlace, shipped_folder
from microros_gen.records import dataclass

OWN = "Apache-2.0"
"""The license of the tool, of what it generates, and of the interfaces that come with it."""
UNKNOWN = "NOASSERTION"
_LICENSE = re.compile(r"<license\b[^>]*>\s*([^<]*?)\s*</license>")
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_IDENTIFIERS = (
    *("0BSD", "Apache-2.0", "BSD-2-Clause", "BSD-3-Clause", "BSL-1.0", "CC-BY-4.0", "CC0-1.0", "EPL-2.0"),
    *("EUPL-1.2", "GPL-2.0-only", "GPL-2.0-or-later", "GPL-3.0-only", "GPL-3.0-or-later", "ISC"),
    *("LGPL-2.1-only", "LGPL-2.1-or-later", "LGPL-3.0-only", "LGPL-3.0-or-later", "MIT", "MIT-0"),
    *("MPL-2.0", "Unlicense", "Zlib"),
)
"""Those of the SPDX list that ROS packages have; any other one is given with its text."""
_NAMES = {
    **{name.lower(): name for name in _IDENTIFIERS},
    **dict.fromkeys(("apache license 2.0", "apache 2.0", "apache license, version 2.0"), "Apache-2.0"),
    **dict.fromkeys(("3-clause bsd license", "bsd 3-clause", "bsd-3"), "BSD-3-Clause"),
    **dict.fromkeys(("2-clause bsd license", "bsd 2-clause"), "BSD-2-Clause"),
    **dict.fromkeys(("mit license", "the mit license"), "MIT"),
}
"""Also the names that ament_copyright and older packages use."""


@dataclass(frozen=True)
class Licenses:
    """`expressions`: of each package, in SPDX. `texts`: what package.xml says where SPDX has no name, by reference."""

    expressions: Mapping[str, str]
    texts: Mapping[str, str]

    def of(self, package: str) -> str:
        """Return the license expression of an interface package."""
        return self.expressions.get(package, UNKNOWN)


def licenses_of(places: Iterable[PackagePlace]) -> Licenses:
    """Return the licenses of interface packages; one without a readable package.xml, or a license there, is unknown."""
    expressions: dict[str, str] = {}
    texts: dict[str, str] = {}
    for place in places:
        declared = (OWN,) if place.folder.resolve().parent == shipped_folder() else _declared(place)
        names = [
            _NAMES.get(text.lower()) or _reference(place.name, number) for number, text in enumerate(declared)
        ]
        expressions[place.name] = " AND ".join(dict.fromkeys(names)) or UNKNOWN
        texts |= {name: text for name, text in zip(names, declared, strict=True) if name not in _IDENTIFIERS}
    return Licenses(expressions, texts)


def joined(expressions: Iterable[str]) -> str:
    """Return the license of what consists of parts with these ones; unknown if that of a part is."""
    found = sorted({name for expression in expressions for name in expression.split(" AND ")})
    return UNKNOWN if UNKNOWN in found else " AND ".join(found)


def _declared(place: PackagePlace) -> tuple[str, ...]:
    try:
        text = read_text(place.folder / "package.xml")
    except (OSError, UnicodeDecodeError):
        return ()
    return tuple(unescape(found) for found in _LICENSE.findall(_COMMENT.sub("", text)) if found)


def _reference(package: str, number: int) -> str:
    return f"LicenseRef-{package.replace('_', '-')}-{number + 1}"
