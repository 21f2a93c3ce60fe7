# SPDX-License-Identifier: Apache-2.0
"""The page about migration says where users of each public repository of micro-ROS find the same thing."""

from __future__ import annotations

import re

from tests.support.paths import ROOT

PUBLIC = """
    docker freertos_apps micro-ROS-Agent micro-ROS-demos micro_ros_arduino micro_ros_azure_rtos_app
    micro_ros_diagnostics micro_ros_espidf_component micro_ros_mbed micro_ros_nuttx_app micro_ros_platformio
    micro_ros_raspberrypi_pico micro_ros_raspberrypi_pico_sdk micro_ros_renesas2estudio_component
    micro_ros_renesas_demos micro_ros_rtthread_component micro_ros_setup micro_ros_stm32cubemx_utils
    micro_ros_tivac_launchpad_app micro_ros_utilities micro_ros_vitis_component micro_ros_zephyr_module nuttx_apps
    raspbian_apps rmw_embeddedrtps rmw_microxrcedds rosidl_typesupport_microxrcedds system_modes zephyr_apps
"""
"""Those of the organization on 2026-11-27, without robots, benchmarks, forks of kernels, a test bench and the page."""


def test_each_public_repository_has_a_row() -> None:
    text = (ROOT / "docs" / "howto" / "migrate.md").read_text(encoding="utf-8")
    (section,) = re.findall(r"^## Coming from a public repository\n(.*?)^## ", text, re.MULTILINE | re.DOTALL)
    firsts = [line.split("|")[1] for line in section.splitlines() if line.startswith("|")]
    named = {word for first in firsts for word in re.findall(r"[\w-]+", first)}
    assert set(PUBLIC.split()) - named == set()
