# SPDX-License-Identifier: Apache-2.0
"""Which files below a folder are the application's sources."""

from __future__ import annotations

from pathlib import Path

from microros_gen.migrate.code import c_sources, include_folders


def made(folder: Path, *names: str) -> list[str]:
    """Write files of these names; return those that are sources of the application."""
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text("")
    return [path.relative_to(folder).as_posix() for path in c_sources(folder)]


def test_tests_and_examples_of_libraries_are_no_part_of_the_application(tmp_path: Path) -> None:
    separate = ("lib/imu/examples/Basic/Basic.ino", "test/native/test_pid.c", "lib/imu/Tests/all.cpp")
    assert made(tmp_path, "src/main.cpp", "lib/imu/imu.cpp", *separate) == ["lib/imu/imu.cpp", "src/main.cpp"]


def test_a_copy_of_micro_ros_is_no_part_of_the_application(tmp_path: Path) -> None:
    copy = [f"libmicroros/include/{name}" for name in ("rclc/rclc.h", "rcl/rcl.h", "rcutils/x.c")]
    assert made(tmp_path, "main.c", "my.c", *copy) == ["main.c", "my.c"]


def test_what_stm32cubemx_copies_is_no_part_of_the_application(tmp_path: Path) -> None:
    vendor = [
        "Drivers/CMSIS/Core/Template/ARMv8-M/main_s.c",
        "Drivers/STM32F3xx_HAL_Driver/Src/stm32f3xx_hal.c",
        "Middlewares/Third_Party/FreeRTOS/Source/tasks.c",
    ]
    own = ["Core/Src/main.c", "Drivers/motor.c", "Middlewares/filter/filter.c"]
    assert made(tmp_path, *own, *vendor) == own


def test_a_folder_that_has_only_examples_is_read(tmp_path: Path) -> None:
    assert made(tmp_path, "examples/talker/talker.c") == ["examples/talker/talker.c"]
    assert made(tmp_path / "examples/talker") == ["talker.c"]


def test_a_compiler_finds_headers_in_other_folders(tmp_path: Path) -> None:
    made(tmp_path, "src/main.c", "include/arm/gains.h", "lib/imu/imu.h", "lib/imu/imu.c", "lib/unused/more.h")
    (tmp_path / "src/main.c").write_text(
        '#include <arm/gains.h>\n# include "imu.h"\n#include "../include/arm/gains.h"\n'
    )
    found = include_folders(tmp_path)
    assert [path.relative_to(tmp_path).as_posix() for path in found] == ["include", "lib/imu", "src"]
