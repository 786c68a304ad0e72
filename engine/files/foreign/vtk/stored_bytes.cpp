// Decodes and unpacks the bytes of a VTK XML array: base64, zlib and LZ4. Each count in the file is compared
// with the bytes that follow before memory is asked for.
#include "engine/files/foreign/vtk/xml_arrays.hpp"

#include <fmt/format.h>
#include <lz4.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "engine/base/text.hpp"
#include "engine/files/foreign/vtk/vtk_numbers.hpp"

namespace grainreel {
namespace {

// A block of n compressed bytes may claim up to most_growth * n + most_of_nothing bytes. One byte becomes at
// most 1032 in zlib and 255 in LZ4.
constexpr std::uint64_t most_growth = 1100, most_of_nothing = 64;

// What letter_values has for characters other than the letters of base64; next_letter() returns no_more at
// the end.
constexpr int blank = -2, padding = -3, no_letter = -1, no_more = -4;

constexpr std::array<signed char, 256> letters() {
    std::array<signed char, 256> values{};
    values.fill(no_letter);
    for (int i = 0; i < 26; ++i) {
        values[static_cast<std::size_t>('A' + i)] = static_cast<signed char>(i);
        values[static_cast<std::size_t>('a' + i)] = static_cast<signed char>(26 + i);
    }
    for (int i = 0; i < 10; ++i) values[static_cast<std::size_t>('0' + i)] = static_cast<signed char>(52 + i);
    values['+'] = 62;
    values['/'] = 63;
    values['='] = padding;
    for (const char c : {' ', '\t', '\n', '\r', '\v', '\f'}) values[static_cast<std::size_t>(c)] = blank;
    return values;
}
constexpr std::array<signed char, 256> letter_values = letters();

// The length number `index` in a header of lengths.
std::uint64_t length_at(const std::string& header, std::size_t index, const VtkCoding& coding) {
    const std::string_view bytes =
        std::string_view(header).substr(index * coding.header_bytes, coding.header_bytes);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const std::size_t k = coding.big_endian ? i : bytes.size() - 1 - i;
        value = (value << 8) | static_cast<unsigned char>(bytes[k]);
    }
    return value;
}

void check_length(std::uint64_t length, std::optional<std::uint64_t> wanted, const VtkPlace& place) {
    if (wanted && length != *wanted)
        refuse_vtk(place,
                   fmt::format("has {} bytes, where its numbers take {}; {}", length, *wanted, kWriteAgain));
}

void unpack(const std::string& packed, const VtkCoding& coding, char* to, std::size_t size, std::size_t block,
            const VtkPlace& place) {
    bool good = false;
    if (coding.compressor == VtkCompressor::lz4) {
        constexpr auto most = static_cast<std::size_t>(std::numeric_limits<int>::max());
        good = packed.size() <= most && size <= most &&
               LZ4_decompress_safe(packed.data(), to, static_cast<int>(packed.size()),
                                   static_cast<int>(size)) == static_cast<int>(size);
    } else {
        uLongf length = size;
        good = ::uncompress(reinterpret_cast<Bytef*>(to), &length,
                            reinterpret_cast<const Bytef*>(packed.data()), packed.size()) == Z_OK &&
               length == size;
    }
    if (!good)
        refuse_vtk(place,
                   fmt::format("block {} of its compressed data is damaged; {}", block + 1, kWriteAgain));
}

std::uint64_t plain_length(StoredStream& stream, const VtkCoding& coding, std::optional<std::uint64_t> wanted,
                           const VtkPlace& place) {
    const std::uint64_t length = length_at(stream.take(coding.header_bytes), 0, coding);
    check_length(length, wanted, place);
    return length;
}

struct Blocks {
    std::uint64_t full = 0, last = 0;  // unpacked bytes of a full block and of the last one
    // Compressed bytes of each block.
    std::vector<std::uint64_t> packed;
    std::uint64_t size_of(std::size_t block) const { return block + 1 == packed.size() ? last : full; }
    std::uint64_t length() const { return packed.empty() ? 0 : (packed.size() - 1) * full + last; }
};

// Reads the header of compressed data: the number of blocks, the unpacked size of a block and of the last
// block (0 if it is full), and the compressed size of each.
Blocks blocks_of(StoredStream& stream, const VtkCoding& coding, const VtkPlace& place) {
    Blocks blocks;
    const std::uint64_t count = length_at(stream.take(coding.header_bytes), 0, coding);
    if (count == 0) return blocks;
    if (count > stream.at_most() / coding.header_bytes)
        refuse_vtk(place, fmt::format("says {} compressed blocks, which the file cannot hold; {}", count,
                                      kWriteAgain));
    const std::string sizes = stream.take((count + 2) * coding.header_bytes);
    blocks.full = length_at(sizes, 0, coding);
    const std::uint64_t last = length_at(sizes, 1, coding);
    blocks.last = last == 0 ? blocks.full : last;
    std::uint64_t room = stream.at_most();
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint64_t size = length_at(sizes, i + 2, coding);
        if (size > room)
            refuse_vtk(place,
                       fmt::format("block {} of its compressed data goes beyond the end of the file; {}",
                                   i + 1, kWriteAgain));
        room -= size;
        blocks.packed.push_back(size);
        const std::uint64_t claim = i + 1 == count ? blocks.last : blocks.full;
        if (claim > most_growth * size + most_of_nothing)
            refuse_vtk(place,
                       fmt::format("block {} says {} bytes in {} compressed ones, more than there can be; {}",
                                   i + 1, claim, size, kWriteAgain));
    }
    return blocks;
}

