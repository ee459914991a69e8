# How every target of the project is built: one library per room, one test program per room.

add_library(scree_flags INTERFACE)
target_compile_features(scree_flags INTERFACE cxx_std_20)
target_include_directories(scree_flags INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
# -ffp-contract=off: the same rounding whatever the processor's fused operations.
target_compile_options(scree_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror
                                             -ffp-contract=off)
# GCC 12 takes the empty optional strings of braced aggregates for uninitialised once they are inlined.
target_compile_options(scree_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
target_link_libraries(scree_flags INTERFACE OpenMP::OpenMP_CXX)
target_compile_definitions(scree_flags INTERFACE $<$<BOOL:${SCREE_CHECKS}>:SCREE_CHECKS>)
# Nobody replaces our functions in a shared library, so the compiler may inline them there as well.
target_compile_options(scree_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>)
if(SCREE_SANITIZE)
  target_compile_options(scree_flags INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer)
  target_link_options(scree_flags INTERFACE -fsanitize=address,undefined)
  # Gmsh has an Eigen of its own in it, and one of the two finds the other's functions: both must take memory in the same way.
  target_compile_definitions(scree_flags INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()

# scree_room(NAME SOURCES ... [LINKS ...] [PRIVATE_LINKS ...])
function(scree_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(${name} STATIC ${ROOM_SOURCES})
  target_link_libraries(${name} PUBLIC ${ROOM_LINKS} PRIVATE ${ROOM_PRIVATE_LINKS} scree_flags)
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                            $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/scree>)
  target_compile_features(${name} PUBLIC cxx_std_20)
endfunction()

# scree_late_library(NAME SOURCES ... LINKS ...): a shared library that engine/base/late_library.h loads. Of the rooms in it only
# what it exports by `extern "C"` is seen from outside.
set(late_libraries ${CMAKE_INSTALL_LIBDIR}/scree)
function(scree_late_library name)
  cmake_parse_arguments(LATE "" "" "SOURCES;LINKS" ${ARGN})
  add_library(${name} MODULE ${LATE_SOURCES})
  set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
  target_link_libraries(${name} PRIVATE ${LATE_LINKS} scree_flags)
  target_link_options(${name} PRIVATE LINKER:--exclude-libs,ALL)
  install(TARGETS ${name} LIBRARY DESTINATION ${late_libraries})
  set_property(GLOBAL APPEND PROPERTY scree_late_libraries ${name})
endfunction()

# scree_loads_late_libraries(TARGET): builds them with it. It loads them, so no link says that it needs them.
function(scree_loads_late_libraries target)
  get_property(late_libraries_made GLOBAL PROPERTY scree_late_libraries)
  add_dependencies(${target} ${late_libraries_made})
endfunction()

# scree_test(NAME SOURCES ... LINKS ... [SUITES ...]): a GoogleTest program whose cases CTest knows one by one, or, where the
# cases of a suite share a costly run, suite by suite: those listed each by itself, all others together.
function(scree_test name)
  cmake_parse_arguments(TEST "" "" "SOURCES;LINKS;SUITES" ${ARGN})
  add_executable(${name} ${TEST_SOURCES})
  target_link_libraries(${name} PRIVATE ${TEST_LINKS} scree_flags GTest::gtest_main GTest::gmock)
  target_compile_definitions(${name} PRIVATE SCREE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  scree_loads_late_libraries(${name})
  if(TEST_SUITES)
    foreach(suite IN LISTS TEST_SUITES)
      add_test(NAME ${name}.${suite} COMMAND ${name} --gtest_filter=${suite}.*:*/${suite}.*)
      set_tests_properties(${name}.${suite} PROPERTIES FAIL_REGULAR_EXPRESSION "] 0 tests from")
      string(APPEND listed ":${suite}.*:*/${suite}.*")
    endforeach()
    add_test(NAME ${name}.others COMMAND ${name} --gtest_filter=-${listed})
  else()
    gtest_discover_tests(${name} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60)
  endif()
endfunction()
