# The library scree_version (engine/base/version.h). A library of its own, so that a new commit relinks the tool alone.

set(SCREE_VERSION ${PROJECT_VERSION})
find_package(Git QUIET)
if(Git_FOUND)
  # No match for any tag: the commit alone.
  execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --dirty --exclude=* WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
                  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status)
  if(status EQUAL 0)
    string(APPEND SCREE_VERSION "+g${commit}")
    # Results are kept and used again by the version, so that every new commit is configured anew.
    execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --path-format=absolute --git-path logs/HEAD
                    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE log OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(EXISTS "${log}")
      set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${log}")
    endif()
  endif()
endif()

# Two libraries tell their version in neither a CMake nor a pkg-config file.
file(REAL_PATH ${gmsh_api_LIBRARY} gmsh_file)
string(REGEX REPLACE ".*[.]so[.]" "" SCREE_GMSH_VERSION ${gmsh_file})
file(STRINGS ${cholmod_api_INCLUDE}/cholmod_core.h lines REGEX "#define CHOLMOD_(MAIN|SUB|SUBSUB)_VERSION [0-9]+")
string(REGEX REPLACE "[^0-9;]" "" lines "${lines}")
list(JOIN lines "." SCREE_CHOLMOD_VERSION)

configure_file(${PROJECT_SOURCE_DIR}/engine/base/version.cpp.in ${PROJECT_BINARY_DIR}/engine/base/version.cpp @ONLY)
scree_room(scree_version SOURCES ${PROJECT_BINARY_DIR}/engine/base/version.cpp engine/base/version_text.cpp PRIVATE_LINKS fmt::fmt)
