# Compiles test files together, several a batch: what they share (GoogleTest's templates above all) is then worked
# out once a batch, which more than halves the time of the build. Each file's unnamed namespace gets the file's name
# in the batch, so that files may name their helpers alike. A file that defines macros, goes through vector targets
# or replaces operator new stays alone. -DGRAINREEL_TEST_BATCH=1 compiles every file by itself.
set(GRAINREEL_TEST_BATCH 12 CACHE STRING "Test files that are compiled together")

if(CMAKE_SCRIPT_MODE_FILE)  # cmake -DBATCH=out.cpp -P batches.cmake -- source ...
  set(text "")
  set(is_source OFF)
  math(EXPR last "${CMAKE_ARGC} - 1")
  foreach(at RANGE ${last})
    set(source "${CMAKE_ARGV${at}}")
    if(is_source)
      get_filename_component(name "${source}" NAME_WE)
      file(READ "${source}" content)
      string(REPLACE "\nnamespace {\n" "\nnamespace ${name}_${at} {\n" content "${content}")
      string(APPEND text "#line 1 \"${source}\"\n${content}\n")
    elseif(source STREQUAL "--")
      set(is_source ON)
    endif()
  endforeach()
  file(WRITE "${BATCH}" "${text}")
  return()
endif()

set(make_batch ${CMAKE_CURRENT_LIST_FILE})

function(grainreel_batches out folder)  # the rest: source files; out: what to compile in their place
  set(alone "")
  set(together "")
  foreach(source ${ARGN})
    file(STRINGS ${source} special REGEX "HWY_|^#define|operator new" LIMIT_COUNT 1)
    if(special OR NOT source MATCHES "_test\\.cpp$" OR GRAINREEL_TEST_BATCH LESS 2)
      list(APPEND alone ${source})
    else()
      list(APPEND together ${source})
    endif()
  endforeach()
  set(batches "")
  list(LENGTH together many)
  set(begin 0)
  while(begin LESS many)
    list(SUBLIST together ${begin} ${GRAINREEL_TEST_BATCH} batch)
    set(file ${CMAKE_CURRENT_BINARY_DIR}/batches/${folder}_from_${begin}.cpp)
    add_custom_command(OUTPUT ${file} COMMAND ${CMAKE_COMMAND} -DBATCH=${file} -P ${make_batch} -- ${batch}
                       DEPENDS ${batch} ${make_batch} VERBATIM)
    list(APPEND batches ${file})
    math(EXPR begin "${begin} + ${GRAINREEL_TEST_BATCH}")
  endwhile()
  set(${out} ${alone} ${batches} PARENT_SCOPE)
endfunction()
