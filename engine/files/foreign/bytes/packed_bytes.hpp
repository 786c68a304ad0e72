// Sources of bytes behind a packing. Each reads its file from the beginning; a place behind the present one
// is reached by beginning again.
#pragma once

#include <memory>

#include "engine/files/foreign/byte_source.hpp"
#include "engine/files/foreign/bytes/file_bytes.hpp"

namespace grainreel {

// Reads one member or several. Zero bytes between and behind them are passed over.
std::unique_ptr<ByteSource> gzip_bytes(std::unique_ptr<FileBytes> file);
// Reads one frame or several, and passes over those that are to be skipped.
std::unique_ptr<ByteSource> zstd_bytes(std::unique_ptr<FileBytes> file);

// What both have in common: the packed bytes, a piece at a time, and the way to a place.
class PackedBytes : public ByteSource {
  public:
    explicit PackedBytes(std::unique_ptr<FileBytes> file);

    std::size_t read(char* to, std::size_t size) final;
    bool cut_off() const final { return cut_off_; }
    void seek(std::uint64_t place) final;

  protected:
    // Some unpacked bytes; none at the end. It may set cut_off_.
    virtual std::size_t unpack(char* to, std::size_t size) = 0;
    virtual void begin_again() = 0;

    // The packed bytes that were not used yet, at least one. Returns whether there are any.
    bool fill();
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
    std::uint64_t read_ = 0;   // packed bytes that were read
    std::uint64_t place_ = 0;  // in the unpacked content
};

}  // namespace grainreel
