# SPDX-License-Identifier: Apache-2.0
find_package(ament_cmake_core QUIET REQUIRED)

ament_register_extension(
  "rosidl_generate_idl_interfaces"
  "rosidl_generator_microros"
  "rosidl_generator_microros_generate_interfaces.cmake")
