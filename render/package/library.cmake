# The library for other programs: two archives, the public headers, and a file for find_package(grainreel). It is a
# component of its own, and a Debian package, libgrainreel-dev.
# The archives hold the program's own libraries, so that nobody need know these and their flags. They are put together
# when they are installed, which costs a build nothing.
set(library_made ${CMAKE_BINARY_DIR}/package_library)
set(library_doc ${CMAKE_INSTALL_DATADIR}/doc/libgrainreel-dev)
set(engine_parts grainreel_base grainreel_mesh grainreel_scene grainreel_state grainreel_files grainreel_core
    grainreel_run grainreel_engine_library)
set(picture_parts grainreel_filmed grainreel_picture grainreel_picture_library)

function(grainreel_install_archive name)
  set(files "")
  foreach(part ${ARGN})
    list(APPEND files "$<TARGET_FILE:${part}>")
  endforeach()
  install(CODE "
    execute_process(COMMAND ${CMAKE_COMMAND} -DAR=${CMAKE_AR} -DSTRIP=${CMAKE_STRIP} -DOUT=${library_made}/lib${name}.a
                            \"-DPARTS=${files}\" -P ${package_sources}/merge_archives.cmake
                    COMMAND_ERROR_IS_FATAL ANY)" COMPONENT dev)
  install(FILES ${library_made}/lib${name}.a DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
endfunction()
grainreel_build_first(dev ${engine_parts} ${picture_parts})
grainreel_install_archive(grainreel_engine ${engine_parts})
grainreel_install_archive(grainreel_picture ${picture_parts})

install(DIRECTORY ${CMAKE_SOURCE_DIR}/engine/library/grainreel ${CMAKE_SOURCE_DIR}/render/library/grainreel
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev FILES_MATCHING PATTERN "*.hpp")

include(CMakePackageConfigHelpers)
set(library_config ${CMAKE_INSTALL_LIBDIR}/cmake/grainreel)
configure_package_config_file(${package_sources}/grainreelConfig.cmake.in ${library_made}/grainreelConfig.cmake
                              INSTALL_DESTINATION ${library_config}
                              PATH_VARS CMAKE_INSTALL_LIBDIR CMAKE_INSTALL_INCLUDEDIR)
write_basic_package_version_file(${library_made}/grainreelConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${library_made}/grainreelConfig.cmake ${library_made}/grainreelConfigVersion.cmake
        DESTINATION ${library_config} COMPONENT dev)

# The same folders as in docs, so that the guide's links lead somewhere.
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs/examples DESTINATION ${library_doc} COMPONENT dev
        PATTERN Doxyfile EXCLUDE)
install(FILES ${CMAKE_SOURCE_DIR}/docs/guide/library.md ${CMAKE_SOURCE_DIR}/docs/guide/other-programs.md
        DESTINATION ${library_doc}/guide COMPONENT dev)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs/reference DESTINATION ${library_doc} COMPONENT dev
        FILES_MATCHING PATTERN "scene*.md" PATTERN "measures.md" PATTERN "run_files.md")
install(FILES ${package_facts} DESTINATION ${library_doc} COMPONENT dev)

# What a program that links the archives needs beside them.
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libfmt-dev, libspdlog-dev, libtomlplusplus-dev, libnetcdf-dev, libhdf5-dev, libhwy-dev, \
libudunits2-dev, libxxhash-dev, zlib1g-dev, libzstd-dev, liblz4-dev, libexpat1-dev, libpng-dev, \
libpango1.0-dev, libosmesa6 | libegl1, fonts-dejavu-core, pkg-config")
