# cmake --install: the program with its cases, and the libraries with their headers. cpack -G DEB: a package of each, and
# one of the documentation.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(shared ${CMAKE_INSTALL_DATADIR}/pfdm)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/pfdm)

install(TARGETS pfdm RUNTIME COMPONENT program)
install(
  DIRECTORY cases/
  DESTINATION ${shared}/cases
  COMPONENT program
  PATTERN program EXCLUDE
  PATTERN python EXCLUDE
  PATTERN results EXCLUDE)
install(
  DIRECTORY cases/python/pfdm
  DESTINATION lib/python3/dist-packages
  COMPONENT program
  PATTERN __pycache__ EXCLUDE)
if(TARGET pfdm_python)
  install(TARGETS pfdm_python LIBRARY DESTINATION lib/python3/dist-packages COMPONENT program)
  install(FILES cases/python/_pfdm.pyi DESTINATION lib/python3/dist-packages COMPONENT program)
endif()
file(GLOB scripts ${PROJECT_SOURCE_DIR}/postproc/plots/*.py)
install(PROGRAMS ${scripts} DESTINATION ${shared}/postproc COMPONENT program)
install(FILES README.md LICENSE CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
foreach(shell bash zsh)
  set(place_bash ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  set(place_zsh ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
  set(name_bash pfdm)
  set(name_zsh _pfdm)
  set(script ${PROJECT_BINARY_DIR}/completion/${name_${shell}})
  install(
    CODE "file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/completion)
          execute_process(COMMAND $<TARGET_FILE:pfdm> completion ${shell} OUTPUT_FILE ${script} COMMAND_ERROR_IS_FATAL ANY)"
    COMPONENT program)
  install(FILES ${script} DESTINATION ${place_${shell}} COMPONENT program)
endforeach()

install(
  CODE "execute_process(COMMAND $<TARGET_FILE:pfdm> help --man OUTPUT_FILE ${PROJECT_BINARY_DIR}/pfdm.1 COMMAND_ERROR_IS_FATAL ANY)"
  COMPONENT program)
install(FILES ${PROJECT_BINARY_DIR}/pfdm.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)

# The documentation site, by `cmake --install DIR --component documentation`: built then, where Sphinx and what it needs are.
find_program(PFDM_SPHINX_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(PFDM_DOXYGEN doxygen)
find_path(PFDM_FURO furo/__init__.py PATHS /usr/lib/python3/dist-packages NO_DEFAULT_PATH)
find_path(PFDM_KATEX katex.min.css PATHS /usr/share/javascript/katex NO_DEFAULT_PATH)
set(has_documentation FALSE)
if(PFDM_SPHINX_PYTHON AND PFDM_DOXYGEN AND PFDM_FURO AND PFDM_KATEX)
  set(has_documentation TRUE)
  set(site ${PROJECT_BINARY_DIR}/documentation)
  install(
    CODE "file(REMOVE_RECURSE ${site})
          execute_process(
            COMMAND ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1 ${PFDM_SPHINX_PYTHON} -m sphinx -q
                    -c ${PROJECT_SOURCE_DIR}/cases/site -d ${site}.pages -b html ${PROJECT_SOURCE_DIR} ${site}
            COMMAND_ERROR_IS_FATAL ANY)"
    COMPONENT documentation EXCLUDE_FROM_ALL)
  install(
    DIRECTORY ${site}/
    DESTINATION ${CMAKE_INSTALL_DOCDIR}/html
    COMPONENT documentation EXCLUDE_FROM_ALL
    PATTERN .buildinfo EXCLUDE)
endif()

set(libraries options physics mesh solver postproc)
foreach(room parallel linear scalar heat momentum dynamics homogenization fracture calibration point vibration)
  list(APPEND libraries solver_${room})
endforeach()
foreach(room files hdf5 fields curves fits displacements point vibration cohesive exports page browser records reduction)
  list(APPEND libraries postproc_${room})
endforeach()
foreach(room input session studies fracture)
  list(APPEND libraries program_${room})
endforeach()
foreach(library IN LISTS libraries)
  set_target_properties(pfdm_${library} PROPERTIES EXPORT_NAME ${library})
  install(TARGETS pfdm_${library} EXPORT pfdm ARCHIVE COMPONENT development)
endforeach()
install(
  DIRECTORY physics mesh solver postproc
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pfdm
  COMPONENT development
  FILES_MATCHING
  PATTERN "*.h"
  PATTERN script EXCLUDE)
install(
  DIRECTORY cases/program/input cases/program/session cases/program/studies cases/program/fracture
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pfdm/cases/program
  COMPONENT development
  FILES_MATCHING
  PATTERN "*.h")
install(
  EXPORT pfdm
  FILE pfdmTargets.cmake
  NAMESPACE pfdm::
  DESTINATION ${package}
  COMPONENT development)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/pfdmConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(
  FILES ${CMAKE_CURRENT_LIST_DIR}/pfdmConfig.cmake ${CMAKE_CURRENT_LIST_DIR}/libraries.cmake
        ${PROJECT_BINARY_DIR}/pfdmConfigVersion.cmake
  DESTINATION ${package}
  COMPONENT development)

set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL program development)
if(has_documentation)
  list(APPEND CPACK_COMPONENTS_ALL documentation)
  set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_NAME pfdm-doc)
  set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
  set(CPACK_DEBIAN_DOCUMENTATION_DESCRIPTION "${PROJECT_DESCRIPTION}: tutorials, guides and reference as a site")
endif()
set(CPACK_PACKAGE_CONTACT "The pfdm authors <pfdm@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME pfdm)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "${PROJECT_DESCRIPTION}")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS fonts-liberation) # the reports'
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS pfdm-doc)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "python3-matplotlib, python3-numpy, python3-pandas")
if(TARGET pfdm_python) # the extension belongs to one version of Python
  get_target_property(python pfdm_python PFDM_DEBIAN_PYTHON)
  string(APPEND CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS ", ${python}")
endif()
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libpfdm-dev)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "${PROJECT_DESCRIPTION}: libraries and headers")
# The libraries that the launcher installs.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/pfdm)
file(READ ${PROJECT_SOURCE_DIR}/pfdm launcher)
string(REGEX MATCH "\npackages=\\([^)]*\\)" packages "${launcher}")
string(REGEX MATCHALL "[a-z0-9.]+(-[a-z0-9.]+)*-dev" libraries "${packages}")
list(JOIN libraries ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)
include(CPack)
