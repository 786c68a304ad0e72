#include "engine/scene/keys/bound_key.hpp"

#include <fmt/format.h>

namespace grainreel::keys {

std::string initial_text(double value) {
    return fmt::format("{}", value);
}

std::string initial_text(const Vec3& value) {
    return fmt::format("[{}, {}, {}]", value.x(), value.y(), value.z());
}

void read_value(Document& document, const std::string& path, double& value) {
    if (const auto given = document.quantity(path)) value = *given;
}

void read_value(Document& document, const std::string& path, bool& value) {
    if (const auto given = document.flag(path)) value = *given;
}

void read_value(Document& document, const std::string& path, int& value) {
    if (const auto given = document.integer(path)) value = static_cast<int>(*given);
}

void read_value(Document& document, const std::string& path, std::int64_t& value) {
    if (const auto given = document.integer(path)) value = *given;
}

void read_value(Document& document, const std::string& path, std::uint64_t& value) {
    if (const auto given = document.integer(path)) value = static_cast<std::uint64_t>(*given);
}

void read_value(Document& document, const std::string& path, std::string& value) {
    if (const auto given = document.text(path)) value = *given;
}

void read_value(Document& document, const std::string& path, Vec3& value) {
    if (const auto given = document.vector(path)) value = *given;
}

}  // namespace grainreel::keys
