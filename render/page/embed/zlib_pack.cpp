#include "render/page/embed/zlib_pack.hpp"

#include <libdeflate.h>

#include <memory>

#include "engine/base/error.hpp"

namespace grainreel {

std::vector<std::uint8_t> zlib_packed(std::span<const std::uint8_t> bytes) {
    constexpr int level = 6;  // higher ones gain less than 1 % on places
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
        libdeflate_alloc_compressor(level), libdeflate_free_compressor);
    if (!compressor) throw RunError("report: no memory to pack the page's bytes");
    std::vector<std::uint8_t> packed(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
    packed.resize(
        libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), packed.data(), packed.size()));
    return packed;
}

}  // namespace grainreel
