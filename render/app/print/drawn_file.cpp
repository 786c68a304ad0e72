#include "render/app/print/drawn_file.hpp"

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"

namespace grainreel {
namespace {

std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

RunError not_gnuplots(const std::filesystem::path& file) {
    return RunError(fmt::format("{}: is not as gnuplot writes it; is this version of gnuplot known to work?",
                                file.string()));
}

// CRC of PNG's chunks: ISO 3309, PNG specification, annex D.
std::uint32_t crc(std::string_view bytes) {
    std::uint32_t sum = 0xffffffffu;
    for (const char byte : bytes) {
        sum ^= static_cast<unsigned char>(byte);
        for (int bit = 0; bit < 8; ++bit) sum = (sum & 1u) != 0 ? 0xedb88320u ^ (sum >> 1u) : sum >> 1u;
    }
    return sum ^ 0xffffffffu;
}

std::string big_endian(std::uint32_t number) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>((number >> shift) & 0xffu);
    return bytes;
}

}  // namespace

void say_size_in_mm(const std::filesystem::path& svg, double width_mm) {
    std::string text = bytes_of(svg);
    constexpr std::string_view size_begins = " width=\"";
    const std::size_t begin = text.find(size_begins);
    unsigned wide = 0, high = 0;
    int length = 0;
    if (begin == std::string::npos ||
        std::sscanf(text.c_str() + begin, " width=\"%u\" height=\"%u\"%n", &wide, &high, &length) != 2 ||
        length == 0 || wide == 0)
        throw not_gnuplots(svg);
    text.replace(begin, static_cast<std::size_t>(length),
                 fmt::format(" width=\"{:.6g}mm\" height=\"{:.6g}mm\"", width_mm, width_mm * high / wide));
    constexpr std::string_view font = "font-family=\"DejaVu Sans\"",
                               any = "font-family=\"DejaVu Sans, Verdana, Arial, sans-serif\"";
    for (std::size_t at = text.find(font); at != std::string::npos; at = text.find(font, at + any.size()))
        text.replace(at, font.size(), any);
    replace_file(svg, text);
}

void say_dots(const std::filesystem::path& png, double dpi) {
    std::string bytes = bytes_of(png);
    constexpr std::size_t behind_head = 33;  // signature, and the chunk IHDR
    constexpr double inch = 0.0254;          // m
    if (bytes.size() < behind_head || bytes.compare(12, 4, "IHDR") != 0) throw not_gnuplots(png);
    const std::string dots = big_endian(static_cast<std::uint32_t>(dpi / inch + 0.5));
    const std::string chunk = "pHYs" + dots + dots + '\1';  // a metre
    constexpr std::uint32_t length = 9;
    bytes.insert(behind_head, big_endian(length) + chunk + big_endian(crc(chunk)));
    replace_file(png, bytes);
}

}  // namespace grainreel
