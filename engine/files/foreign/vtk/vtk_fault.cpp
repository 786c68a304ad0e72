#include "engine/files/foreign/vtk/vtk_fault.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_of_a_path = 400;  // characters, in a message

std::string shown(const fs::path& file) {
    return excerpt(file.string(), most_of_a_path);
}

}  // namespace

std::string text_of(const VtkPlace& place) {
    const std::string file = place.file == nullptr ? std::string() : shown(*place.file);
    return place.line > 0 ? fmt::format("{}:{}", file, place.line) : file;
}

void refuse_vtk(const VtkPlace& place, const std::string& what) {
    if (place.array.empty()) throw UserError(fmt::format("{}: {}", text_of(place), what));
    throw UserError(fmt::format("{}: array \"{}\": {}", text_of(place), excerpt(place.array), what));
}

void refuse_vtk_line(const fs::path& file, std::int64_t line, const std::string& what) {
    throw UserError(fmt::format("{}:{}: {}", shown(file), line, what));
}

void refuse_vtk_byte(const fs::path& file, std::size_t byte, const std::string& what) {
    throw UserError(fmt::format("{}: byte {}: {}", shown(file), byte, what));
}

void refuse_vtk_file(const fs::path& file, const std::string& what) {
    throw UserError(fmt::format("{}: {}", shown(file), what));
}

std::int64_t line_of_byte(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, byte);
    return 1 + std::count(before.begin(), before.end(), '\n');
}

}  // namespace grainreel
