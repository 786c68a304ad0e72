# What `cmake --install` puts where, and the Debian package: cmake --build build/release && cd build/release && cpack.
# The program holds its scenes, meshes and the page; what is installed beside it is for people and shells.
include(GNUInstallDirs)
set(package_sources ${CMAKE_CURRENT_LIST_DIR})
set(package_made ${CMAKE_BINARY_DIR}/package)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
set(GRAINREEL_CONTACT "The grainreel authors <grainreel@users.noreply.github.com>" CACHE STRING
    "Who answers for the Debian package")

function(grainreel_build_first component)  # the rest: targets that the component holds
  install(CODE "
    execute_process(COMMAND ${CMAKE_COMMAND} -DBUILD=${CMAKE_BINARY_DIR} \"-DTARGETS=${ARGN}\"
                            -P ${package_sources}/build_first.cmake
                    COMMAND_ERROR_IS_FATAL ANY)" COMPONENT ${component})
endfunction()

grainreel_build_first(program grainreel)
install(TARGETS grainreel RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${CMAKE_SOURCE_DIR}/scenes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/grainreel/scenes
        FILES_MATCHING PATTERN "*.toml" PATTERN "*.stl" PATTERN "*.csv")

# The program writes its manual itself, so it must run on the machine that installs, or there must be an emulator for it.
install(CODE "
  execute_process(COMMAND ${CMAKE_COMMAND} \"-DPROGRAM=${CMAKE_CROSSCOMPILING_EMULATOR};$<TARGET_FILE:grainreel>\"
                          -DOUT=${package_made}
                          -DCHANGES=${CMAKE_SOURCE_DIR}/CHANGELOG.md -P ${package_sources}/make_manual.cmake
                  COMMAND_ERROR_IS_FATAL ANY)")
install(DIRECTORY ${package_made}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR})
install(FILES ${package_made}/grainreel.bash RENAME grainreel
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${package_made}/_grainreel DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES ${package_made}/grainreel.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

# Each Debian package has a changelog in the form that Debian's tools read.
set(debian_changelog ${CMAKE_BINARY_DIR}/package_changelog/changelog)
string(TIMESTAMP today "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${debian_changelog} "grainreel (${PROJECT_VERSION}) unstable; urgency=medium

  * What changed: /usr/share/doc/grainreel/CHANGELOG.md.gz

 -- ${GRAINREEL_CONTACT}  ${today}
")
execute_process(COMMAND gzip -9nf ${debian_changelog} COMMAND_ERROR_IS_FATAL ANY)
set(package_facts ${package_sources}/copyright ${debian_changelog}.gz)
install(FILES ${package_facts} ${package_made}/CHANGELOG.md.gz ${CMAKE_SOURCE_DIR}/README.md
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/grainreel)
# The guide and the reference without their pictures, which are larger than the program.
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs/guide ${CMAKE_SOURCE_DIR}/docs/reference
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/grainreel/docs FILES_MATCHING PATTERN "*.md")

include(${package_sources}/library.cmake)
include(${package_sources}/archive/archive.cmake)
install(DIRECTORY ${package_sources}/python/grainreel DESTINATION lib/python3/dist-packages COMPONENT python
        FILES_MATCHING PATTERN "*.py" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
install(FILES ${package_facts}
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-grainreel COMPONENT python)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME grainreel)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT ${GRAINREEL_CONTACT})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "films of vibrated grains and the numbers behind them")
set(CPACK_PACKAGE_DESCRIPTION
    "A discrete element engine runs a scene file, and an off-screen renderer
draws it: out come videos, pictures, measures and a page, without a screen.
Runs of LAMMPS, LIGGGHTS, MercuryDPM, YADE and others are drawn and measured
too.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
    WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
# What is linked is found in the binary. What the program opens while it runs is named by hand: OpenGL, FFmpeg, fonts,
# and the table of units, which its library brings along. Debian calls FFmpeg's packages by the major version. Mesa has
# no OSMesa from 25.1 on; there libegl1 brings Mesa's drivers along, with llvmpipe among them.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libosmesa6 | libegl1, fonts-dejavu-core")
foreach(library libavutil libavcodec libavformat libswscale libavfilter)
  string(REGEX MATCH "^[0-9]+" major "${FFMPEG_${library}_VERSION}")
  string(APPEND CPACK_DEBIAN_PACKAGE_DEPENDS ", ${library}${major}")
endforeach()
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot")

# Three packages: what people run, what programs link, and the Python module.
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program dev python)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME grainreel)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS
    "libegl1, fonts-noto-core, fonts-noto-cjk, python3-grainreel, lammps, openmpi-bin")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libgrainreel-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS "cmake, g++")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "grainreel")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-grainreel)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3, python3-numpy, python3-xarray, python3-netcdf4, grainreel (>= ${PROJECT_VERSION})")
# Packages before 1.0.0 had the module in the program's package.
set(CPACK_DEBIAN_PYTHON_PACKAGE_BREAKS "grainreel (<< 1.0.0)")
set(CPACK_DEBIAN_PYTHON_PACKAGE_REPLACES "grainreel (<< 1.0.0)")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "${CPACK_PACKAGE_DESCRIPTION}")
set(CPACK_COMPONENT_DEV_DESCRIPTION "The library, for programs that link it.
Static libraries, headers and CMake files of grainreel: run a scene step by
step, read and write frames, draw them.")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "The Python module.
Starts runs of grainreel and reads them as datasets of xarray with units:
measures, grains, fields, contacts, pictures.")
include(CPack)
