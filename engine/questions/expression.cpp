#include "engine/questions/expression.hpp"

#include <algorithm>
#include <cmath>

#include "engine/questions/expression_parser.hpp"

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
            return std::pow(first(), node.value);
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

}  // namespace grainreel
