# cpack -G DEB: the program without what other programs build with (component development).
set(CPACK_PACKAGE_VENDOR "The stereonav authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "stereo flight through terrain, CT colons and translucent media")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
"stereonav flies in stereo through terrain (GeoTIFF, SRTM, USGS DEM and more),
through the colon in a CT study (DICOM, NIfTI, NRRD, MetaImage), through other
volumes and meshes, and through clouds and tissue that light passes into. It
casts the left eye by rays and makes the right eye out of the left one, so that
the second eye costs a fraction of the first, and measures what that saves and
what error it leaves.

It is not a medical device.")
set(CPACK_PACKAGE_CONTACT "The stereonav authors <stereonav@users.noreply.invalid>"
  CACHE STRING "Who answers for packages: NAME <ADDRESS>")
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_STRIP_FILES ON)

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME stereonav)
# Not Debian's own package, which would be 0.2.0-1 and newer than this one.
set(CPACK_DEBIAN_PACKAGE_RELEASE 0upstream1)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # of modules too, as they lie in the package
if(STEREONAV_DISPLAY)
  # What GLFW and epoxy open themselves, so that no tool sees it: OpenGL, monitors, raw mouse motion, pointers.
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libgl1, libxcursor1, libxi6, libxinerama1, libxrandr2")
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS spacenavd)  # 3-D mice
endif()
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# Manual, changelogs and copyright as Debian has them.
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_SOURCE_DIR}/packaging/debian/files.cmake)
set(CPACK_POST_BUILD_SCRIPTS ${CMAKE_SOURCE_DIR}/packaging/debian/without_ldconfig.cmake)
set(CPACK_STEREONAV_DEBIAN_DIR ${CMAKE_SOURCE_DIR}/packaging/debian)
set(CPACK_STEREONAV_CHANGELOG ${CMAKE_SOURCE_DIR}/CHANGELOG.md)

file(STRINGS ${CMAKE_SOURCE_DIR}/packaging/debian/changelog newest LIMIT_COUNT 1)
if(NOT newest MATCHES "^stereonav \\(${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}\\)")
  message(FATAL_ERROR "packaging/debian/changelog: expected an entry for ${PROJECT_VERSION}-"
    "${CPACK_DEBIAN_PACKAGE_RELEASE} at its beginning, found \"${newest}\"; add one")
endif()
include(CPack)
