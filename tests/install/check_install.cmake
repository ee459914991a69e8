# Installs BUILD into an empty folder inside it, and uses what stands there: cmake -D BUILD=... -D VERSION=... -D READELF=... -D PYTHON=... -P this

# run(OUTPUT COMMAND...): its standard output, or a failure that shows what it said.
function(run output)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said_wrong)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command} ended with ${status}\n${said}${said_wrong}")
  endif()
  set(${output} "${said}" PARENT_SCOPE)
endfunction()

set(prefix ${BUILD}/installed)
file(REMOVE_RECURSE ${prefix})
run(ignored ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})

run(version ${prefix}/bin/scree --version)
if(NOT version MATCHES "^scree ${VERSION}")
  message(FATAL_ERROR "the version of ${VERSION} reads: ${version}")
endif()
# Only the build's own folders could stand there, and they may be gone tomorrow.
run(dynamic ${READELF} -d ${prefix}/bin/scree)
if(dynamic MATCHES "R(UN)?PATH")
  message(FATAL_ERROR "the installed command looks for libraries in the build:\n${dynamic}")
endif()

file(GLOB scenes ${prefix}/share/scree/scenes/*.yaml)
if(NOT scenes)
  message(FATAL_ERROR "no scenes were installed")
endif()
# One scene shows that the command finds what it needs; the scenes themselves are tests/scenes's.
run(ignored ${prefix}/bin/scree check ${prefix}/share/scree/scenes/slab.yaml)

run(python_version ${CMAKE_COMMAND} -E env PYTHONPATH=${prefix}/lib/python3/dist-packages ${PYTHON} -B -c
    "print(__import__('scree').__version__)")
if(NOT python_version MATCHES "^${VERSION}")
  message(FATAL_ERROR "the Python module of ${VERSION} says: ${python_version}")
endif()
if(NOT EXISTS ${prefix}/lib/python3/dist-packages/scree.pyi)
  message(FATAL_ERROR "scree.pyi was not installed")
endif()

foreach(document IN ITEMS LICENSE CHANGELOG.md tools/README.md)
  if(NOT EXISTS ${prefix}/share/doc/scree/${document})
    message(FATAL_ERROR "${document} was not installed")
  endif()
endforeach()
