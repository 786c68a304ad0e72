#include "render/page/embed/read_bytes.hpp"

#include <fstream>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"

namespace grainreel {

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path) {
    constexpr std::uintmax_t most = 64'000'000;
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) throw RunError(fmt::format("{}: cannot be read: {}", path.string(), error.message()));
    if (size > most)
        throw RunError(fmt::format("{}: has {} bytes, too many for a page", path.string(), size));
    std::vector<std::uint8_t> bytes(size);
    std::ifstream file = read_plain(path);
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (!file) throw RunError(fmt::format("{}: cannot be read", path.string()));
    return bytes;
}

}  // namespace grainreel
