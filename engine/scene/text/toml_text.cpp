#include "engine/scene/text/toml_text.hpp"

#include <cmath>

#include <fmt/format.h>

namespace grainreel {

std::string toml_number(double value) {
    if (std::isnan(value)) return "nan";
    if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
    std::string text = fmt::format("{}", value);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            result += '\\';
            result += c;
        } else if (byte < 0x20 || byte == 0x7f) {
            result += fmt::format("\\u{:04x}", byte);
        } else {
            result += c;
        }
    }
    return result + "\"";
}

std::string toml_list(const std::vector<std::string>& values) {
    return fmt::format("[{}]", fmt::join(values, ", "));
}

std::string names_text(const std::vector<std::string>& names) {
    std::vector<std::string> words;
    for (const std::string& name : names) words.push_back(quoted(name));
    return words.empty() ? "" : toml_list(words);
}

// A phase beyond one turn needs its unit, without which the reader takes it for a mistake.
std::string as_toml(double value, Dimension dimension) {
    const bool many_turns = dimension == Dimension::phase && std::abs(value) > 1;
    return many_turns ? quoted(fmt::format("{} turn", value)) : toml_number(value);
}

std::string as_toml(const Vec3& value, Dimension) {
    return toml_list({toml_number(value.x()), toml_number(value.y()), toml_number(value.z())});
}

std::string as_toml(const std::string& value, Dimension) {
    return quoted(value);
}

void SceneText::put(const std::string& key, const std::string& value) {
    if (value.empty()) return;
    if (const auto found = remarks_.find(key); found != remarks_.end()) {
        comment(found->second);
        remarks_.erase(found);
    }
    text_ += fmt::format("{} = {}\n", key, value);
}

}  // namespace grainreel
