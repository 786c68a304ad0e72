#include "engine/scene/text/scene_file.hpp"

#include <fmt/format.h>

#include <fstream>

#include "engine/base/error.hpp"
#include "engine/base/utf8.hpp"
#include "engine/scene/shipped/shipped_scenes.hpp"

namespace grainreel {
namespace {

constexpr std::size_t most_of_a_path = 400;  // characters, in a message

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
    throw UserError(fmt::format("{}: {}", excerpt(file.string(), most_of_a_path), what));
}

std::string advice_for_missing(const std::filesystem::path& file) {
    const std::optional<std::string> meant = nearest_shipped_scene(file.filename().string());
    return meant ? fmt::format("did you mean the shipped scene '{}'?", *meant)
                 : "give the path of a scene file (.toml)";
}

void check_kind(const std::filesystem::path& file) {
    using Type = std::filesystem::file_type;
    std::error_code ignored;
    switch (std::filesystem::status(file, ignored).type()) {
        case Type::regular:
        case Type::fifo:
            return;
        case Type::directory:
            fail(file, "this is a folder; give the path of a scene file (.toml)");
        case Type::not_found:
            fail(file, "there is no such file; " + advice_for_missing(file));
        case Type::none:
        case Type::unknown:
            fail(file, "cannot be read; check its permissions");
        default:
            fail(file, "this is a device; give the path of a scene file (.toml)");
    }
}

}  // namespace

std::string load_scene_file(const std::filesystem::path& file) {
    check_kind(file);
    std::ifstream stream(file, std::ios::binary);
    if (!stream) fail(file, "cannot be read; check its permissions");
    std::string text;
    char part[1 << 16];
    while (stream.read(part, sizeof part), stream.gcount() > 0) {
        text.append(part, static_cast<std::size_t>(stream.gcount()));
        if (text.size() > largest_scene_file)
            fail(file,
                 fmt::format("is larger than the {} MiB that a scene may have; give the path of a scene "
                             "file (.toml)",
                             largest_scene_file >> 20));
    }
    if (stream.bad()) fail(file, "cannot be read; check its permissions");
    return text;
}

}  // namespace grainreel
