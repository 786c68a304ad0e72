#include "render/page/embed.hpp"

#include <fmt/format.h>
#include <libdeflate.h>
#include <algorithm>
#include <fstream>
#include <memory>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"

namespace grainreel {

std::string html_text(std::string_view text) {
    std::string result;
    for (const char c : text) {
        const bool control = (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') || c == 0x7f;
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\'':
                result += "&#39;";
                break;
            default:
                if (control)
                    result += "\xef\xbf\xbd";
                else
                    result += c;
        }
    }
    return result;
}

std::string json_in_html(std::string json) {
    for (std::size_t place = json.find('<'); place != std::string::npos; place = json.find('<', place))
        json.replace(place, 1, "\\u003c");
    return json;
}

std::string file_link(std::string_view name) {
    std::string link = "./";
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                           c == '.' || c == '-' || c == '_';
        link += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
    }
    return link;
}

std::string filled(std::string_view page,
                   const std::vector<std::pair<std::string_view, std::string>>& texts) {
    std::string result;
    while (true) {
        const std::size_t open = page.find("{{");
        result += page.substr(0, open);
        if (open == std::string_view::npos) return result;
        const std::size_t close = page.find("}}", open);
        GRAINREEL_CHECK(close != std::string_view::npos);
        const std::string_view name = page.substr(open + 2, close - open - 2);
        const auto named =
            std::find_if(texts.begin(), texts.end(), [&](const auto& text) { return text.first == name; });
        GRAINREEL_CHECK(named != texts.end());
        result += named->second;
        page.remove_prefix(close + 2);
    }
}

std::string base64(std::span<const std::uint8_t> bytes) {
    constexpr char signs[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (k < left ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += k <= left ? signs[three >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string blob(const std::string& id, std::span<const std::uint8_t> bytes) {
    if (bytes.empty()) return "";
    return fmt::format("<script type=\"application/octet-stream\" id=\"{}\">{}</script>\n", id,
                       base64(bytes));
}

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path) {
    constexpr std::uintmax_t most = 64'000'000;
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) throw RunError("{}: cannot be read: {}", path.string(), error.message());
    if (size > most) throw RunError("{}: has {} bytes, too many for a page", path.string(), size);
    std::vector<std::uint8_t> bytes(size);
    std::ifstream file = read_plain(path);
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (!file) throw RunError("{}: cannot be read", path.string());
    return bytes;
}

std::vector<std::uint8_t> zlib_packed(std::span<const std::uint8_t> bytes) {
    constexpr int level = 6;  // higher levels save less than 1 % on places
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
        libdeflate_alloc_compressor(level), libdeflate_free_compressor);
    if (!compressor) throw RunError("report: no memory to pack the page's bytes");
    std::vector<std::uint8_t> packed(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
    packed.resize(
        libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), packed.data(), packed.size()));
    return packed;
}

}  // namespace grainreel
