# In place of engine/libraries.cmake where Emscripten compiles the engine for pages: headers alone, each library by
# itself, because /usr/include also has the headers of this machine's C library.
find_path(HEADERS_HWY hwy/highway.h PATHS /usr/include REQUIRED NO_CMAKE_FIND_ROOT_PATH)
find_path(HEADERS_FMT fmt/format.h PATHS /usr/include REQUIRED NO_CMAKE_FIND_ROOT_PATH)
find_path(HEADERS_TOML toml++/toml.h PATHS /usr/include REQUIRED NO_CMAKE_FIND_ROOT_PATH)
find_path(HEADERS_JSON nlohmann/json.hpp PATHS /usr/include REQUIRED NO_CMAKE_FIND_ROOT_PATH)
find_path(HEADERS_XXHASH xxhash.h PATHS /usr/include REQUIRED NO_CMAKE_FIND_ROOT_PATH)
find_path(HEADERS_EIGEN Eigen/Core PATHS /usr/include/eigen3 REQUIRED NO_CMAKE_FIND_ROOT_PATH)
set(headers ${CMAKE_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
foreach(link ${HEADERS_HWY}/hwy ${HEADERS_FMT}/fmt ${HEADERS_TOML}/toml++ ${HEADERS_JSON}/nlohmann
        ${HEADERS_XXHASH}/xxhash.h ${HEADERS_XXHASH}/xxh3.h ${HEADERS_EIGEN}/Eigen)
  get_filename_component(name ${link} NAME)
  file(CREATE_LINK ${link} ${headers}/${name} SYMBOLIC)
endforeach()
foreach(library Eigen3::Eigen fmt::fmt Threads::Threads nlohmann_json::nlohmann_json PkgConfig::TOMLPP PkgConfig::HWY
        PkgConfig::XXHASH)
  add_library(${library} INTERFACE IMPORTED)
endforeach()
set(UDUNITS2_INCLUDE)
set(UDUNITS2_LIBRARY)

# Highway 1.0 knows no doubles in registers of WebAssembly. Its pairs of plain numbers give the bits of SSE4.
add_compile_options(-msimd128 -fwasm-exceptions -include ${CMAKE_SOURCE_DIR}/engine/web/missing.hpp)
add_compile_definitions(HWY_COMPILE_ONLY_EMU128 FMT_HEADER_ONLY XXH_INLINE_ALL XXH_VECTOR=0 TOML_HEADER_ONLY=0 TOML_EXCEPTIONS=1)
include_directories(SYSTEM ${headers})
