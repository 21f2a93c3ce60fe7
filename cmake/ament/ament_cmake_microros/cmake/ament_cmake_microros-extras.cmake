# SPDX-License-Identifier: Apache-2.0
find_package(ament_cmake QUIET REQUIRED)
# The one that came with this package; any other serves as well.
find_package(microros_gen QUIET CONFIG PATHS "${CMAKE_CURRENT_LIST_DIR}/../../cmake/microros_gen" NO_DEFAULT_PATH)
if(NOT microros_gen_FOUND)
  find_package(microros_gen REQUIRED)
endif()

# ament_microros_library(<target> …): microros_add_library() with the same arguments, and its installation.
#
# Interfaces are those of this workspace and of the underlay, by AMENT_PREFIX_PATH. The library goes to lib/, its headers
# to include/<package>/<target>, what is known of its plan to share/<package>/microros/<target>; other packages link
# <package>::<target> after find_package(<package>). Call it before ament_package().
macro(ament_microros_library target)
  microros_add_library(${ARGV})
  _ament_microros_install("${target}")
  ament_export_targets("export_${target}" HAS_LIBRARY_TARGET)
endmacro()

# ament_microros_link_type_support(<target> <package>): links a program of this machine (a test, a tool) to the XRCE type
# support that was installed with an interface package. It is whole: types that several packages share are in the library of
# each. So a program links one; for the types of several, declare them in an application file and build a separate library.
function(ament_microros_link_type_support target package)
  get_target_property(linked ${target} MICROROS_TYPE_SUPPORT)
  if(linked)
    message(FATAL_ERROR "ament_microros_link_type_support(${target} ${package}): ${target} has the type support of ${linked}, "
      "and a program takes one. Name both packages in `interfaces:` of an application file, and use ament_microros_library()")
  endif()
  ament_index_has_resource(prefix rosidl_generator_microros ${package})
  if(NOT prefix)
    message(FATAL_ERROR "ament_microros_link_type_support(${target} ${package}): no package '${package}' with XRCE type support "
      "is in AMENT_PREFIX_PATH. Build it where rosidl_generator_microros is installed, and name it in package.xml")
  endif()
  ament_index_get_resource(library rosidl_generator_microros ${package})
  if(NOT TARGET "${package}::${library}")
    include("${prefix}/share/${package}/cmake/${library}.cmake")
  endif()
  target_link_libraries(${target} PRIVATE "${package}::${library}")
  set_target_properties(${target} PROPERTIES MICROROS_TYPE_SUPPORT ${package})
endfunction()

function(_ament_microros_install target)
  get_target_property(output ${target} MICROROS_OUTPUT)
  set(include "include/${PROJECT_NAME}/${target}")
  target_include_directories(${target} INTERFACE "$<INSTALL_INTERFACE:${include}>")
  install(TARGETS ${target} EXPORT "export_${target}" ARCHIVE DESTINATION lib)
  install(DIRECTORY "${output}/include/" DESTINATION "${include}")
  install(FILES "${output}/manifest.json" DESTINATION "share/${PROJECT_NAME}/microros/${target}")
  install(DIRECTORY "${output}/agent" DESTINATION "share/${PROJECT_NAME}/microros/${target}" OPTIONAL)
endfunction()
