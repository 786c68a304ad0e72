// Bytes of arrays in VTK's XML files: raw or base64, plain or in compressed blocks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files/foreign/vtk/vtk_numbers.hpp"
#include "engine/files/foreign/vtk/vtk_parts.hpp"
#include "engine/files/foreign/vtk/xml_tree.hpp"

namespace grainreel {

enum class VtkCompressor { none, zlib, lz4, lzma, unknown };

// What the head of a file says of all its arrays.
struct VtkCoding {
    bool big_endian = false;
    std::size_t header_bytes = 4;  // of a length: UInt32 or UInt64
    VtkCompressor compressor = VtkCompressor::none;
    std::string compressor_name{};
};

// A stream of bytes, written as they are or as base64. Base64 may come in several streams, each with padding
// of its own at its end, one after the other.
class StoredStream {
  public:
    StoredStream(std::string_view text, bool base64, const VtkPlace& place);

    // The next so many bytes. Throws UserError where they are not there, before memory is asked for.
    std::string take(std::uint64_t size);
    // No more bytes than these can follow.
    std::uint64_t at_most() const;

  private:
    void decode(std::string& to, std::size_t size);
    int next_letter();

    std::string_view left_;
    bool base64_;
    const VtkPlace& place_;
    std::string spare_{};  // decoded and not yet taken
};

// The bytes of one array. `wanted`: how many they must be, where that is known. Throws UserError for wrong
// lengths, for damage and for a compressor that is not read. Memory follows the size of the text.
std::string stored_array(std::string_view text, bool base64, const VtkCoding& coding,
                         std::optional<std::uint64_t> wanted, const VtkPlace& place);

// The same checks by the lengths alone, without the bytes: what is cut off is noticed when a file is opened.
void check_stored_array(std::string_view text, bool base64, const VtkCoding& coding,
                        std::optional<std::uint64_t> wanted, const VtkPlace& place);

// Arrays of numbers in VTK's XML files: as text, as base64, or appended behind the XML.

class XmlArrays {
  public:
    // All of them must live as long as this does. Throws UserError for a head that is not understood.
    XmlArrays(const std::filesystem::path& file, std::string_view bytes, const XmlTree& tree);

    // The numbers of a DataArray. `count`: how many there must be; none: as many as there are. `finite`: NaN
    // and infinity are refused. Throws UserError with the line.
    std::vector<double> numbers(const XmlElement& array, std::optional<std::uint64_t> count,
                                bool finite) const;
    std::vector<std::int64_t> whole(const XmlElement& array, std::optional<std::uint64_t> count) const;
    // By the lengths alone that so many numbers can be there.
    void check(const XmlElement& array, std::uint64_t count) const;

    // As it stands in the file.
    std::string_view text_of_array(const XmlElement& array) const;
    VtkPlace place_of(const XmlElement& array) const;
    // The count that an attribute has, or 0 without the attribute. Throws UserError for what is no count.
    std::uint64_t count_in(const XmlElement& element, std::string_view attribute) const;
    const std::filesystem::path& file() const { return file_; }

  private:
    struct Stored {
        std::string_view text;
        bool base64;
    };
    VtkType type_of(const XmlElement& array) const;
    bool is_text(const XmlElement& array) const;
    Stored stored(const XmlElement& array) const;
    template <class T>
    void read(const XmlElement& array, std::optional<std::uint64_t> count, bool finite,
              std::vector<T>& values) const;
    template <class T>
    void read_text(const XmlElement& array, std::optional<std::uint64_t> count, bool finite,
                   std::vector<T>& values) const;

    const std::filesystem::path& file_;
    std::string_view bytes_;
    const XmlTree& tree_;
    VtkCoding coding_;
};

// How many grains a file of VTK has, by its head alone: a long list of large files is opened without reading
// them.

// Adds to the counts of a moment, and returns true, where the head says all: PolyData with appended numbers,
// in which each point is a vertex, or which is all polygons. Nothing is known then of how the file goes on.
// `time_known`: the list says the time, so that the file's own does not matter.
bool count_by_head(const VtkPartFile& part_file, bool time_known, VtkParts& parts);

}  // namespace grainreel
