# SPDX-License-Identifier: Apache-2.0
"""The package `cmake`: a project that adds it links and reaches an agent."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.package.render import describe, plan_package, render_package
from tests.support.patience import seconds

PROJECT = """\
cmake_minimum_required(VERSION 3.13)
project(mine C)
add_subdirectory(libraries/microros)
add_executable(mine main.c)
target_link_libraries(mine PRIVATE microros::microros)
"""
MAIN = """\
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <stdio.h>
int main(void)
{
  rclc_support_t support;
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_ret_t result = rclc_support_init(&support, 0, NULL, &allocator);
  printf("%d\\n", (int)result);
  return 0;
}
"""
PLAN = """\
version: 1
profiles: [pure_sender]
session: {connect_timeout: 100 ms}
"""


@pytest.mark.builds
def test_a_project_adds_it(tmp_path: Path) -> None:
    if shutil.which("cmake") is None:
        pytest.skip("no cmake")
    (tmp_path / "microros.yaml").write_text(PLAN)
    plan = plan_package(describe("cmake"), tmp_path / "microros.yaml")
    compiler.write(render_package(plan), tmp_path / "libraries" / "microros")
    (tmp_path / "CMakeLists.txt").write_text(PROJECT)
    (tmp_path / "main.c").write_text(MAIN)
    _run(
        tmp_path, "cmake", "-S", ".", "-B", "build", "-DMICROROS_EXAMPLE=ON", "-DCMAKE_C_FLAGS=-Wall -Werror"
    )
    _run(tmp_path, "cmake", "--build", "build", "-j2")
    assert (tmp_path / "build" / "libraries" / "microros" / "microros_example").is_file()
    assert _run(tmp_path, str(tmp_path / "build" / "mine")) == "2\n", "no agent: RCL_RET_TIMEOUT"


def _run(folder: Path, *call: str) -> str:
    done = subprocess.run(call, cwd=folder, capture_output=True, text=True, timeout=seconds(120), check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout
