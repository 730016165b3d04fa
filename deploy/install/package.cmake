# The Debian package, made by `deploy/package`, which installs to /usr.
set(GROVE_PACKAGE_MAINTAINER "The Grove authors <grove@grove.invalid>" CACHE STRING
  "Maintainer of the Debian package: a name and an address")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "${GROVE_PACKAGE_MAINTAINER}")
set(CPACK_PACKAGE_DIRECTORY "${CMAKE_BINARY_DIR}/package")
set(CPACK_PACKAGING_INSTALL_PREFIX "${CMAKE_INSTALL_PREFIX}")
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "one living world, streamed to browsers with a camera for each")
set(CPACK_PACKAGE_DESCRIPTION
"A cloud-gaming server that computes one world for all of its visitors and
streams to each browser what it sees of it. Simulations, light and the trees'
light fields are computed once and shared; only the view is made per visitor,
with or without a GPU.

The package has a systemd service, which is not started by itself.")
# The program's needs determine its linked libraries; Mesa loads its drivers itself.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "adduser, init-system-helpers (>= 1.54~), libegl-mesa0 | libegl-vendor, libgl1-mesa-dri")

# Files that dpkg must not overwrite after local changes.
file(CONFIGURE OUTPUT debian/conffiles @ONLY CONTENT
  "@CMAKE_INSTALL_FULL_SYSCONFDIR@/grove/grove.conf\n@CMAKE_INSTALL_FULL_SYSCONFDIR@/grove/scene.toml\n")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "${CMAKE_CURRENT_BINARY_DIR}/debian/conffiles"
  "${CMAKE_CURRENT_SOURCE_DIR}/debian/postinst" "${CMAKE_CURRENT_SOURCE_DIR}/debian/prerm"
  "${CMAKE_CURRENT_SOURCE_DIR}/debian/postrm")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# Debian requires a package changelog beside the program's.
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  execute_process(COMMAND ${CMAKE_COMMAND} -E env LC_ALL=C date --utc --rfc-email --date=${GROVE_RELEASE_DATE}
    OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  file(CONFIGURE OUTPUT debian/changelog @ONLY CONTENT
"grove (@PROJECT_VERSION@-@CPACK_DEBIAN_PACKAGE_RELEASE@) unstable; urgency=medium

  * Version @PROJECT_VERSION@; see changelog.gz.

 -- @GROVE_PACKAGE_MAINTAINER@  @date@
")
  grove_compressed("${CMAKE_CURRENT_BINARY_DIR}/debian/changelog" changelog.Debian.gz)
  add_custom_target(package_files ALL DEPENDS "${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian.gz")
  add_dependencies(package_files grove install_files)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian.gz" DESTINATION ${CMAKE_INSTALL_DOCDIR})
  install(FILES debian/lintian-overrides DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides RENAME grove)
endif()

include(CPack)
