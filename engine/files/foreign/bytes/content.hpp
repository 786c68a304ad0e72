// The unpacked content of a file, read at any place. A large content is read piece by piece, so that a packed
// file which unpacks to gigabytes takes no more memory than another.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "engine/files/foreign/bytes/byte_source.hpp"

namespace grainreel {

class Content {
  public:
    // Throws UserError as open_bytes() does.
    explicit Content(const std::filesystem::path& file);
    // A content that is in memory already, such as the head of a file.
    Content(std::filesystem::path file, std::string bytes);

    const std::filesystem::path& file() const { return file_; }
    // Number of bytes. To learn it, a large packed file is unpacked once.
    std::uint64_t size() const;
    bool knows_size() const { return size_ != npos; }
    // At least so many bytes from a place on, fewer only at the end of the content. They are valid until the
    // next call.
    std::string_view from(std::uint64_t place, std::size_t least = kPiece) const;
    // Whether the content has nothing from this place on. What from() returned is not valid any more.
    bool ends_at(std::uint64_t place) const;
    // Calls `take` with the bytes of [begin, end), piece by piece.
    void each_piece(std::uint64_t begin, std::uint64_t end,
                    const std::function<void(std::string_view)>& take) const;
    // The line of a byte, from 1.
    std::int64_t line_of(std::uint64_t place) const;

    static constexpr std::size_t kPiece = std::size_t{1} << 20;
    static constexpr std::uint64_t npos = ~std::uint64_t{0};

  private:
    void read_window(std::uint64_t place, std::size_t least) const;

    std::filesystem::path file_;
    // Null where all of the content is in the window.
    std::unique_ptr<ByteSource> source_;
    mutable std::string window_;
    mutable std::uint64_t window_begin_ = 0;
    mutable std::uint64_t size_ = npos;  // npos: not known yet
};

}  // namespace grainreel
