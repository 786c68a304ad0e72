# Builds what a package holds before it is packed, for `./movie` builds the program alone:
#   cmake -DBUILD=build/release "-DTARGETS=grainreel;..." -P build_first.cmake
# Who has built already sets GRAINREEL_BUILT in the environment. Two installations at once take turns.
if(NOT DEFINED ENV{GRAINREEL_BUILT})
  file(LOCK ${BUILD}/package.lock)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${BUILD} --target ${TARGETS} RESULT_VARIABLE failed
                  OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(failed)
    message(FATAL_ERROR "${said}\nThe package is not made, because its parts could not be built.")
  endif()
endif()
