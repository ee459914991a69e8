# The command, the scenes and what there is to read. The libraries are inside the command, and Debian's own are found where
# Debian puts them.

if(TARGET scree_tool)
  install(TARGETS scree_tool RUNTIME)
endif()
install(DIRECTORY scenes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/scree/scenes)
install(FILES LICENSE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY scenes/pictures/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/scenes/pictures)

# The READMEs keep their places, so that the links between them hold.
file(GLOB readmes RELATIVE ${PROJECT_SOURCE_DIR} README.md)
foreach(room IN ITEMS engine contact thermal scenes tools tests)
  file(GLOB_RECURSE found RELATIVE ${PROJECT_SOURCE_DIR} ${room}/README.md)
  list(APPEND readmes ${found})
endforeach()
foreach(readme IN LISTS readmes)
  cmake_path(GET readme PARENT_PATH folder)
  install(FILES ${readme} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder})
endforeach()
