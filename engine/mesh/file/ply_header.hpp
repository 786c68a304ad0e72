// The header of a PLY file, which describes the numbers behind it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace grainreel {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
std::size_t bytes_of(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::int8;
    bool list = false;
    PlyType count_type = PlyType::uint8;  // type of a list's count
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
    std::size_t place_of(std::string_view property) const;  // npos if there is no property with that name
    static constexpr std::size_t npos = static_cast<std::size_t>(-1);
};

struct PlyHeader {
    enum class Form { ascii, little_endian, big_endian };
    Form form = Form::ascii;
    std::vector<PlyElement> elements;
    std::string_view body;       // the bytes behind the header
    std::int64_t body_line = 1;  // number of the line in which the body begins
    const PlyElement* element(std::string_view name) const;
};

// Throws UserError with the line. Counts that the rest of the file cannot hold are refused.
PlyHeader ply_header(const std::filesystem::path& file, std::string_view bytes);

}  // namespace grainreel
