# SPDX-License-Identifier: Apache-2.0
"""Whether interfaces come from the ROS 2 distribution that the application is for."""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.application.model import DISTRIBUTIONS, Application
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.find import Origin
from microros_gen.interfaces.interface_set import InterfaceSet

VARIABLE = "ROS_DISTRO"
"""What a sourced installation of ROS 2 sets to its name."""

_SHOWN = 3


def check_distribution(
    application: Application, interfaces: InterfaceSet, environ: Mapping[str, str], diagnostics: Diagnostics
) -> None:
    """Warn where packages are read from a sourced distribution that is not the one of the application.

    Types of other distributions can have other fields, and with them another hash: nodes would not be matched.
    """
    sourced = environ.get(VARIABLE, "")
    packages = sorted({i.name.package for i in interfaces if i.place.origin is Origin.AMENT})
    if not sourced or sourced == application.distro or not packages:
        return
    more = f" and {len(packages) - _SHOWN} more" if len(packages) > _SHOWN else ""
    message = (
        f"packages {', '.join(packages[:_SHOWN])}{more} come from ROS 2 {sourced} ({VARIABLE}), the application is for"
        f" {application.distro}"
    )
    hint = f"Source ROS 2 {application.distro}"
    if sourced in DISTRIBUTIONS:
        hint += f", or write `distro: {sourced}`"
    diagnostics.warning(message, application.spans.get("distro"), hint, id="MG-9243")
