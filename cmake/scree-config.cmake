# find_package(scree): scree::library is all of it (tools/library/README.md); single rooms are scree::contact and the like.
# Needs C enabled besides C++, for HDF5 and VTK.

list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
include(ScreeLibraries)
include(${CMAKE_CURRENT_LIST_DIR}/scree-targets.cmake)
# Where the parts that are loaded late stand, from lib/cmake/scree.
cmake_path(SET scree_late NORMALIZE ${CMAKE_CURRENT_LIST_DIR}/../../scree)
target_link_options(scree::base INTERFACE LINKER:-rpath,${scree_late})
