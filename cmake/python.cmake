# The Python package: in the build folder (PYTHONPATH=build/python) as links to the sources, installed into the folder of
# Debian's Python. `_where.py` says where library and program lie, from the package.
find_program(SCREE_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(SCREE_PYTHON NAMES python3)
if(SCREE_PYTHON)
  execute_process(COMMAND ${SCREE_PYTHON} -c "import sys; print('python%d.%d' % sys.version_info[:2])"
    OUTPUT_VARIABLE SCREE_PYTHON_VERSION OUTPUT_STRIP_TRAILING_WHITESPACE)
  file(GLOB SCREE_PYTHON_FILES CONFIGURE_DEPENDS python/scree/*.py python/scree/py.typed)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/python/scree)
  file(REMOVE_RECURSE ${folder})
  file(MAKE_DIRECTORY ${folder})
  foreach(file IN LISTS SCREE_PYTHON_FILES)
    get_filename_component(name ${file} NAME)
    file(CREATE_LINK ${file} ${folder}/${name} SYMBOLIC)
  endforeach()
  file(WRITE ${folder}/_where.py "LIBRARY = \"../../libscree.so\"\nPROGRAM = \"../../scree\"\n")

  # lib/python3/dist-packages below /usr, lib/python3.N/dist-packages elsewhere: equally deep.
  set(package ${CMAKE_INSTALL_PREFIX}/lib/python3/dist-packages/scree)
  file(RELATIVE_PATH library ${package} ${CMAKE_INSTALL_FULL_LIBDIR}/libscree.so.0)
  file(RELATIVE_PATH program ${package} ${CMAKE_INSTALL_FULL_BINDIR}/scree)
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/python/installed/_where.py
    "LIBRARY = \"${library}\"\nPROGRAM = \"${program}\"\n")
  install(CODE "
    set(python ${SCREE_PYTHON_VERSION})
    if(CMAKE_INSTALL_PREFIX STREQUAL \"/usr\")
      set(python python3)
    endif()
    file(INSTALL ${SCREE_PYTHON_FILES} ${CMAKE_CURRENT_BINARY_DIR}/python/installed/_where.py
      DESTINATION \"\${CMAKE_INSTALL_PREFIX}/lib/\${python}/dist-packages/scree\")")
endif()
