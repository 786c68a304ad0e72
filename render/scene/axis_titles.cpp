#include "render/scene/axis_titles.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace grainreel {

namespace {

// The label's words without the unit that it says. is_unit: whether a text is one of the units looked for.
template <class IsUnit>
LabelParts parts_of(const std::string& label, const IsUnit& is_unit) {
    constexpr std::array<std::array<std::string_view, 2>, 4> writings{
        {{"(", ")"}, {"[", "]"}, {", ", ""}, {" in ", ""}}};
    for (const auto& [before, after] : writings) {
        const std::size_t end = label.size() - std::min(label.size(), after.size()),
                          open = label.rfind(before);
        if (open == std::string::npos || open == 0 || open + before.size() > end) continue;
        const std::string unit = label.substr(open + before.size(), end - open - before.size());
        if (!label.ends_with(after) || !is_unit(unit)) continue;
        return {label.substr(0, open - (label[open - 1] == ' ' ? 1 : 0)), unit};
    }
    return {label, ""};
}

// Whether the label names the unit: as a word by itself, perhaps in the plural.
bool names(const std::string& label, const std::string& unit) {
    const auto is_apart = [&](std::size_t i) {
        return i >= label.size() || std::string_view(" ,;:()[]").find(label[i]) != std::string_view::npos;
    };
    for (std::size_t i = label.find(unit); i != std::string::npos; i = label.find(unit, i + 1)) {
        const std::size_t end = i + unit.size();
        const bool whole = is_apart(end) || (label[end] == 's' && is_apart(end + 1));  // "degrees"
        if (whole && (i == 0 || is_apart(i - 1))) return true;
    }
    return false;
}

}  // namespace

std::string with_unit(const std::string& words, const std::string& unit) {
    return unit.empty() ? words : fmt::format("{} ({})", words, unit);
}

LabelParts label_parts(const std::string& label, Dimension dimension) {
    if (dimension == Dimension::number) return {label, ""};
    return parts_of(label, [&](const std::string& unit) { return bool(unit_size_in(unit, dimension)); });
}

std::string with_unit(const std::string& words, const std::string& unit, Dimension dimension) {
    return with_unit(label_parts(words, dimension).words, unit);
}

std::string axis_title(const std::string& label, const std::string& unit) {
    return unit.empty() || names(label, unit) ? label : with_unit(label, unit);
}

ShownUnit shown_unit(const std::string& label, const std::string& unit) {
    const std::optional<AnyUnit> own = unit.empty() || names(label, unit) ? std::nullopt : parse_unit(unit);
    if (!own) return {unit, 1};
    std::optional<AnyUnit> said;
    const LabelParts parts = parts_of(label, [&](const std::string& name) {
        said = parse_unit(name);
        return said && said->powers == own->powers && said->size > 0;
    });
    return parts.unit.empty() ? ShownUnit{unit, 1} : ShownUnit{parts.unit, own->size / said->size};
}

}  // namespace grainreel
