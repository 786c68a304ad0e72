# Puts static libraries together into one:
#   cmake -DAR=ar -DSTRIP=strip -DOUT=libwhole.a "-DPARTS=liba.a;libb.a" -P merge_archives.cmake
# Members of two parts may have one name, which ar keeps apart. Without debug information it is a fifth of the size.
get_filename_component(folder ${OUT} DIRECTORY)
file(MAKE_DIRECTORY ${folder})
# Two installations may run at once: each makes an archive of its own, which then takes the place of the last one whole.
string(RANDOM LENGTH 12 mark)
set(made ${OUT}.${mark}.a)
set(script "CREATE ${made}\n")
foreach(part ${PARTS})
  string(APPEND script "ADDLIB ${part}\n")
endforeach()
string(APPEND script "SAVE\nEND\n")
file(WRITE ${made}.mri "${script}")
execute_process(COMMAND ${AR} -M INPUT_FILE ${made}.mri COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${STRIP} --strip-debug ${made} COMMAND_ERROR_IS_FATAL ANY)
file(RENAME ${made} ${OUT})
file(REMOVE ${made}.mri)
