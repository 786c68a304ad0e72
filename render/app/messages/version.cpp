#include "render/app/messages/version.hpp"

#include <cairo.h>
#include <fmt/format.h>
#include <hwy/highway.h>
#include <microhttpd.h>
#include <pango/pango.h>
#include <png.h>
#include <spdlog/version.h>
#include <toml++/toml.h>
#include <xxhash.h>
#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <filesystem>
#include <nlohmann/json.hpp>

extern "C" {
#include <libavcodec/version.h>
#include <libavformat/version.h>
#include <libavutil/ffversion.h>
#include <libswscale/version.h>
}

#include "engine/base/system/own_files.hpp"
#include "engine/files/netcdf/netcdf_file.hpp"
#include "engine/vector/instructions.hpp"

namespace grainreel {

namespace {

std::string three(unsigned major, unsigned minor, unsigned patch) {
    return fmt::format("{}.{}.{}", major, minor, patch);
}

// The versions of FFmpeg that the program was built with. FFmpeg is loaded only when a film is made or read;
// the verb `doctor` tells the versions that are loaded.
std::vector<std::pair<std::string, std::string>> ffmpeg_of_build() {
    return {
        {"FFmpeg", FFMPEG_VERSION},
        {"libavformat",
         three(LIBAVFORMAT_VERSION_MAJOR, LIBAVFORMAT_VERSION_MINOR, LIBAVFORMAT_VERSION_MICRO)},
        {"libavcodec", three(LIBAVCODEC_VERSION_MAJOR, LIBAVCODEC_VERSION_MINOR, LIBAVCODEC_VERSION_MICRO)},
        {"libswscale", three(LIBSWSCALE_VERSION_MAJOR, LIBSWSCALE_VERSION_MINOR, LIBSWSCALE_VERSION_MICRO)}};
}

}  // namespace

std::vector<std::pair<std::string, std::string>> library_versions() {
    const unsigned xxhash = XXH_versionNumber();
    return {
        {"Eigen", three(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
        {"Highway", three(HWY_MAJOR, HWY_MINOR, HWY_PATCH)},
        {"NetCDF", netcdf_version()},
        {"libmicrohttpd", MHD_get_version()},
        {"libpng", png_get_libpng_ver(nullptr)},
        {"Pango", pango_version_string()},
        {"cairo", cairo_version_string()},
        {"toml++", three(TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH)},
        {"nlohmann-json",
         three(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
        {"CLI11", CLI11_VERSION},
        {"fmt", three(FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
        {"spdlog", three(SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH)},
        {"xxHash", three(xxhash / 10000, xxhash / 100 % 100, xxhash % 100)},
    };
}

std::string where_program_is() {
    if (!own_files().empty()) return "unpacked in " + own_files().parent_path().parent_path().string();
    std::error_code none;
    const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
    if (none) return "unknown";
    return (folder.filename() == "bin" ? "installed in " : "built in ") + folder.string();
}

std::string version_text() {
    std::string text =
        fmt::format("grainreel {} (commit {})\nprogram    {}\ncompiler   {}\nflags      {}\nvectors    {}\n",
                    build_info::version, build_info::commit, where_program_is(), build_info::compiler,
                    build_info::flags, vector_instructions());
    text += "libraries";
    for (const auto& [name, version] : library_versions()) text += fmt::format("\n  {:<15}{}", name, version);
    for (const auto& [name, version] : ffmpeg_of_build())
        text += fmt::format("\n  {:<15}{} when built", name, version);
    return text;
}

ProgramInfo program_info() {
    return {build_info::version, build_info::commit, build_info::compiler, build_info::flags,
            library_versions()};
}

}  // namespace grainreel
