# SPDX-License-Identifier: Apache-2.0
# microros_add_library(<target>
#   [CONFIG <microros.yaml>]       application file; the one in this folder where there is one
#   [PROFILES <name or file>…]     replaces `profiles` of the file
#   [COMPONENTS <[+-]name>…]       add to `components` of the file
#   [INTERFACES <pkg[/Type]>…]     add to those of the file
#   [INTERFACE_PATHS <folder>…]    searched before AMENT_PREFIX_PATH, pip and what ships with the tool
#   [TARGET <name or file>]        what it is compiled for; replaces `target` of the file. Where neither says it, and this
#                                  project compiles for a board: the target that CMAKE_SYSTEM_PROCESSOR names
#   [AGENT <host:port[,host:port...] or device>]  replaces the agent of the file
#   [OUTPUT <folder>])             of the generated sources; default: <target>-microros in the build folder
#
# Adds the static library <target>, compiled by this project's tool chain; what links to it gets its include folder.
# The sources are generated when CMake configures. A change of anything that they were made from, the tool among it,
# configures again, and an unchanged file keeps its time; so only what depends on the change is compiled.
#
# Paths are relative to the current source folder, OUTPUT to the current binary folder.

function(microros_add_library target)
  set(single CONFIG TARGET AGENT OUTPUT)
  set(multiple PROFILES COMPONENTS INTERFACES INTERFACE_PATHS)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "${single}" "${multiple}")
  if(arg_UNPARSED_ARGUMENTS)
    list(GET arg_UNPARSED_ARGUMENTS 0 unknown)
    string(REPLACE ";" ", " known "${single};${multiple}")
    message(FATAL_ERROR "microros_add_library(${target}): '${unknown}' is not one of its arguments. Available: ${known}")
  endif()
  if(TARGET "${target}")
    message(FATAL_ERROR "microros_add_library(${target}): there is a target of this name already")
  endif()
  if(NOT arg_CONFIG AND EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/microros.yaml")
    set(arg_CONFIG microros.yaml)
  endif()
  if(NOT arg_OUTPUT)
    set(arg_OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/${target}-microros")
  endif()
  get_filename_component(output "${arg_OUTPUT}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_BINARY_DIR}")
  set(build "${CMAKE_CURRENT_BINARY_DIR}/${target}-microros-build")

  set(options)
  _microros_append_options(options --config FILE ${arg_CONFIG})
  _microros_append_options(options --profile FILE ${arg_PROFILES})
  _microros_append_options(options --component NAME ${arg_COMPONENTS})
  _microros_append_options(options --interface NAME ${arg_INTERFACES})
  _microros_append_options(options --interface-path FOLDER ${arg_INTERFACE_PATHS})
  _microros_append_options(options --target FILE ${arg_TARGET})
  _microros_append_options(options --agent NAME ${arg_AGENT})
  if(NOT arg_TARGET AND CMAKE_SYSTEM_NAME STREQUAL "Generic") # tool-chain files of `microros-gen targets` name their target
    list(APPEND options --default-target "${CMAKE_SYSTEM_PROCESSOR}")
  endif()
  _microros_generate("${target}" "${output}" "${build}/generated.d" ${options})
  _microros_check_tool_chain("${target}" "${output}")

  set(MICROROS_LIBRARY "${target}")
  set(MICROROS_ARGUMENTS "${options}")
  set(MICROROS_EXAMPLE OFF)
  add_subdirectory("${output}" "${build}")
  set_target_properties("${target}" PROPERTIES MICROROS_OUTPUT "${output}")
endfunction()

# Appends to the list `result` the option and a value, for each value: a FOLDER, a FILE or the NAME of something. Paths
# become absolute, so that diagnostics can be followed from anywhere; a FILE that does not exist may be a name.
function(_microros_append_options result option kind)
  set(all ${${result}})
  foreach(value IN LISTS ARGN)
    get_filename_component(path "${value}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
    if(kind STREQUAL "FOLDER" OR (kind STREQUAL "FILE" AND EXISTS "${path}" AND NOT IS_DIRECTORY "${path}"))
      set(value "${path}")
    endif()
    list(APPEND all "${option}" "${value}")
  endforeach()
  set(${result} "${all}" PARENT_SCOPE)
endfunction()

# Runs `microros-gen generate` for `target`; its diagnostics go where CMake's go, and a failure ends the configuration.
function(_microros_generate target output depfile)
  get_property(command GLOBAL PROPERTY MICROROS_GEN_COMMAND)
  if(NOT "$ENV{AMENT_PREFIX_PATH}" STREQUAL "") # a build configures again in shells where nothing is sourced
    set(MICROROS_AMENT_PREFIX_PATH "$ENV{AMENT_PREFIX_PATH}" CACHE INTERNAL "AMENT_PREFIX_PATH when CMake configured")
  endif()
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -E env "AMENT_PREFIX_PATH=${MICROROS_AMENT_PREFIX_PATH}"
      ${command} generate ${ARGN} --output "${output}" --depfile "${depfile}"
    WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" OUTPUT_VARIABLE said RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "microros-gen refused the library '${target}' (status ${status}); what it said is above")
  endif()
  string(REGEX REPLACE "\n$" "" said "${said}")
  string(REPLACE "\n" "\n--   " said "${said}")
  message(STATUS "${target}:\n--   ${said}")
  _microros_read_depfile("${depfile}" inputs)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${inputs} "${output}/manifest.json")
endfunction()

# Sets `result` to what the depfile says something was made from: one path a line, escaped as in a Makefile.
function(_microros_read_depfile depfile result)
  file(READ "${depfile}" text)
  string(REGEX REPLACE "^[^\n]*\n  (.*)\n$" "\\1" text "${text}")
  string(REPLACE " \\\n  " ";" paths "${text}")
  string(REPLACE "\\ " " " paths "${paths}")
  string(REPLACE "\\#" "#" paths "${paths}")
  string(REPLACE "$$" "$" paths "${paths}")
  set(${result} "${paths}" PARENT_SCOPE)
endfunction()

# Ends the configuration where the sources are for a machine that this project does not compile for.
function(_microros_check_tool_chain target output)
  if(EXISTS "${output}/toolchain.cmake" AND NOT CMAKE_CROSSCOMPILING)
    message(FATAL_ERROR "microros_add_library(${target}): its target is a microcontroller, and this project compiles for "
      "this machine. Configure with -DCMAKE_TOOLCHAIN_FILE=FILE; `microros-gen targets NAME --format cmake` prints one")
  elseif(NOT EXISTS "${output}/toolchain.cmake" AND CMAKE_SYSTEM_NAME STREQUAL "Generic")
    message(FATAL_ERROR "microros_add_library(${target}): its target is the host, which has an operating system, and this "
      "project compiles for ${CMAKE_SYSTEM_PROCESSOR} without one. Say which with TARGET; `microros-gen targets` lists them")
  endif()
endfunction()
