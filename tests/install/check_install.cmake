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

foreach(file IN ITEMS share/man/man1/scree.1 share/bash-completion/completions/scree share/zsh/vendor-completions/_scree)
  if(NOT EXISTS ${prefix}/${file})
    message(FATAL_ERROR "${file} was not installed")
  endif()
endforeach()

# Another project finds it, builds with it, and heats a slab with the same result as the command.
set(consumer ${BUILD}/consumer)
file(REMOVE_RECURSE ${consumer})
run(ignored ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/consumer -B ${consumer} -G Ninja -D CMAKE_PREFIX_PATH=${prefix}
    -D CMAKE_BUILD_TYPE=Release)
run(ignored ${CMAKE_COMMAND} --build ${consumer})
run(probe ${consumer}/consumer ${prefix}/share/scree/scenes/slab.yaml)
run(ignored ${prefix}/bin/scree run ${prefix}/share/scree/scenes/slab.yaml --out ${consumer}/run --quiet)
file(READ ${consumer}/run/summary.json summary)
string(JSON expected GET "${summary}" heat probes near temperature)
# To a thousandth of a kelvin, in whole thousandths.
string(REGEX REPLACE "[.](...).*" "\\1" probe "${probe}")
string(REGEX REPLACE "[.](...).*" "\\1" expected "${expected}")
math(EXPR difference "${probe} - ${expected}")
if(difference LESS -1 OR difference GREATER 1)
  message(FATAL_ERROR "the other project finds ${probe} mK where the command finds ${expected} mK")
endif()

# What is loaded late is found beside the command and beside the Python module: starting from earlier temperatures needs VTK.
set(from_earlier "heat.initial={from: ${consumer}/run}")
run(ignored ${prefix}/bin/scree run ${prefix}/share/scree/scenes/slab.yaml --set ${from_earlier} --out ${consumer}/again --quiet)
run(ignored ${CMAKE_COMMAND} -E env PYTHONPATH=${prefix}/lib/python3/dist-packages ${PYTHON} -B -c
    "import scree; scree.run(scree.Scene('${prefix}/share/scree/scenes/slab.yaml', {'heat.initial': {'from': '${consumer}/run'}}), '${consumer}/by_python')")

foreach(document IN ITEMS LICENSE CHANGELOG.md tools/README.md)
  if(NOT EXISTS ${prefix}/share/doc/scree/${document})
    message(FATAL_ERROR "${document} was not installed")
  endif()
endforeach()
