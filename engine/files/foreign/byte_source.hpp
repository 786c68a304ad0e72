// The bytes of a file behind gzip (several members too) and zstd. The content decides, not the suffix.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "engine/files/frames/frame_archive.hpp"

namespace grainreel {

enum class Packing { none, gzip, zstd };

// The first kHeadBytes of a file's content, unpacked. Throws UserError where the file is no ordinary file,
// cannot be opened, or is packed in a way that is not read (xz, lzma, bzip2: refused by name).
FileHead unpacked_head(const std::filesystem::path& file);

// A stream of a file's content from its beginning.
class ByteSource {
  public:
    virtual ~ByteSource() = default;
    // Up to `size` bytes; fewer only at the end. Throws UserError where the packed bytes are damaged.
    virtual std::size_t read(char* to, std::size_t size) = 0;
    // Whether the packed stream ended before its end: the bytes until there were given.
    virtual bool cut_off() const = 0;
    // To a place of the unpacked content. Packed files are read from the beginning again where it lies
    // behind.
    virtual void seek(std::uint64_t place) = 0;
};

Packing packing_of(const std::filesystem::path& file);
std::unique_ptr<ByteSource> open_bytes(const std::filesystem::path& file);

// All of a file, unpacked. Throws UserError where there are more than `most` bytes.
std::string all_bytes(const std::filesystem::path& file, std::uint64_t most = std::uint64_t{1} << 33);

}  // namespace grainreel
