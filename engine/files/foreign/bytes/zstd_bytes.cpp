// zstd: RFC 8878, frames one behind the other are one content.
#include <zstd.h>
#include <zstd_errors.h>

#include <memory>
#include <new>

#include "engine/files/foreign/bytes/packed_bytes.hpp"

namespace grainreel {
namespace {

class ZstdBytes : public PackedBytes {
  public:
    explicit ZstdBytes(std::unique_ptr<FileBytes> file)
        : PackedBytes(std::move(file)), stream_(ZSTD_createDStream(), &ZSTD_freeDStream) {
        if (!stream_) throw std::bad_alloc();
    }

  private:
    void begin_again() override {
        ZSTD_DCtx_reset(stream_.get(), ZSTD_reset_session_only);
        wants_ = 0;
    }

    std::size_t unpack(char* to, std::size_t size) override {
        ZSTD_outBuffer out{to, size, 0};
        while (out.pos == 0) {
            // Where all was read, zstd may still hold unpacked bytes that found no room in the call before.
            const bool more = fill();
            ZSTD_inBuffer in{packed(), left(), 0};
            if (!more && wants_ == 0) return 0;
            const std::size_t result = ZSTD_decompressStream(stream_.get(), &out, &in);
            use(in.pos);
            if (ZSTD_isError(result)) refuse(result);
            wants_ = result;
            if (!more && out.pos == 0) {
                cut_off_ = true;
                return 0;
            }
        }
        return out.pos;
    }

    [[noreturn]] void refuse(std::size_t result) const {
        if (ZSTD_getErrorCode(result) == ZSTD_error_frameParameter_windowTooLarge)
            damaged(
                "packed by zstd --long with a window above 128 MB, which is not read; unpack it by zstd -d");
        damaged(ZSTD_getErrorName(result));
    }

    std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream_;
    std::size_t wants_ = 0;  // 0 between two frames
};

}  // namespace

std::unique_ptr<ByteSource> zstd_bytes(std::unique_ptr<FileBytes> file) {
    return std::make_unique<ZstdBytes>(std::move(file));
}

}  // namespace grainreel
