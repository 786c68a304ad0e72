# Writes what the program knows about itself, as files for an installation: man pages (compressed, as Debian wants them),
# completion for three shells, and two changelogs: ours, and the one of the package in the form that Debian's tools read.
#   cmake -DPROGRAM=... -DVERSION=... -DCONTACT=... -DCHANGES=CHANGELOG.md -DOUT=... -P make_manual.cmake
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
string(TIMESTAMP today "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${OUT}/changelog "grainreel (${VERSION}) unstable; urgency=medium

  * What changed is told by CHANGELOG.md beside this file.

 -- ${CONTACT}  ${today}
")
file(GLOB pages ${OUT}/man1/*.1)
execute_process(COMMAND gzip -9nf ${pages} ${OUT}/changelog ${OUT}/CHANGELOG.md COMMAND_ERROR_IS_FATAL ANY)
