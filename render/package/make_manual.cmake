# Writes what the program knows about itself, as files for an installation: man pages (compressed, as Debian wants them),
# completion for three shells, and the changelog.
#   cmake -DPROGRAM=... -DCHANGES=CHANGELOG.md -DOUT=... -P make_manual.cmake
file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})
execute_process(COMMAND ${PROGRAM} manual --out ${OUT}/man1 COMMAND_ERROR_IS_FATAL ANY)
foreach(pair bash:grainreel.bash zsh:_grainreel fish:grainreel.fish)
  string(REPLACE ":" ";" pair ${pair})
  list(GET pair 0 shell)
  list(GET pair 1 name)
  execute_process(COMMAND ${PROGRAM} completion ${shell} OUTPUT_FILE ${OUT}/${name} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
file(COPY_FILE ${CHANGES} ${OUT}/CHANGELOG.md)
file(GLOB pages ${OUT}/man1/*.1)
execute_process(COMMAND gzip -9nf ${pages} ${OUT}/CHANGELOG.md COMMAND_ERROR_IS_FATAL ANY)
