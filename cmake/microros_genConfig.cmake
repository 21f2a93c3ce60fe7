# SPDX-License-Identifier: Apache-2.0
# find_package(microros_gen): finds the tool and defines microros_add_library(); docs/howto/cmake.md is the manual.
#
# The tool is the one that these files came with: the program of the Python environment that the wheel was installed
# into, or this repository, run by MICROROS_GEN_PYTHON. MICROROS_GEN_COMMAND (a list: program, arguments) names another.
cmake_policy(PUSH)
cmake_policy(VERSION 3.16...3.31)

include("${CMAKE_CURRENT_LIST_DIR}/microros_add_library.cmake")

# Sets `command` to what starts the tool of the repository `root`, or `message` to why nothing does.
function(_microros_tool_of_repository root command message)
  find_program(MICROROS_GEN_PYTHON NAMES python3 python HINTS ENV VIRTUAL_ENV PATH_SUFFIXES bin Scripts
    NO_CMAKE_FIND_ROOT_PATH DOC "Python 3.10 or newer with the dependencies of microros_gen")
  mark_as_advanced(MICROROS_GEN_PYTHON)
  set(path "${root}")
  if(NOT WIN32 AND NOT "$ENV{PYTHONPATH}" STREQUAL "")
    set(path "${root}:$ENV{PYTHONPATH}")
  endif()
  set(start "${CMAKE_COMMAND}" -E env "PYTHONPATH=${path}" "${MICROROS_GEN_PYTHON}")
  execute_process(COMMAND ${start} -c "import microros_gen, click, elftools, jinja2, lark, squarify, yaml"
    RESULT_VARIABLE status ERROR_VARIABLE said OUTPUT_QUIET)
  if(status EQUAL 0)
    set(${command} ${start} -m microros_gen PARENT_SCOPE)
    return()
  endif()
  string(STRIP "${said}" said)
  string(REGEX REPLACE "^.*\n" "" said "${said}")
  set(${message} "the Python of MICROROS_GEN_PYTHON (${MICROROS_GEN_PYTHON}) cannot run microros_gen: ${said}. Activate or \
name one that can; this makes one that can: ${MICROROS_GEN_PYTHON} -m pip install \"${root}\"" PARENT_SCOPE)
endfunction()

# Sets `command` to the program of the environment `prefix`, else to one on the PATH, or `message` to the reason if it is missing.
function(_microros_tool_of_environment prefix command message)
  find_program(MICROROS_GEN_PROGRAM microros-gen PATHS "${prefix}/bin" "${prefix}/Scripts" NO_DEFAULT_PATH
    NO_CMAKE_FIND_ROOT_PATH DOC "The program microros-gen")
  find_program(MICROROS_GEN_PROGRAM microros-gen NO_CMAKE_FIND_ROOT_PATH)
  mark_as_advanced(MICROROS_GEN_PROGRAM)
  if(MICROROS_GEN_PROGRAM)
    set(${command} "${MICROROS_GEN_PROGRAM}" PARENT_SCOPE)
  else()
    set(${message} "program microros-gen not found in ${prefix} or on the PATH. Install it into the active Python environment: \
pip install PATH, of a clone or wheel of microros_gen"
      PARENT_SCOPE)
  endif()
endfunction()

set(_microros_command ${MICROROS_GEN_COMMAND})
if(NOT _microros_command)
  if(EXISTS "${CMAKE_CURRENT_LIST_DIR}/../microros_gen/__main__.py")
    get_filename_component(_microros_root "${CMAKE_CURRENT_LIST_DIR}/.." ABSOLUTE)
    _microros_tool_of_repository("${_microros_root}" _microros_command microros_gen_NOT_FOUND_MESSAGE)
  else()
    get_filename_component(_microros_root "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
    _microros_tool_of_environment("${_microros_root}" _microros_command microros_gen_NOT_FOUND_MESSAGE)
  endif()
  unset(_microros_root)
endif()
if(_microros_command)
  set_property(GLOBAL PROPERTY MICROROS_GEN_COMMAND "${_microros_command}")
else()
  set(microros_gen_FOUND FALSE)
endif()
unset(_microros_command)
cmake_policy(POP)
