// Small things that all readers of VTK files need: messages about a place in a file (a line of text, or a
// byte), file names in lists, types of numbers, and numbers in bytes and in text.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/plain_file.hpp"
#include "engine/base/word_reader.hpp"

namespace grainreel {

enum class VtkType : std::uint8_t {
    int8,
    uint8,
    int16,
    uint16,
    int32,
    uint32,
    int64,
    uint64,
    float32,
    float64,
    bit
};

// The type "Float32", "UInt8", ... of XML files; none for "String" and for unknown words.
std::optional<VtkType> vtk_xml_type(std::string_view word);
// The type "float", "unsigned_char", "vtkIdType", ... of legacy files, ignoring case; vtkIdType is an int
// there.
std::optional<VtkType> vtk_legacy_type(std::string_view word);

// Number of bytes that so many numbers take. Eight bits are packed into a byte.
std::uint64_t bytes_of(VtkType type, std::uint64_t count);

// Turns bytes into so many numbers. There must be enough bytes.
void widen(std::string_view bytes, VtkType type, bool big_endian, std::size_t count,
           std::vector<double>& values);
void widen(std::string_view bytes, VtkType type, bool big_endian, std::size_t count,
           std::vector<std::int64_t>& values);

// A place in a file for a message. `array` is the name of the array there; it may be empty.
struct VtkPlace {
    const std::filesystem::path* file = nullptr;
    std::int64_t line = 0;  // 0: unknown
    std::string array{};
};

// Throws UserError "FILE:LINE: array \"Radius\": what".
[[noreturn]] void refuse_vtk(const VtkPlace& place, const std::string& what);

// "FILE:LINE", or as much of it as is known.
std::string text_of(const VtkPlace& place);

// The advice for a damaged file.
inline constexpr const char* kWriteAgain = "the file is damaged or cut off; write it again";

// The line of a byte in a text, from 1.
std::int64_t line_of_byte(std::string_view text, std::size_t byte);

// The name of a file in a list, relative to the folder of the list. Programs on Windows write backslashes;
// they become slashes if there is no file with the name as it stands.
inline std::string named_file(const std::filesystem::path& folder, std::string_view name) {
    std::string file(name);
    if (file.find('\\') == std::string::npos || is_plain(folder / file)) return file;
    std::replace(file.begin(), file.end(), '\\', '/');
    return file;
}

}  // namespace grainreel
