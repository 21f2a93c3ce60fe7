# SPDX-License-Identifier: Apache-2.0
# The package as the wheel installs it; in a workspace ament_package() writes this file.
if(_ament_cmake_microros_CONFIG_INCLUDED)
  return()
endif()
set(_ament_cmake_microros_CONFIG_INCLUDED TRUE)
set(ament_cmake_microros_FOUND_AMENT_PACKAGE TRUE)
include("${CMAKE_CURRENT_LIST_DIR}/ament_cmake_microros-extras.cmake")
