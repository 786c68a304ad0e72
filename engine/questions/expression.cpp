#include "engine/questions/expression.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/mathematics.hpp"

namespace grainreel {

Expression::Expression(std::string_view text, const Vocabulary& words) {
    ExpressionParser(text, words, *this).parse();
}

double Expression::of(const std::vector<double>& values) const {
    return of(nodes_.size() - 1, values);
}

double Expression::of(std::size_t at, const std::vector<double>& values) const {
    const Node& node = nodes_[at];
    const auto first = [&] { return of(node.first, values); };
    const auto second = [&] { return of(node.second, values); };
    switch (node.op) {
        case Op::constant:
            return node.value;
        case Op::column:
            return values[node.first];
        case Op::either:
            return first() != 0 || second() != 0;
        case Op::both:
            return first() != 0 && second() != 0;
        case Op::opposite:
            return first() == 0;
        case Op::less:
            return first() < second();
        case Op::less_equal:
            return first() <= second();
        case Op::equal:
            return first() == second();
        case Op::unequal: {
            const double a = first(), b = second();
            return a < b || a > b;  // not so for NaN
        }
        case Op::plus:
            return first() + second();
        case Op::minus:
            return first() - second();
        case Op::times:
            return first() * second();
        case Op::over:
            return first() / second();
        case Op::negative:
            return -first();
        case Op::power:
            return math::pow(first(), node.value);
        case Op::absolute:
            return std::abs(first());
        case Op::root:
            return std::sqrt(first());
        case Op::least:
            return std::min(first(), second());
        case Op::most:
            return std::max(first(), second());
    }
    return 0;
}

namespace {

constexpr std::array named = {
    Dimension::length, Dimension::time,     Dimension::frequency, Dimension::speed,   Dimension::acceleration,
    Dimension::spin,   Dimension::angle,    Dimension::mass,      Dimension::density, Dimension::force,
    Dimension::energy, Dimension::pressure, Dimension::stiffness};

}  // namespace

Powers powers_of(Dimension dimension) {
    if (dimension == Dimension::number) return {};
    return parse_unit(text_of(dimension).unit).value().powers;
}

bool same_powers(const Powers& a, const Powers& b) {
    for (std::size_t k = 0; k < a.size(); ++k)
        if (std::abs(a[k] - b[k]) > 1e-9) return false;
    return true;
}

bool is_plain(const Powers& powers) {
    return same_powers(powers, Powers{});
}

std::string noun_of_powers(const Powers& powers) {
    if (is_plain(powers)) return "a plain number";
    for (const Dimension dimension : named)
        if (same_powers(powers, powers_of(dimension))) return text_of(dimension).noun;
    constexpr std::array base = {"m", "kg", "s", "rad"};
    std::string unit;
    for (std::size_t k = 0; k < powers.size(); ++k)
        if (powers[k] != 0)
            unit += fmt::format("{}{}{}", unit.empty() ? "" : ".", base[k],
                                powers[k] == 1 ? "" : fmt::format("{:g}", powers[k]));
    return "a number in " + unit;
}

}  // namespace grainreel
