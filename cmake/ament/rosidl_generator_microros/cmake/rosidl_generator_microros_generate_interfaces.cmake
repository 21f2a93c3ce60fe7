# SPDX-License-Identifier: Apache-2.0
# Extension of rosidl_generate_interfaces(): the XRCE type support of the package as the static library
# <target>__rosidl_generator_microros, with all that it needs, for tests and tools on the machine that builds. The ament
# index names it below "rosidl_generator_microros"; ament_microros_link_type_support() links it.
option(ROSIDL_GENERATOR_MICROROS "Generate XRCE type support" ON)
set(ROSIDL_GENERATOR_MICROROS_STRING 64 CACHE STRING "XRCE type support: bytes of a string that has no bound")
set(ROSIDL_GENERATOR_MICROROS_SEQUENCE 16 CACHE STRING "XRCE type support: elements of a sequence that has no bound")
if(NOT ROSIDL_GENERATOR_MICROROS OR CMAKE_SYSTEM_NAME STREQUAL "Generic")
  return() # the second: this workspace is for a board, whose firmware has its type support in its own library
endif()

find_package(ament_cmake_microros REQUIRED)

set(_microros_suffix "__rosidl_generator_microros")
set(_microros_target "${rosidl_generate_interfaces_TARGET}${_microros_suffix}")
set(_microros_folder "${CMAKE_CURRENT_BINARY_DIR}/rosidl_generator_microros")

# The package as rosidl has adapted it, and its dependencies where CMake has found them.
set(_microros_interfaces "")
foreach(_microros_tuple ${rosidl_generate_interfaces_IDL_TUPLES})
  string(REGEX REPLACE "^.*:([^:]*)$" "\\1" _microros_name "${_microros_tuple}")
  string(REGEX REPLACE ":([^:]*)$" "/\\1" _microros_file "${_microros_tuple}")
  configure_file("${_microros_file}" "${_microros_folder}/interfaces/${PROJECT_NAME}/${_microros_name}" COPYONLY)
  string(REGEX REPLACE "[.]idl$" "" _microros_name "${_microros_name}")
  list(APPEND _microros_interfaces "${PROJECT_NAME}/${_microros_name}")
endforeach()
set(_microros_paths "${_microros_folder}/interfaces")
foreach(_microros_name ${rosidl_generate_interfaces_DEPENDENCY_PACKAGE_NAMES})
  get_filename_component(_microros_file "${${_microros_name}_DIR}/.." ABSOLUTE)
  list(APPEND _microros_paths "${_microros_file}")
endforeach()

string(REPLACE ";" ", " _microros_interfaces "${_microros_interfaces}")
configure_file("${rosidl_generator_microros_DIR}/interfaces.yaml.in" "${_microros_folder}/microros.yaml" @ONLY)
microros_add_library(${_microros_target} CONFIG "${_microros_folder}/microros.yaml"
  INTERFACE_PATHS ${_microros_paths} OUTPUT "${_microros_folder}/generated")
set_target_properties(${_microros_target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
add_dependencies(${rosidl_generate_interfaces_TARGET} ${_microros_target})

# Not by ament_export_targets(): what uses the package in ROS would link it and find its headers in place of ROS's own.
if(NOT rosidl_generate_interfaces_SKIP_INSTALL)
  _ament_microros_install(${_microros_target})
  install(EXPORT "export_${_microros_target}" NAMESPACE "${PROJECT_NAME}::" DESTINATION "share/${PROJECT_NAME}/cmake"
    FILE "${_microros_target}.cmake")
  ament_index_register_resource("rosidl_generator_microros" CONTENT "${_microros_target}")
endif()
