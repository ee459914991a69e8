# What the project needs of Debian 12's packages, and nothing else (tools/setup installs them).

include(ScreeLibraries)
find_package(CLI11 REQUIRED)

# Debian's own Python, which has Debian's numpy, whatever else the PATH holds.
find_program(SCREE_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
set(Python_EXECUTABLE ${SCREE_PYTHON})
set(PYBIND11_FINDPYTHON ON)
find_package(Python 3.9 REQUIRED COMPONENTS Interpreter Development.Module)
find_package(pybind11 2.10 REQUIRED)

# Only tools/bench asks for it, and is left out without it.
find_package(benchmark QUIET)

if(SCREE_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()
