// Numbers of VTK's files: their types, and what their bytes and words mean.
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

// "Float32", "UInt8", ... of XML files; none for "String" and what is no type.
std::optional<VtkType> vtk_xml_type(std::string_view word);
// "float", "unsigned_char", "vtkIdType", ... of legacy files, in any case; vtkIdType is an int there.
std::optional<VtkType> vtk_legacy_type(std::string_view word);

// Bytes that so many numbers take. Bits are packed by eight.
std::uint64_t bytes_of(VtkType type, std::uint64_t count);

// So many numbers out of their bytes, which must be there, each as a double.
void widen(std::string_view bytes, VtkType type, bool big_endian, std::size_t count,
           std::vector<double>& values);
void widen(std::string_view bytes, VtkType type, bool big_endian, std::size_t count,
           std::vector<std::int64_t>& values);

// Numbers in a text, blanks and ends of lines between them.
class VtkWords {
  public:
    VtkWords(const char* begin, const char* end) : at_(begin), end_(end) {}

    // False at the end of the text, and where the next word is no number: at() is its place then. "nan" and
    // "-1.#IND" are numbers that are missing: NaN.
    bool number(double& value);
    // The next word, empty at the end.
    std::string_view word();
    bool at_end();
    const char* at() const { return at_; }

  private:
    void skip_blanks();
    bool odd_number(double& value);

    const char* at_;
    const char* end_;
};

// Complaints about files of VTK: file and line where they are text, file and byte where they are binary.

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

// Files that lists of VTK name: relative to the folder of the list, and by programs on Windows with
// backslashes.

// The name as the list has it where a file is there, or where it has no backslash; else with slashes.
inline std::string named_file(const std::filesystem::path& folder, std::string_view name) {
    std::string file(name);
    if (file.find('\\') == std::string::npos || is_plain(folder / file)) return file;
    std::replace(file.begin(), file.end(), '\\', '/');
    return file;
}

}  // namespace grainreel
