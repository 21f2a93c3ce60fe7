# SPDX-License-Identifier: Apache-2.0
# microros_image(firmware [library]): links the executable `firmware` to the library (`microros` where none is named), lets
# the linker write firmware.map, and checks the budgets of the application file; where the library's target is a board, that
# makes it the board's image: memory map, start-up, .hex and .bin.
#
# What `microros-gen size`, `explain` and `run` need to know of libraries and images is kept in BUILD/.microros.
option(MICROROS_CALL_GRAPH "Let gcc write frames and calls (.ci files beside the objects), for bounds of the stack" ON)
option(MICROROS_BUDGETS "Check the budgets of the application file when an image is linked" ON)

function(microros_image name)
  set(library microros)
  if(ARGC GREATER 1)
    set(library ${ARGV1})
  endif()
  target_link_libraries(${name} PRIVATE ${library})
  _microros_facts(${name})
  set(map "")
  if(NOT APPLE AND CMAKE_C_COMPILER_ID MATCHES "GNU|Clang")
    set(map "$<TARGET_FILE_DIR:${name}>/${name}.map")
    target_link_options(${name} PRIVATE "LINKER:--gc-sections" "LINKER:-Map=${map}")
  endif()
  _microros_record(${name} "\"kind\": \"image\", \"name\": \"${name}\", \"library\": \"${library}\",
\"image\": \"$<TARGET_FILE:${name}>\", \"map\": \"${map}\", \"objects\": \"$<TARGET_OBJECTS:${name}>\",
\"folders\": \"${CMAKE_BINARY_DIR};${CMAKE_CURRENT_BINARY_DIR}\"")
  get_target_property(suffix ${library} MICROROS_SUFFIX)
  if(suffix)
    get_target_property(flags ${library} MICROROS_LINK_FLAGS)
    get_target_property(script ${library} MICROROS_LINKER_SCRIPT) # none: that of the compiler
    set_target_properties(${name} PROPERTIES SUFFIX "${suffix}")
    if(script)
      set_property(TARGET ${name} APPEND PROPERTY LINK_DEPENDS "${script}")
      string(APPEND flags " -T \"${script}\"")
    endif()
    set_property(TARGET ${name} APPEND_STRING PROPERTY LINK_FLAGS " ${flags}")
    if(CMAKE_OBJCOPY)
      add_custom_command(TARGET ${name} POST_BUILD
        COMMAND ${CMAKE_OBJCOPY} -O ihex $<TARGET_FILE:${name}> ${name}.hex
        COMMAND ${CMAKE_OBJCOPY} -O binary $<TARGET_FILE:${name}> ${name}.bin VERBATIM)
    endif()
  endif()
  get_target_property(budgets ${library} MICROROS_BUDGETS)
  if(budgets AND MICROROS_BUDGETS)
    set(file "${CMAKE_CURRENT_BINARY_DIR}/${name}-budgets.txt") # with other budgets it is linked, and checked, again
    file(GENERATE OUTPUT "${file}" CONTENT "${budgets}\n")
    set_property(TARGET ${name} APPEND PROPERTY LINK_DEPENDS "${file}")
    _microros_check(${name})
  endif()
endfunction()

# Lets the library be measured, by itself and in images; where its target has no image, its budgets are checked.
function(microros_measured_library name)
  _microros_facts(${name})
  set(arguments "${MICROROS_ARGUMENTS}") # of `microros-gen generate`, by microros_add_library()
  string(REPLACE "\\" "\\\\" arguments "${arguments}")
  string(REPLACE "\"" "\\\"" arguments "${arguments}")
  _microros_record(${name} "\"kind\": \"library\", \"name\": \"${name}\", \"output\": \"${CMAKE_CURRENT_LIST_DIR}\",
\"archive\": \"$<TARGET_FILE:${name}>\", \"objects\": \"$<TARGET_OBJECTS:${name}>\", \"archiver\": \"${CMAKE_AR}\",
\"arguments\": \"${arguments}\"")
  get_target_property(alone ${name} MICROROS_WITHOUT_IMAGE)
  if(alone AND MICROROS_BUDGETS)
    get_target_property(budgets ${name} MICROROS_BUDGETS)
    get_target_property(sources ${name} SOURCES)
    list(GET sources 0 first)
    set(file "${CMAKE_CURRENT_BINARY_DIR}/${name}-budgets.txt") # with other budgets it is made, and checked, again
    file(GENERATE OUTPUT "${file}" CONTENT "${budgets}\n")
    set_property(SOURCE "${first}" APPEND PROPERTY OBJECT_DEPENDS "${file}")
    _microros_check(${name})
  endif()
endfunction()

# Has the compiler tell what bounds of the stack are made of; none of it is in the image.
function(_microros_facts name)
  target_compile_options(${name} PRIVATE -g -ffunction-sections)
  foreach(language IN ITEMS C CXX)
    if(MICROROS_CALL_GRAPH AND CMAKE_${language}_COMPILER_ID STREQUAL "GNU"
       AND NOT CMAKE_${language}_COMPILER_VERSION VERSION_LESS 10)
      target_compile_options(${name} PRIVATE "$<$<COMPILE_LANGUAGE:${language}>:-fcallgraph-info=su>")
    endif()
  endforeach()
endfunction()

function(_microros_record name members)
  set(folder "${CMAKE_BINARY_DIR}/.microros")
  get_property(begun GLOBAL PROPERTY MICROROS_RECORDS)
  if(NOT begun)
    file(REMOVE_RECURSE "${folder}") # of an earlier configuration
    set_property(GLOBAL PROPERTY MICROROS_RECORDS ON)
  endif()
  get_property(several GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
  if(several)
    string(APPEND name "-$<CONFIG>")
  endif()
  file(GENERATE OUTPUT "${folder}/${name}.json" CONTENT "{\"version\": 1, \"config\": \"$<CONFIG>\", ${members}}\n")
endfunction()

# Checks the budgets whenever `name` is made, as `microros-gen build` does.
function(_microros_check name)
  get_property(command GLOBAL PROPERTY MICROROS_GEN_COMMAND)
  if(NOT command)
    find_program(MICROROS_GEN_PROGRAM microros-gen NO_CMAKE_FIND_ROOT_PATH)
    set(command ${MICROROS_GEN_PROGRAM})
  endif()
  if(NOT command)
    message(WARNING "microros-gen is not on the PATH: the budgets of '${name}' (memory: in the application file) are not checked")
    return()
  endif()
  add_custom_command(TARGET ${name} POST_BUILD
    COMMAND "${CMAKE_COMMAND}" -E env "AMENT_PREFIX_PATH=${MICROROS_AMENT_PREFIX_PATH}"
      ${command} size "${CMAKE_BINARY_DIR}" --image "$<TARGET_FILE:${name}>" --budgets
    WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" VERBATIM)
endfunction()
