# The archive that runs everywhere, and the wheel for pip: cmake --build --preset release --target archive wheel
# Both hold one folder, which make_tree.py puts together: the program with every library that it needs but glibc's.
find_program(PATCHELF patchelf)
find_program(ARCHIVE_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(ARCHIVE_PYTHON python3)
mark_as_advanced(PATCHELF ARCHIVE_PYTHON)
set(GRAINREEL_ARCHIVE_FFMPEG lean CACHE STRING
    "FFmpeg in an archive: lean, built from Debian's source; system, the installed one; or the folder of a built one")
set(GRAINREEL_ARCHIVE_LEVEL 6 CACHE STRING "How hard an archive and a wheel are compressed, 0 to 9")
set(archive_sources ${CMAKE_CURRENT_LIST_DIR})
set(archive_made ${CMAKE_BINARY_DIR}/archive)
string(TOLOWER "${CMAKE_SYSTEM_NAME}" archive_system)
set(archive_name grainreel-${PROJECT_VERSION}-${archive_system}-${CMAKE_SYSTEM_PROCESSOR})

# It starts the program and is linked statically, so that it runs where libraries are missing.
add_executable(grainreel_launcher EXCLUDE_FROM_ALL ${archive_sources}/launcher.cpp)
target_compile_options(grainreel_launcher PRIVATE $<TARGET_PROPERTY:grainreel_flags,INTERFACE_COMPILE_OPTIONS>)
target_link_options(grainreel_launcher PRIVATE -static)

# FFmpeg takes two minutes of two processors, once.
set(archive_ffmpeg ${GRAINREEL_ARCHIVE_FFMPEG})
set(archive_waits grainreel_launcher grainreel)
if(archive_ffmpeg STREQUAL "lean")
  set(archive_ffmpeg ${archive_made}/ffmpeg)
  string(REGEX REPLACE "g\\+\\+((-[0-9]+)?)$" "gcc\\1" archive_cc "${CMAKE_CXX_COMPILER}")
  string(REGEX REPLACE "clang\\+\\+((-[0-9]+)?)$" "clang\\1" archive_cc "${archive_cc}")
  string(REGEX REPLACE "/c\\+\\+$" "/cc" archive_cc "${archive_cc}")
  set(archive_cross)
  if(CMAKE_CROSSCOMPILING)
    set(archive_cross --enable-cross-compile --target-os=linux --arch=${CMAKE_SYSTEM_PROCESSOR} --ar=${CMAKE_AR}
        --nm=${CMAKE_NM} --ranlib=${CMAKE_RANLIB} --strip=${CMAKE_STRIP})
    if(CMAKE_SYSROOT)
      list(APPEND archive_cross --sysroot=${CMAKE_SYSROOT})
    endif()
  endif()
  find_file(FFMPEG_VERSION_FILE libavutil/ffversion.h HINTS ${FFMPEG_INCLUDE_DIRS})
  mark_as_advanced(FFMPEG_VERSION_FILE)
  add_custom_command(OUTPUT ${archive_ffmpeg}/source
    COMMAND ${CMAKE_COMMAND} -E env PKG_CONFIG=${PKG_CONFIG_EXECUTABLE}
            ${archive_sources}/ffmpeg.sh ${archive_ffmpeg} ${archive_cc} ${archive_cross}
    DEPENDS ${archive_sources}/ffmpeg.sh ${FFMPEG_VERSION_FILE}
    COMMENT "Building FFmpeg for the archive" USES_TERMINAL VERBATIM)
  list(APPEND archive_waits ${archive_ffmpeg}/source)
endif()

set(archive_majors)
foreach(library avutil avcodec avformat swscale avfilter)
  string(REGEX MATCH "^[0-9]+" major "${FFMPEG_lib${library}_VERSION}")
  list(APPEND archive_majors ${library}=${major})
endforeach()
list(JOIN archive_majors "," archive_majors)
set(archive_command ${ARCHIVE_PYTHON} ${archive_sources}/make_tree.py --build ${CMAKE_BINARY_DIR}
    --launcher $<TARGET_FILE:grainreel_launcher> --majors ${archive_majors} --version ${PROJECT_VERSION}
    --processor ${CMAKE_SYSTEM_PROCESSOR} --sysroot "${CMAKE_SYSROOT}/" --readelf ${CMAKE_READELF}
    --strip ${CMAKE_STRIP} --patchelf "$<IF:$<BOOL:${PATCHELF}>,${PATCHELF},patchelf>" --cmake ${CMAKE_COMMAND})
set(archive_tree ${archive_made}/${archive_name})
add_custom_target(archive_tree
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${archive_tree}
  COMMAND ${CMAKE_COMMAND} -E env GRAINREEL_BUILT=1 ${archive_command} --ffmpeg ${archive_ffmpeg} ${archive_tree}
  DEPENDS ${archive_waits} COMMENT "Gathering what an archive holds" VERBATIM)

# The starter comes first: where unpacking was broken off it names what is missing.
set(archive_file ${CMAKE_BINARY_DIR}/${archive_name}.tar.xz)
add_custom_target(archive
  COMMAND ${CMAKE_COMMAND} -E env "XZ_OPT=-T0 -${GRAINREEL_ARCHIVE_LEVEL}"
          tar --create --xz --sort=name --owner=0 --group=0 --numeric-owner --file ${archive_file}.half
          --directory ${archive_made} ${archive_name}/README ${archive_name}/bin ${archive_name}/share ${archive_name}/lib
  COMMAND ${CMAKE_COMMAND} -E rename ${archive_file}.half ${archive_file}
  DEPENDS archive_tree COMMENT "Packing ${archive_name}.tar.xz" VERBATIM)

set(wheel_command ${ARCHIVE_PYTHON} ${archive_sources}/make_wheel.py --version ${PROJECT_VERSION}
    --processor ${CMAKE_SYSTEM_PROCESSOR} --module ${package_sources}/python/grainreel)
add_custom_target(wheel
  COMMAND ${wheel_command} --level ${GRAINREEL_ARCHIVE_LEVEL} ${archive_tree} ${CMAKE_BINARY_DIR}
  DEPENDS archive_tree COMMENT "Packing the wheel" VERBATIM)
