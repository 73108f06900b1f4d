# The pkg-config file finds its prefix from where it lies, so `make install` may choose another one than the build.
file(RELATIVE_PATH SCREE_PREFIX_FROM_PC ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" SCREE_PREFIX_FROM_PC ${SCREE_PREFIX_FROM_PC})
configure_file(cmake/scree.pc.in scree.pc @ONLY)

# The man page and shell completion come out of the program's own table of verbs.
add_custom_command(OUTPUT scree.1 scree.bash
  COMMAND scree_cli help --man > scree.1
  COMMAND scree_cli help --completion bash > scree.bash
  DEPENDS scree_cli VERBATIM)
add_custom_target(scree_texts ALL DEPENDS scree.1 scree.bash)

install(TARGETS scree_cli scree_static scree_shared
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/scree DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/scree.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/scree.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/scree.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  RENAME scree)
