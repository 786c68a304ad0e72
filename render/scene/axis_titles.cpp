#include "render/scene/axis_titles.hpp"

#include <fmt/format.h>
#include <array>
#include <string_view>

namespace grainreel {

std::string with_unit(const std::string& words, const std::string& unit) {
    return unit.empty() ? words : fmt::format("{} ({})", words, unit);
}

LabelParts label_parts(const std::string& label, Dimension dimension) {
    constexpr std::array<std::array<std::string_view, 2>, 4> writings{
        {{" (", ")"}, {" [", "]"}, {", ", ""}, {" in ", ""}}};
    if (dimension == Dimension::number) return {label, ""};
    for (const auto& [before, after] : writings) {
        const std::size_t at = label.rfind(before);
        if (at == std::string::npos || at == 0 || !label.ends_with(after)) continue;
        const std::size_t from = at + before.size();
        if (from + after.size() > label.size()) continue;
        const std::string unit = label.substr(from, label.size() - after.size() - from);
        if (unit_size_in(unit, dimension)) return {label.substr(0, at), unit};
    }
    return {label, ""};
}

std::string with_unit(const std::string& words, const std::string& unit, Dimension dimension) {
    return with_unit(label_parts(words, dimension).words, unit);
}

}  // namespace grainreel
