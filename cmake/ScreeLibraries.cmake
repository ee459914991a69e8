# The libraries that Scree's own are built on, from Debian 12's packages. Installed too: a project that finds Scree needs them.

find_package(PkgConfig REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Boost 1.74 REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenMP REQUIRED COMPONENTS CXX)
pkg_check_modules(muparser REQUIRED IMPORTED_TARGET muparser)
pkg_check_modules(hdf5 REQUIRED hdf5-serial)
pkg_check_modules(yaml-cpp REQUIRED yaml-cpp)
# Debian ships Bullet in both precisions; the packing needs double (engine/rigid/README.md).
pkg_check_modules(bullet64 REQUIRED IMPORTED_TARGET bullet-float64)
find_package(VTK 9.1 REQUIRED COMPONENTS CommonColor CommonCore CommonDataModel CommonMisc FiltersCore FiltersGeneral FiltersGeometry
             FiltersSources IOCore IOGeometry IOImage IOXML ImagingCore RenderingAnnotation RenderingCore RenderingFreeType RenderingOpenGL2)

# scree_library(TARGET LIBRARY HEADER [SUFFIX]): for packages without a CMake or pkg-config file.
function(scree_library target library header)
  find_library(${target}_LIBRARY ${library} REQUIRED)
  find_path(${target}_INCLUDE ${header} PATH_SUFFIXES ${ARGN} REQUIRED)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_link_libraries(${target} INTERFACE ${${target}_LIBRARY})
  target_include_directories(${target} SYSTEM INTERFACE ${${target}_INCLUDE})
endfunction()
scree_library(gmsh_api gmsh gmshc.h)
file(READ_SYMLINK ${gmsh_api_LIBRARY} gmsh_soname)
scree_library(hypre_api HYPRE HYPRE_parcsr_ls.h hypre)
scree_library(mpi_api mpi mpi.h mpi)
file(REAL_PATH ${hypre_api_LIBRARY} hypre_soname)
cmake_path(GET hypre_soname FILENAME hypre_soname)
# Whichever BLAS the system has chosen.
set(BLA_VENDOR Generic)
find_package(LAPACK REQUIRED)
scree_library(cholmod_api cholmod cholmod.h suitesparse)

# scree_inner_library(TARGET HEADER LIBRARIES... [IN SUFFIX]): linked into programs, each before those that it calls. The system takes
# a third of a millisecond to find and load a shared one, ten of which are a twentieth of a small run; and HDF5's loads thirty
# others (curl, Kerberos, GnuTLS) to read files over networks, which takes as long as a small run. Modules take the shared ones, as
# Debian's static ones are not built for them.
function(scree_inner_library target header)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "IN" "")
  find_path(${target}_INCLUDE ${header} PATH_SUFFIXES ${arg_IN} REQUIRED)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE ${${target}_INCLUDE})
  set(program $<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>)
  foreach(library IN LISTS arg_UNPARSED_ARGUMENTS)
    find_library(${library}_STATIC lib${library}.a REQUIRED)
    find_library(${library}_SHARED ${library} REQUIRED)
    target_link_libraries(${target} INTERFACE $<IF:${program},${${library}_STATIC},${${library}_SHARED}>)
  endforeach()
  target_link_libraries(${target} INTERFACE ${CMAKE_DL_LIBS})
endfunction()
scree_inner_library(amd_api amd.h amd suitesparseconfig IN suitesparse)
scree_inner_library(hdf5_api hdf5.h hdf5_serial sz aec z IN hdf5/serial)
scree_inner_library(lz4_api lz4.h lz4)
scree_inner_library(udunits_api udunits2.h udunits2 expat)
scree_inner_library(xxhash_api xxhash.h xxhash)
scree_inner_library(yaml_api yaml-cpp/yaml.h yaml-cpp)
