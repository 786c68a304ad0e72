# Puts static libraries together into one:
#   cmake -DAR=ar -DSTRIP=strip -DOUT=libwhole.a "-DPARTS=liba.a;libb.a" -P merge_archives.cmake
# Members of two parts may have one name, which ar keeps apart. Without debug information it is a fifth of the size.
get_filename_component(folder ${OUT} DIRECTORY)
file(MAKE_DIRECTORY ${folder})
file(REMOVE ${OUT})
set(script "CREATE ${OUT}\n")
foreach(part ${PARTS})
  string(APPEND script "ADDLIB ${part}\n")
endforeach()
string(APPEND script "SAVE\nEND\n")
file(WRITE ${OUT}.mri "${script}")
execute_process(COMMAND ${AR} -M INPUT_FILE ${OUT}.mri COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${STRIP} --strip-debug ${OUT} COMMAND_ERROR_IS_FATAL ANY)
file(REMOVE ${OUT}.mri)
