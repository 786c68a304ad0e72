#include "engine/scene/text/assignment.hpp"

#include "engine/base/text.hpp"

namespace grainreel {
namespace {

std::string trimmed(const std::string& text) {
    const auto first = text.find_first_not_of(" \t");
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

std::string Assignment::key() const {
    return trimmed(text.substr(0, text.find('=')));
}

std::string Assignment::value() const {
    const auto equals = text.find('=');
    return equals == std::string::npos ? "" : trimmed(text.substr(equals + 1));
}

std::string Assignment::place() const {
    return option.empty() ? "--set " + excerpt(key()) : option;
}

}  // namespace grainreel
