// Reads the arrays of numbers in VTK's XML files: as text, as base64, or appended after the XML; plain or in
// compressed blocks. stored_bytes.cpp gets the bytes, xml_arrays.cpp turns them into numbers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files/foreign/vtk/vtk_numbers.hpp"
#include "engine/files/foreign/vtk/vtk_parts.hpp"
#include "engine/files/foreign/vtk/xml_tree.hpp"

namespace grainreel {

enum class VtkCompressor { none, zlib, lz4, lzma, unknown };

// What the head of a file says about all its arrays.
struct VtkCoding {
    bool big_endian = false;
    std::size_t header_bytes = 4;  // bytes of a length: 4 (UInt32) or 8 (UInt64)
    VtkCompressor compressor = VtkCompressor::none;
    std::string compressor_name{};
};

// A stream of bytes, written raw or as base64. There may be several streams of base64, one after the other,
// each with its own padding at the end.
class StoredStream {
  public:
    // The stream lies in [begin, end) of the content.
    StoredStream(const Content& content, std::uint64_t begin, std::uint64_t end, bool base64,
                 const VtkPlace& place);

    // The next so many bytes. Throws UserError where there are fewer, before memory is asked for.
    std::string take(std::uint64_t size);
    // An upper limit for the number of bytes that follow.
    std::uint64_t at_most() const;

  private:
    void decode(std::string& to, std::size_t size);
    // The next bytes of the text; empty at its end.
    std::string_view left() const;

    const Content& content_;
    std::uint64_t next_, end_;
    bool base64_;
    const VtkPlace& place_;
    std::string spare_{};  // decoded and not yet taken
};

// Where an array is stored: in [begin, end) of a content, raw or as base64.
struct StoredText {
    std::uint64_t begin = 0, end = 0;
    bool base64 = false;
};

// Gives the bytes of one array to `take`, piece by piece. wanted: how many there must be, if that is known.
// Throws UserError for wrong lengths, for damage and for an unknown compressor.
void stored_array(const Content& content, const StoredText& text, const VtkCoding& coding,
                  std::optional<std::uint64_t> wanted, const VtkPlace& place,
                  const std::function<void(std::string_view)>& take);

// Makes the same checks by the lengths only, so that a cut file is noticed when it is opened.
void check_stored_array(const Content& content, const StoredText& text, const VtkCoding& coding,
                        std::optional<std::uint64_t> wanted, const VtkPlace& place);

class XmlArrays {
  public:
    // The arguments must outlive this object. Throws UserError for a head that is not understood.
    XmlArrays(const Content& content, const XmlTree& tree);

    // The numbers of a DataArray. count: how many there must be; none: any number. finite: NaN and infinity
    // are refused. Throws UserError with the line.
    std::vector<double> numbers(const XmlElement& array, std::optional<std::uint64_t> count,
                                bool finite) const;
    std::vector<std::int64_t> whole(const XmlElement& array, std::optional<std::uint64_t> count) const;
    // Checks by the lengths only that there can be so many numbers.
    void check(const XmlElement& array, std::uint64_t count) const;

    // The text of an array as it stands in the file; empty where it is longer than 1 MB.
    std::string short_text(const XmlElement& array) const;
    VtkPlace place_of(const XmlElement& array) const;
    // The count in an attribute, or 0 without the attribute. Throws UserError where it is no count.
    std::uint64_t count_in(const XmlElement& element, std::string_view attribute) const;
    const std::filesystem::path& file() const { return content_.file(); }

  private:
    VtkType type_of(const XmlElement& array) const;
    bool is_text(const XmlElement& array) const;
    StoredText stored(const XmlElement& array) const;
    template <class T>
    void read(const XmlElement& array, std::optional<std::uint64_t> count, bool finite,
              std::vector<T>& values) const;
    template <class T>
    void read_text(const XmlElement& array, std::optional<std::uint64_t> count, bool finite,
                   std::vector<T>& values) const;
    template <class T>
    void read_words(std::string_view text, std::uint64_t place, const XmlElement& array,
                    std::optional<std::uint64_t> count, bool finite, std::vector<T>& values) const;

    const Content& content_;
    const XmlTree& tree_;
    VtkCoding coding_;
};

// Counts the grains of a file by its head only, so that a long list of large files is opened without reading
// them. It adds to the counts of a moment and returns true if the head tells them all: in PolyData with
// appended numbers whose points are all grains, or which has only polygons. The rest of the file is not
// checked then. time_known: the list says the time, so that the time in the file is not needed.
bool count_by_head(const VtkPartFile& part_file, bool time_known, VtkParts& parts);

}  // namespace grainreel
