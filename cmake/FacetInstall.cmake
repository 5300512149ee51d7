# What an install tree holds beside what the rooms install themselves (their libraries, the program and its man page, the
# OpenImageIO module): the headers and a package configuration for find_package(facet).
include(CMakePackageConfigHelpers)

set(FACET_INSTALL_CMAKEDIR ${CMAKE_INSTALL_LIBDIR}/cmake/facet)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/facet DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN facet.1 EXCLUDE)

install(EXPORT facetTargets NAMESPACE facet:: DESTINATION ${FACET_INSTALL_CMAKEDIR})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/facetConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/facetConfig.cmake
  INSTALL_DESTINATION ${FACET_INSTALL_CMAKEDIR})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/facetConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/facetConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/facetConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/FacetShader.cmake
        DESTINATION ${FACET_INSTALL_CMAKEDIR})
