// gzip: RFC 1952, members one behind the other are one content.
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>

#include "engine/files/foreign/bytes/packed_bytes.hpp"

namespace grainreel {
namespace {

constexpr int gzip_window = 15 + 16;  // zlib: the largest window, with the head and the sum of gzip

class GzipBytes : public PackedBytes {
  public:
    explicit GzipBytes(std::unique_ptr<FileBytes> file) : PackedBytes(std::move(file)) {
        if (inflateInit2(&stream_, gzip_window) != Z_OK) throw std::bad_alloc();
    }
    ~GzipBytes() override { inflateEnd(&stream_); }

  private:
    void begin_again() override {
        inflateReset(&stream_);
        between_ = true;
    }

    // To the next member. Returns whether there is one.
    bool next_member() {
        while (fill()) {
            if (*packed() != 0) break;
            use(1);  // tapes and some copies fill up with zeros
        }
        if (left() == 0) return false;
        if (static_cast<unsigned char>(*packed()) != 0x1f)
            damaged("behind a whole part stand bytes that are no gzip");
        inflateReset(&stream_);
        between_ = false;
        return true;
    }

    std::size_t unpack(char* to, std::size_t size) override {
        while (true) {
            if (between_ && !next_member()) return 0;
            if (!fill()) {
                cut_off_ = true;
                return 0;
            }
            constexpr std::size_t most = std::numeric_limits<uInt>::max() / 2;
            const auto room = static_cast<uInt>(std::min(size, most));
            stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed()));
            stream_.avail_in = static_cast<uInt>(left());
            stream_.next_out = reinterpret_cast<Bytef*>(to);
            stream_.avail_out = room;
            const int result = inflate(&stream_, Z_NO_FLUSH);
            use(left() - stream_.avail_in);
            if (result == Z_MEM_ERROR) throw std::bad_alloc();
            if (result == Z_STREAM_END)
                between_ = true;
            else if (result != Z_OK && result != Z_BUF_ERROR)
                damaged(stream_.msg != nullptr ? stream_.msg : "it needs a dictionary");
            if (stream_.avail_out < room) return room - stream_.avail_out;
        }
    }

    z_stream stream_{};
    bool between_ = true;  // of two members, or at the beginning
};

}  // namespace

std::unique_ptr<ByteSource> gzip_bytes(std::unique_ptr<FileBytes> file) {
    return std::make_unique<GzipBytes>(std::move(file));
}

}  // namespace grainreel
