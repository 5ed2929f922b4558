# cmake --install: the program, and the modules with their headers as the package that find_package(terrabench) finds.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/terrabench)
install(TARGETS terrabench COMPONENT program)
install(TARGETS ${TERRABENCH_MODULES} EXPORT terrabench
        FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/terrabench)
install(TARGETS glad EXPORT terrabench)
install(EXPORT terrabench FILE terrabenchTargets.cmake NAMESPACE terrabench:: DESTINATION ${package_dir})

write_basic_package_version_file(${PROJECT_BINARY_DIR}/terrabenchConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/terrabenchConfig.cmake cmake/dependencies.cmake ${PROJECT_BINARY_DIR}/terrabenchConfigVersion.cmake
        DESTINATION ${package_dir})
