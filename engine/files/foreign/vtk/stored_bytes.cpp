// Decodes and unpacks the bytes of a VTK XML array: base64, zlib and LZ4. Each count in the file is compared
// with the bytes that follow before memory is asked for.
#include "engine/files/foreign/vtk/xml_arrays.hpp"

#include <fmt/format.h>
#include <lz4.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <new>
#include <vector>

#include "engine/base/text.hpp"
#include "engine/files/foreign/vtk/vtk_numbers.hpp"

namespace grainreel {
namespace {

// A block of n compressed bytes may claim up to most_growth * n + most_of_nothing bytes. One byte becomes at
// most 1032 in zlib and 255 in LZ4.
constexpr std::uint64_t most_growth = 1100, most_of_nothing = 64;

constexpr std::uint64_t most_blocks = 2000000;

// What letter_values has for characters other than the letters of base64.
constexpr int blank = -2, padding = -3, no_letter = -1;

constexpr std::array<signed char, 256> letters() {
    std::array<signed char, 256> values{};
    values.fill(no_letter);
    for (int i = 0; i < 26; ++i) {
        values['A' + i] = static_cast<signed char>(i);
        values['a' + i] = static_cast<signed char>(26 + i);
    }
    for (int i = 0; i < 10; ++i) values['0' + i] = static_cast<signed char>(52 + i);
    values['+'] = 62;
    values['/'] = 63;
    values['='] = padding;
    for (const char c : {' ', '\t', '\n', '\r', '\v', '\f'}) values[c] = blank;
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

[[noreturn]] void refuse_block(std::size_t block, const VtkPlace& place) {
    refuse_vtk(place, fmt::format("block {} of its compressed data is damaged; {}", block + 1, kWriteAgain));
}

using TakeBytes = std::function<void(std::string_view)>;

// Unpacks a block of LZ4, which must have so many bytes then. Memory is asked for as far as there are bytes:
// a claim of many is tried with a part of them first.
bool unpack_lz4(const std::string& packed, std::uint64_t size, const TakeBytes& take) {
    constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<int>::max());
    constexpr std::uint64_t first = std::uint64_t{4} << 20;
    if (packed.size() > most || size > most) return false;
    for (std::uint64_t room = std::min(size, first);; room = std::min(size, 4 * room)) {
        std::string bytes(room, '\0');
        const auto got =
            room == size
                ? LZ4_decompress_safe(packed.data(), bytes.data(), static_cast<int>(packed.size()),
                                      static_cast<int>(size))
                : LZ4_decompress_safe_partial(packed.data(), bytes.data(), static_cast<int>(packed.size()),
                                              static_cast<int>(room), static_cast<int>(room));
        if (got != static_cast<int>(room)) return false;
        if (room < size) continue;
        take(bytes);
        return true;
    }
}

// Unpacks a block of zlib, which must have so many bytes then.
bool unpack_zlib(const std::string& packed, std::uint64_t size, const TakeBytes& take) {
    if (packed.size() > std::numeric_limits<uInt>::max()) return false;
    z_stream stream{};
    if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
    const std::unique_ptr<z_stream, decltype(&inflateEnd)> ended(&stream, &inflateEnd);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(packed.size());
    std::string piece(std::min<std::uint64_t>(size + 1, Content::kPiece), '\0');
    int result = Z_OK;
    std::uint64_t unpacked = 0;
    while (result == Z_OK && unpacked <= size) {
        stream.next_out = reinterpret_cast<Bytef*>(piece.data());
        stream.avail_out = static_cast<uInt>(piece.size());
        result = inflate(&stream, Z_NO_FLUSH);
        const std::size_t got = piece.size() - stream.avail_out;
        unpacked += got;
        if (unpacked <= size) take(std::string_view(piece).substr(0, got));
    }
    return result == Z_STREAM_END && unpacked == size;
}

void unpack(const std::string& packed, const VtkCoding& coding, std::uint64_t size, std::size_t block,
            const VtkPlace& place, const TakeBytes& take) {
    const bool good = coding.compressor == VtkCompressor::lz4 ? unpack_lz4(packed, size, take)
                                                              : unpack_zlib(packed, size, take);
    if (!good) refuse_block(block, place);
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
    if (count > most_blocks)
        refuse_vtk(place, fmt::format("says {} compressed blocks; at most {} are read", count, most_blocks));
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

void packed_array(StoredStream& stream, const VtkCoding& coding, std::optional<std::uint64_t> wanted,
                  const VtkPlace& place, const TakeBytes& take) {
    const Blocks blocks = blocks_of(stream, coding, place);
    check_length(blocks.length(), wanted, place);
    for (std::size_t i = 0; i < blocks.packed.size(); ++i)
        unpack(stream.take(blocks.packed[i]), coding, blocks.size_of(i), i, place, take);
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

StoredStream::StoredStream(const Content& content, std::uint64_t begin, std::uint64_t end, bool base64,
                           const VtkPlace& place)
    : content_(content), next_(begin), end_(end), base64_(base64), place_(place) {}

std::uint64_t StoredStream::at_most() const {
    const std::uint64_t left = end_ - next_;
    return spare_.size() + (base64_ ? left / 4 * 3 + 3 : left);
}

std::string_view StoredStream::left() const {
    return next_ < end_ ? content_.from(next_).substr(0, static_cast<std::size_t>(end_ - next_))
                        : std::string_view();
}

void StoredStream::decode(std::string& to, std::size_t size) {
    std::string_view text = left();
    std::array<int, 4> letter;
    std::size_t letters = 0;
    while (to.size() < size) {
        if (text.empty()) text = left();
        if (text.empty())
            refuse_vtk(place_, fmt::format("ends after {} of {} bytes; {}", to.size(), size, kWriteAgain));
        const int value = letter_values[static_cast<unsigned char>(text[0])];
        if (value == no_letter)
            refuse_vtk(place_,
                       fmt::format("\"{}\" within base64; {}", excerpt(text.substr(0, 1)), kWriteAgain));
        text.remove_prefix(1);
        ++next_;
        if (value == blank) continue;
        letter[letters++] = value;
        if (letters < 4) continue;
        letters = 0;
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
        bytes.reserve(size);
        content_.each_piece(next_, next_ + size, [&](std::string_view piece) { bytes += piece; });
        next_ += size;
        return bytes;
    }
    bytes = std::move(spare_);
    bytes.reserve(size + 3);
    decode(bytes, size);
    spare_ = bytes.substr(size);
    bytes.resize(size);
    return bytes;
}

void stored_array(const Content& content, const StoredText& text, const VtkCoding& coding,
                  std::optional<std::uint64_t> wanted, const VtkPlace& place, const TakeBytes& take) {
    check_compressor(coding, place);
    StoredStream stream(content, text.begin, text.end, text.base64, place);
    if (coding.compressor != VtkCompressor::none) return packed_array(stream, coding, wanted, place, take);
    std::uint64_t left = plain_length(stream, coding, wanted, place);
    if (left > stream.at_most()) stream.take(left);  // refuses it
    while (left > 0) {
        const std::uint64_t piece = std::min<std::uint64_t>(left, Content::kPiece);
        take(stream.take(piece));
        left -= piece;
    }
}

void check_stored_array(const Content& content, const StoredText& text, const VtkCoding& coding,
                        std::optional<std::uint64_t> wanted, const VtkPlace& place) {
    check_compressor(coding, place);
    StoredStream stream(content, text.begin, text.end, text.base64, place);
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
