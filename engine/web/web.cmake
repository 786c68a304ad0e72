# The engine of a page: page_engine.js and page_engine.wasm, which `play` puts into its page.
add_executable(page_engine ${CMAKE_CURRENT_SOURCE_DIR}/web/page_engine.cpp ${CMAKE_CURRENT_SOURCE_DIR}/web/toml.cpp
               ${CMAKE_CURRENT_SOURCE_DIR}/web/few_units.cpp)
target_link_libraries(page_engine PRIVATE grainreel_core)
target_compile_options(page_engine PRIVATE -O2)
set(exported _malloc,_free)
target_link_options(page_engine PRIVATE -fwasm-exceptions -O2 -sMODULARIZE=1 -sEXPORT_NAME=GrainreelEngine
                    -sENVIRONMENT=worker,node -sALLOW_MEMORY_GROWTH=1 -sINITIAL_MEMORY=33554432 -sFILESYSTEM=1
                    -sEXPORTED_RUNTIME_METHODS=ccall
                    -sEXPORTED_FUNCTIONS=${exported})
set_target_properties(page_engine PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
