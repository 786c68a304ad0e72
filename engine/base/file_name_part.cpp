#include "engine/base/file_name_part.hpp"

#include <cctype>

namespace grainreel {

std::string file_name_part(const std::string& text, std::size_t most) {
    std::string name;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain = byte < 0x80 && (std::isalnum(byte) || c == '-' || c == '.' || c == '_');
        if (c != ' ') name += plain ? c : '-';
    }
    if (name.empty() || name.front() == '.') name.insert(0, 1, '_');
    return name.substr(0, most);
}

}  // namespace grainreel
