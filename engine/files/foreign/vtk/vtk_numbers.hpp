// Numbers of VTK's files: their types, and what their bytes and words mean.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

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

}  // namespace grainreel
