# The libraries that Scree's own are built on, from Debian 12's packages. Installed too: a project that finds Scree needs them.

find_package(PkgConfig REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Boost 1.74 REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(yaml-cpp REQUIRED)
pkg_check_modules(muparser REQUIRED IMPORTED_TARGET muparser)
pkg_check_modules(udunits REQUIRED IMPORTED_TARGET udunits)
pkg_check_modules(lz4 REQUIRED IMPORTED_TARGET liblz4)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(hdf5 REQUIRED hdf5-serial)
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
scree_library(amd_api amd amd.h suitesparse)
scree_library(cholmod_api cholmod cholmod.h suitesparse)

# HDF5 is linked into programs: its shared library loads thirty others (curl, Kerberos, GnuTLS) to read files over networks, which
# takes as long as a small run. Modules take the shared one, as Debian's static one is not built for them.
find_path(hdf5_cpp_INCLUDE H5Cpp.h PATH_SUFFIXES hdf5/serial REQUIRED)
find_package(ZLIB REQUIRED)
add_library(hdf5_cpp INTERFACE IMPORTED GLOBAL)
target_include_directories(hdf5_cpp SYSTEM INTERFACE ${hdf5_cpp_INCLUDE})
foreach(library IN ITEMS hdf5_serial_cpp hdf5_serial)
  find_library(${library}_STATIC lib${library}.a REQUIRED)
  find_library(${library}_SHARED ${library} REQUIRED)
  set(program $<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>)
  target_link_libraries(hdf5_cpp INTERFACE $<${program}:${${library}_STATIC}> $<$<NOT:${program}>:${${library}_SHARED}>)
endforeach()
find_library(sz_LIBRARY sz REQUIRED)
target_link_libraries(hdf5_cpp INTERFACE ${sz_LIBRARY} ZLIB::ZLIB ${CMAKE_DL_LIBS})
