#include "engine/questions/expressions/expression.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"

namespace grainreel {

Expression::Expression(std::string_view text, const Vocabulary& words) {
    ExpressionParser(text, words, *this).parse();
}

namespace {

// Values are NaN where they are unknown, and so is what depends on them. Truths are 0, 1 or NaN, with
// Kleene's three-valued logic: "a or b" is true if one is true, whatever the other is. (S. C. Kleene,
// Introduction to Metamathematics, 1952, section 64.)

template <class Of>
double known_both(double a, double b, const Of& of) {
    return std::isnan(a) || std::isnan(b) ? kUnknown : static_cast<double>(of(a, b));
}

double opposite(double truth) {
    return std::isnan(truth) ? kUnknown : static_cast<double>(truth == 0);
}

double either(double a, double b) {
    if (a == 1 || b == 1) return 1;
    return std::isnan(a) || std::isnan(b) ? kUnknown : 0;
}

}  // namespace

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
            return either(first(), second());
        case Op::both:
            return opposite(either(opposite(first()), opposite(second())));
        case Op::opposite:
            return opposite(first());
        case Op::less:
            return known_both(first(), second(), std::less());
        case Op::less_equal:
            return known_both(first(), second(), std::less_equal());
        case Op::equal:
            return known_both(first(), second(), std::equal_to());
        case Op::unequal:
            return known_both(first(), second(), std::not_equal_to());
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
            return known_both(first(), second(), [](double a, double b) { return std::min(a, b); });
        case Op::most:
            return known_both(first(), second(), [](double a, double b) { return std::max(a, b); });
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