std::string packed_array(StoredStream& stream, const VtkCoding& coding, std::optional<std::uint64_t> wanted,
                         const VtkPlace& place) {
    const Blocks blocks = blocks_of(stream, coding, place);
    check_length(blocks.length(), wanted, place);
    std::string bytes(blocks.length(), '\0');
    std::size_t at = 0;
    for (std::size_t i = 0; i < blocks.packed.size(); ++i) {
        unpack(stream.take(blocks.packed[i]), coding, bytes.data() + at, blocks.size_of(i), i, place);
        at += blocks.size_of(i);
    }
    return bytes;
}

void check_compressor(const VtkCoding& coding, const VtkPlace& place) {
    if (coding.compressor == VtkCompressor::lzma)
        refuse_vtk(place, "is compressed with LZMA, which is not read; write the file with ZLib or LZ4");
    if (coding.compressor == VtkCompressor::unknown)
        refuse_vtk(place, fmt::format(
                              "is compressed with \"{}\", which is not read; write the file with ZLib or LZ4",
                              excerpt(coding.compressor_name)));
}

}  // namespace

StoredStream::StoredStream(std::string_view text, bool base64, const VtkPlace& place)
    : left_(text), base64_(base64), place_(place) {}

std::uint64_t StoredStream::at_most() const {
    return spare_.size() + (base64_ ? left_.size() / 4 * 3 + 3 : left_.size());
}

int StoredStream::next_letter() {
    while (!left_.empty()) {
        const int value = letter_values[static_cast<unsigned char>(left_[0])];
        if (value == no_letter)
            refuse_vtk(place_,
                       fmt::format("\"{}\" within base64; {}", excerpt(left_.substr(0, 1)), kWriteAgain));
        left_.remove_prefix(1);
        if (value != blank) return value;
    }
    return no_more;
}

void StoredStream::decode(std::string& to, std::size_t size) {
    while (to.size() < size) {
        std::array<int, 4> letter;
        for (std::size_t i = 0; i < 4; ++i) {
            letter[i] = next_letter();
            if (letter[i] == no_more)
                refuse_vtk(place_,
                           fmt::format("ends after {} of {} bytes; {}", to.size(), size, kWriteAgain));
        }
        const int bytes = letter[3] != padding ? 3 : letter[2] != padding ? 2 : 1;
        if (letter[0] < 0 || letter[1] < 0 || (bytes == 3 && letter[2] < 0))
            refuse_vtk(place_, fmt::format("\"=\" within base64; {}", kWriteAgain));
        const int word =
            (letter[0] << 18) | (letter[1] << 12) | (std::max(letter[2], 0) << 6) | std::max(letter[3], 0);
        for (int i = 0; i < bytes; ++i) to.push_back(static_cast<char>((word >> (16 - 8 * i)) & 255));
    }
}

std::string StoredStream::take(std::uint64_t size) {
    if (size > at_most())
        refuse_vtk(place_, fmt::format("says {} bytes, and at most {} are left in the file; {}", size,
                                       at_most(), kWriteAgain));
    std::string bytes;
    if (!base64_) {
        bytes = left_.substr(0, size);
        left_.remove_prefix(size);
        return bytes;
    }
    bytes = std::move(spare_);
    bytes.reserve(size + 3);
    decode(bytes, size);
    spare_ = bytes.substr(size);
    bytes.resize(size);
    return bytes;
}

std::string stored_array(std::string_view text, bool base64, const VtkCoding& coding,
                         std::optional<std::uint64_t> wanted, const VtkPlace& place) {
    check_compressor(coding, place);
    StoredStream stream(text, base64, place);
    if (coding.compressor != VtkCompressor::none) return packed_array(stream, coding, wanted, place);
    return stream.take(plain_length(stream, coding, wanted, place));
}

void check_stored_array(std::string_view text, bool base64, const VtkCoding& coding,
                        std::optional<std::uint64_t> wanted, const VtkPlace& place) {
    check_compressor(coding, place);
    StoredStream stream(text, base64, place);
    if (coding.compressor != VtkCompressor::none) {
        check_length(blocks_of(stream, coding, place).length(), wanted, place);
        return;
    }
    const std::uint64_t length = plain_length(stream, coding, wanted, place);
    if (length > stream.at_most())
        refuse_vtk(place, fmt::format("says {} bytes, and at most {} are left in the file; {}", length,
                                      stream.at_most(), kWriteAgain));
}

}  // namespace grainreel
