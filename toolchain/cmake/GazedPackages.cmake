# The Debian packages of what GazedInstall installs: `cpack`, which toolchain/package calls.
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL daemon lab development)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # the libraries of the release that it is built on, by name and version
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# As Debian's own tools name who makes a package.
set(maintainer "The maintainers of gazed <maintainers@gazed.invalid>")
if(DEFINED ENV{DEBEMAIL})
  set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${maintainer})

# The first line of all three; what each is comes after.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "gaze of a NAO humanoid: where is the object that stands out?")

set(CPACK_DEBIAN_DAEMON_PACKAGE_NAME gazed)
set(CPACK_DEBIAN_DAEMON_PACKAGE_SECTION science)
set(CPACK_DEBIAN_DAEMON_PACKAGE_SUGGESTS "gazelab, liblcm-bin")
set(CPACK_DEBIAN_DAEMON_DESCRIPTION "The daemon. It watches a NAO's head camera, turns the head, looks again, and
publishes the point with its covariance over LCM. A simulated robot is built in:
gazed --fixations 2")

set(CPACK_DEBIAN_LAB_PACKAGE_NAME gazelab)
set(CPACK_DEBIAN_LAB_PACKAGE_SECTION science)
set(CPACK_DEBIAN_LAB_PACKAGE_RECOMMENDS "gnuplot-nox")  # the charts of explain and analyze
set(CPACK_DEBIAN_LAB_PACKAGE_SUGGESTS "gazed, default-jre, liblcm-java, libjchart2d-java")
set(CPACK_DEBIAN_LAB_DESCRIPTION "gazed's algorithms on files, and its message types for lcm-spy.
Saliency of pictures and cameras, triangulation of correspondences, logs that
gazed replays, pages that show how an answer came about, and the calibration
of a camera in a head. The message types and lcm-spy's window of pictures are
/usr/share/java/gazed_types.jar.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME gazed-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4)")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "gazed's libraries for other CMake projects.
find_package(gazed) gives gazed::saliency, gazed::geometry and
gazed::triangulation: static libraries and their headers, C++20.")

# The papers of each: its notes, and whose it is.
set(debian ${PROJECT_SOURCE_DIR}/toolchain/debian)
install(CODE "
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/documents)
  execute_process(COMMAND gzip -9nc ${debian}/changelog OUTPUT_FILE ${PROJECT_BINARY_DIR}/documents/changelog.gz COMMAND_ERROR_IS_FATAL ANY)"
  ALL_COMPONENTS)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} name)
  set(papers ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${name}_PACKAGE_NAME})
  install(FILES ${debian}/copyright DESTINATION ${papers} COMPONENT ${component})
  install(FILES ${PROJECT_BINARY_DIR}/documents/changelog.gz DESTINATION ${papers} COMPONENT ${component})
endforeach()
include(CPack)
