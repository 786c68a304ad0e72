#include "render/library/png_file.hpp"

#include <cerrno>
#include <cstring>
#include <system_error>

#include <fmt/format.h>
#include <png.h>

#include "engine/base/error.hpp"

namespace grainreel {

void write_png_file(const std::filesystem::path& path, int width, int height,
                    const std::vector<std::uint8_t>& rgba) {
    std::filesystem::path part = path;
    part += ".part";
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(width);
    png.height = static_cast<png_uint_32>(height);
    png.format = PNG_FORMAT_RGBA;
    std::error_code error;
    errno = 0;
    if (png_image_write_to_file(&png, part.c_str(), 0, rgba.data(), 0, nullptr) == 0) {
        const std::string why = errno != 0 ? std::strerror(errno) : png.message;
        std::filesystem::remove(part, error);
        throw RunError(fmt::format("{}: cannot be written: {}", path.string(), why));
    }
    std::filesystem::rename(part, path, error);
    if (!error) return;
    const std::string why = error.message();
    std::filesystem::remove(part, error);
    throw RunError(fmt::format("{}: cannot be written: {}", path.string(), why));
}

}  // namespace grainreel
