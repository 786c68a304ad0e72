// Complaints about files of VTK: file and line where they are text, file and byte where they are binary.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace grainreel {

// Where something stands in a file. `array` is its name for the reader of a message, and may be empty.
struct VtkPlace {
    const std::filesystem::path* file = nullptr;
    std::int64_t line = 0;  // 0: unknown
    std::string array{};
};

// Throw UserError: "FILE:LINE: array \"Radius\": what", "FILE: byte 84: what", "FILE: what".
[[noreturn]] void refuse_vtk(const VtkPlace& place, const std::string& what);
[[noreturn]] void refuse_vtk_line(const std::filesystem::path& file, std::int64_t line,
                                  const std::string& what);
[[noreturn]] void refuse_vtk_byte(const std::filesystem::path& file, std::size_t byte,
                                  const std::string& what);
[[noreturn]] void refuse_vtk_file(const std::filesystem::path& file, const std::string& what);

// "FILE:LINE", as far as they are known.
std::string text_of(const VtkPlace& place);

// What to do about a damaged file.
inline constexpr const char* kWriteAgain = "the file is damaged or cut off; write it again";

// The line in which a byte of a text stands, from 1.
std::int64_t line_of_byte(std::string_view text, std::size_t byte);

}  // namespace grainreel
