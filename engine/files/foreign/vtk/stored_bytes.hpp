// Bytes of arrays in VTK's XML files: raw or base64, plain or in compressed blocks.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "engine/files/foreign/vtk/vtk_numbers.hpp"

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

}  // namespace grainreel
