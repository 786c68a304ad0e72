#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/questions/grain_list.hpp"
#include "engine/questions/questions.hpp"
#include "engine/scene/text/units.hpp"

namespace grainreel {
namespace {

struct Plane {
    int axis = 0;      // 0 to 2
    double place = 0;  // m
};

// "y=0", "z = 2 cm".
Plane plane_of(const std::string& text) {
    const std::size_t equal = text.find('=');
    const std::size_t letter = text.find_first_not_of(' ');
    const bool named =
        equal != text.npos && letter < equal && text.find_first_not_of(' ', letter + 1) == equal;
    const std::size_t axis = named ? std::string("xyz").find(text[letter]) : std::string::npos;
    if (axis == std::string::npos)
        throw UserError(fmt::format("'{}' is no plane; write for example y=0 or \"z = 2 cm\"", text));
    const std::string value = text.substr(equal + 1);
    const bool bare_zero = value.find_first_not_of(" 0.") == std::string::npos && !value.empty();
    return {static_cast<int>(axis), bare_zero ? 0 : parse_quantity(value, Dimension::length, "y = 2 mm")};
}

}  // namespace

Answer slice_answer(const Snapshot& s, const std::string& plane, std::size_t most) {
    const Plane cut = plane_of(plane);
    std::vector<std::size_t> found;
    const auto off = [&](std::size_t i) { return std::abs(s.frame.position[i][cut.axis] - cut.place); };
    for (std::size_t i = 0; i < s.frame.size(); ++i)
        if (off(i) < s.frame.radius[i]) found.push_back(i);
    const auto circle = [&](std::size_t i) {
        return std::sqrt(std::pow(s.frame.radius[i], 2) - std::pow(off(i), 2));
    };
    AnswerTable areas{
        "areas",
        fmt::format("Grains that the plane {} cuts", plane),
        {{"species", Dimension::number, "", AnswerColumn::kKey},
         {"grains", Dimension::number, ""},
         {"area_share", Dimension::number, "of the area of all cut circles", AnswerColumn::kThere}},
        {},
        true};
    std::vector<double> area(s.scene.species.size(), 0);
    std::vector<std::int64_t> count(area.size(), 0);
    double all = 0;
    for (const std::size_t i : found) {
        const double own = std::pow(circle(i), 2);
        const auto species = static_cast<std::size_t>(s.frame.species[i]);
        ++count[species], area[species] += own, all += own;
    }
    for (std::size_t k = 0; k < area.size(); ++k) {
        AnswerCell share;
        if (all > 0) share = area[k] / all;
        areas.rows.push_back({s.scene.species[k].name, count[k], share});
    }
    Answer answer{{std::move(areas)}, {}};
    add_grain_list(answer, s, found, most,
                   {{{"circle_radius", Dimension::length, "of its circle in the plane"}, circle}});
    return answer;
}

}  // namespace grainreel
