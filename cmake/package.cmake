# cmake --build build/release --target deb: the Debian package of the program, build/release/terrabench_VERSION_amd64.deb, with
# its manual page, completion for bash and zsh, pages, examples and claims. The library is not in it (install.cmake).
set(manual ${PROJECT_BINARY_DIR}/manual)
if(NOT TERRABENCH_SANITIZE) # the program of a sanitizer may end with an error
  add_custom_command(OUTPUT ${manual}/terrabench.1.gz ${manual}/terrabench ${manual}/_terrabench
    COMMAND ${CMAKE_COMMAND} -E make_directory ${manual}
    COMMAND terrabench help --format man > ${manual}/terrabench.1
    COMMAND gzip -9nf ${manual}/terrabench.1
    COMMAND terrabench help --format bash > ${manual}/terrabench
    COMMAND terrabench help --format zsh > ${manual}/_terrabench
    DEPENDS terrabench COMMENT "Writing the manual page and the completion of command lines" VERBATIM)
  add_custom_target(manual ALL DEPENDS ${manual}/terrabench.1.gz)
  add_custom_target(deb
    COMMAND dpkg-shlibdeps --version > /dev/null # without it, cpack would leave dependencies out
    COMMAND ${CMAKE_CPACK_COMMAND} -G DEB
    DEPENDS manual COMMENT "Writing the Debian package" VERBATIM)
  install(FILES ${manual}/terrabench.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
  install(FILES ${manual}/terrabench DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
  install(FILES ${manual}/_terrabench DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
endif()

# In the tree's folders, so that the pages' links lead to them.
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program RENAME copyright)
install(FILES CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY docs examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
foreach(paper hybrid ght drill mrbsp meshgrow cross)
  install(FILES experiments/${paper}/claims.toml DESTINATION ${CMAKE_INSTALL_DOCDIR}/experiments/${paper} COMPONENT program)
endforeach()
install(DIRECTORY lod/camera/paths DESTINATION ${CMAKE_INSTALL_DOCDIR}/lod/camera COMPONENT program)
install(DIRECTORY representations/procedural_mesh/models
        DESTINATION ${CMAKE_INSTALL_DOCDIR}/representations/procedural_mesh COMPONENT program)
install(FILES terrain/dems/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/terrain/dems COMPONENT program)

set(CPACK_PACKAGE_CONTACT "The terrabench authors") # whoever hands it on may add an address
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS # whatever the umask is
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# What the program opens while it runs, which shlibdeps cannot see.
set(CPACK_DEBIAN_PACKAGE_DEPENDS
    "libosmesa6, libegl1, libgl1-mesa-dri, libglfw3, librsvg2-bin, fonts-dejavu-core, python-matplotlib-data")
include(CPack)
