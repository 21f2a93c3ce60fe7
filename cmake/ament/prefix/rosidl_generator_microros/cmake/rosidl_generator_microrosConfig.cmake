# SPDX-License-Identifier: Apache-2.0
# The package as the wheel installs it; in a workspace ament_package() writes this file.
if(_rosidl_generator_microros_CONFIG_INCLUDED)
  return()
endif()
set(_rosidl_generator_microros_CONFIG_INCLUDED TRUE)
set(rosidl_generator_microros_FOUND_AMENT_PACKAGE TRUE)
include("${CMAKE_CURRENT_LIST_DIR}/rosidl_generator_microros-extras.cmake")
