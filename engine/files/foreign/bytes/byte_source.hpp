// The bytes of a file, decompressed ("unpacked") if it is gzip (also with several members) or zstd. The
// content decides, not the suffix. All readers of other programs' files take their bytes from here.
#pragma once

#include <sys/types.h>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "engine/base/system/file_state.hpp"
#include "engine/files/frames/state_archive.hpp"

namespace grainreel {

enum class Packing { none, gzip, zstd };

// The first kHeadBytes of a file's content, unpacked. Throws UserError where the file is no ordinary file,
// cannot be opened, or is packed in a way that is not read (such as xz, bzip2 and zip, which are refused by
// name).
FileStart unpacked_head(const std::filesystem::path& file);

// A stream of a file's content from its beginning.
class ByteSource {
  public:
    virtual ~ByteSource() = default;
    // Reads up to `size` bytes; fewer only at the end. Throws UserError where the packed bytes are damaged.
    virtual std::size_t read(char* to, std::size_t size) = 0;
    // Whether the packed stream ended too early; the bytes before that were given.
    virtual bool cut_off() const = 0;
    // Goes to a place of the unpacked content. To go back, a packed file is read from the beginning again.
    virtual void seek(std::uint64_t place) = 0;
};

Packing packing_of(const std::filesystem::path& file);
std::unique_ptr<ByteSource> open_bytes(const std::filesystem::path& file);

// The whole content of a file, unpacked. Throws UserError where it has more than `most` bytes.
std::string all_bytes(const std::filesystem::path& file, std::uint64_t most = std::uint64_t{1} << 33);

// An ordinary file that is read at any place. It is not mapped into memory: if another program truncates it
// meanwhile, reading must end with a message. With a mapped file, a signal would end the process.
class FileBytes {
  public:
    // Throws UserError where there is no ordinary file or where it cannot be opened.
    explicit FileBytes(const std::filesystem::path& file);
    ~FileBytes();
    FileBytes(const FileBytes&) = delete;
    FileBytes& operator=(const FileBytes&) = delete;

    const std::filesystem::path& path() const { return path_; }
    FileState state() const;
    // Reads up to `size` bytes from a place on; fewer only at the end of the file. Throws UserError where the
    // disk fails.
    std::size_t read_at(std::uint64_t place, char* to, std::size_t size) const;

  private:
    std::filesystem::path path_;
    int file_ = -1;
};

// The path as messages show it.
std::string shown(const std::filesystem::path& file);

// Reads gzip with one or several members. Zero bytes between and after members are skipped.
std::unique_ptr<ByteSource> gzip_bytes(std::unique_ptr<FileBytes> file);
// Reads zstd with one or several frames; skippable frames are skipped.
std::unique_ptr<ByteSource> zstd_bytes(std::unique_ptr<FileBytes> file);

// The base of both: reads the packed bytes piece by piece, and goes to a place of the content.
class PackedBytes : public ByteSource {
  public:
    explicit PackedBytes(std::unique_ptr<FileBytes> file);

    std::size_t read(char* to, std::size_t size) final;
    bool cut_off() const final { return cut_off_; }
    void seek(std::uint64_t place) final;

  protected:
    // Gives some unpacked bytes; none at the end. It may set cut_off_.
    virtual std::size_t unpack(char* to, std::size_t size) = 0;
    virtual void begin_again() = 0;

    // Makes sure that there are packed bytes which were not used yet. Returns whether there are any.
    bool fill();
    std::uint64_t packed_size() const { return file_->state().size; }
    const char* packed() const { return piece_.get() + used_; }
    std::size_t left() const { return held_ - used_; }
    void use(std::size_t bytes) { used_ += bytes; }
    // Throws UserError with the place in the packed file.
    [[noreturn]] void damaged(const std::string& why) const;

    bool cut_off_ = false;

  private:
    std::unique_ptr<FileBytes> file_;
    std::unique_ptr<char[]> piece_;
    std::size_t held_ = 0, used_ = 0;
    std::uint64_t read_ = 0;   // number of packed bytes read
    std::uint64_t place_ = 0;  // present place in the unpacked content
};

}  // namespace grainreel
