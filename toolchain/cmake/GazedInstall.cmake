# What `cmake --install` puts on a workstation, in three components that are three Debian packages too (GazedPackages): `daemon`, gazed and
# the message types; `lab`, gazelab and the jar of types; `development`, the libraries that other programs can use, for find_package(gazed).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
# Installing builds nothing: who has built gazed alone can install gazed alone (--component daemon).
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)

install(TARGETS gazed RUNTIME COMPONENT daemon)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/msgs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/gazed/msgs COMPONENT daemon FILES_MATCHING PATTERN "*.lcm")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/tests/data/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/gazed COMPONENT daemon)

# What the programs say of themselves, asked when they are installed.
install(CODE "
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/documents)
  execute_process(COMMAND $<TARGET_FILE:gazed> --print-completion OUTPUT_FILE ${PROJECT_BINARY_DIR}/documents/gazed COMMAND_ERROR_IS_FATAL ANY)"
  COMPONENT daemon)
install(FILES ${PROJECT_BINARY_DIR}/documents/gazed DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT daemon)
find_program(HELP2MAN_EXECUTABLE help2man)
mark_as_advanced(HELP2MAN_EXECUTABLE)

# gazed_manual(COMPONENT PROGRAM DESCRIPTION): the manual of a program and of its commands, where help2man is.
function(gazed_manual component program description)
  if(NOT HELP2MAN_EXECUTABLE)
    return()
  endif()
  set(manual ${PROJECT_BINARY_DIR}/documents/${component})
  install(CODE "execute_process(COMMAND ${PROJECT_SOURCE_DIR}/toolchain/manual ${manual} $<TARGET_FILE:${program}>
    ${PROJECT_VERSION} \"${description}\" COMMAND_ERROR_IS_FATAL ANY)" COMPONENT ${component})
  install(DIRECTORY ${manual}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ${component})
endfunction()
gazed_manual(daemon gazed "looks at the object that stands out and says where it is")

if(GAZED_LAB)
  install(TARGETS gazelab RUNTIME COMPONENT lab)
  gazed_manual(lab gazelab "gazed's algorithms on files")
endif()
if(GAZED_JAVA)
  install_jar(gazed_types DESTINATION ${CMAKE_INSTALL_DATADIR}/java COMPONENT lab)
endif()

# Eigen aligns matrices as the widest registers of the compiler's options want it; a program and these libraries must agree.
target_compile_definitions(gazed_geometry INTERFACE $<INSTALL_INTERFACE:EIGEN_MAX_STATIC_ALIGN_BYTES=16>)
set(exported gazed_base gazed_geometry gazed_saliency gazed_methods gazed_triangulation)
foreach(library IN LISTS exported)
  target_compile_features(${library} PUBLIC cxx_std_20)
  target_include_directories(${library} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/gazed>)
endforeach()
set_target_properties(gazed_lanes PROPERTIES EXPORT_NAME lanes)
set_target_properties(gazed_plain_lanes PROPERTIES EXPORT_NAME plain_lanes)
install(TARGETS ${exported} gazed_lanes gazed_plain_lanes EXPORT gazedTargets ARCHIVE COMPONENT development)
foreach(folder IN ITEMS base geometry saliency triangulation)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/agent/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gazed/agent COMPONENT development
          FILES_MATCHING PATTERN "*.hpp" PATTERN all_looks EXCLUDE)
endforeach()
set(configuration ${CMAKE_INSTALL_LIBDIR}/cmake/gazed)
install(EXPORT gazedTargets NAMESPACE gazed:: DESTINATION ${configuration} COMPONENT development)
# A minor version may change an interface, as long as the major one is 0.
write_basic_package_version_file(gazedConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_LIST_DIR}/gazedConfig.cmake ${PROJECT_BINARY_DIR}/gazedConfigVersion.cmake
        DESTINATION ${configuration} COMPONENT development)

# Everything that is installed.
add_custom_target(gazed_installed DEPENDS gazed ${exported})
if(GAZED_LAB)
  add_dependencies(gazed_installed gazelab)
endif()
if(GAZED_JAVA)
  add_dependencies(gazed_installed gazed_types)
endif()
