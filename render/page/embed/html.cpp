#include "render/page/embed/html.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/error.hpp"

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
    for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at))
        json.replace(at, 1, "\\u003c");
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
        const auto found =
            std::find_if(texts.begin(), texts.end(), [&](const auto& text) { return text.first == name; });
        GRAINREEL_CHECK(found != texts.end());
        result += found->second;
        page.remove_prefix(close + 2);
    }
}

}  // namespace grainreel
