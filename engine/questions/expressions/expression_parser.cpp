// Reads an expression and makes its tree. Messages about mistakes give the place.
#include "engine/questions/expressions/expression.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/text.hpp"

namespace grainreel {
namespace {

constexpr std::size_t longest = 4096;  // characters
constexpr int deepest = 100;           // parentheses, signs and functions inside each other
constexpr int largest_power = 9;

const std::array<std::string_view, 3> joining_words = {"and", "or", "not"};
const std::array<std::string_view, 4> functions = {"abs", "sqrt", "min", "max"};

bool is_letter(char c) {
    const auto u = static_cast<unsigned char>(c);
    return std::isalpha(u) || c == '_' || u >= 0x80;
}

bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c));
}

ValueType truth() {
    return {ValueType::Kind::truth, {}};
}

ValueType number_of(const Powers& powers) {
    return {ValueType::Kind::number, powers};
}

std::string noun_of(const ValueType& type) {
    if (type.kind == ValueType::Kind::truth) return "a condition";
    if (type.kind == ValueType::Kind::species) return "a species";
    return noun_of_powers(type.powers);
}

}  // namespace

void ExpressionParser::parse() {
    if (text_.size() > longest) fail(longest, fmt::format("is longer than {} characters", longest));
    skip_spaces();
    if (at_ == text_.size()) fail(0, "nothing is asked; write for example \"height > 2 cm\"");
    either();
    skip_spaces();
    const bool comma = at_ > 0 && at_ + 1 < text_.size() && text_[at_] == ',' && is_digit(text_[at_ - 1]) &&
                       is_digit(text_[at_ + 1]);
    if (comma) fail(at_, "a number has a point in place of the comma, as in 9.5");
    if (at_ < text_.size())
        fail(at_, fmt::format("'{}' is not expected here", excerpt(text_.substr(at_), 20)));
}

std::size_t ExpressionParser::either() {
    const std::size_t start = at_;
    std::size_t left = both();
    while (take_word("or") || take("||")) {
        const std::size_t from = at_, right = both();
        want_truth(left, start);
        want_truth(right, from);
        left = add(Op::either, truth(), left, right);
    }
    return left;
}

std::size_t ExpressionParser::both() {
    const std::size_t start = at_;
    std::size_t left = opposite();
    while (take_word("and") || take("&&")) {
        const std::size_t from = at_, right = opposite();
        want_truth(left, start);
        want_truth(right, from);
        left = add(Op::both, truth(), left, right);
    }
    return left;
}

std::size_t ExpressionParser::opposite() {
    skip_spaces();
    const bool sign = text_.substr(at_, 1) == "!" && text_.substr(at_, 2) != "!=";
    if (!(sign && take("!")) && !take_word("not")) return comparison();
    if (++depth_ > deepest) fail(at_, "is nested too deeply");
    const std::size_t from = at_, what = opposite();
    --depth_;
    want_truth(what, from);
    return add(Op::opposite, truth(), what);
}

std::size_t ExpressionParser::comparison() {
    const std::size_t start = at_;
    std::size_t left = sum(), all = left;
    bool swapped = false, first = true;
    while (const std::optional<Op> op = comparing(swapped)) {
        const std::size_t right = sum();
        const std::size_t one = compare(*op, swapped, left, right, start);
        all = first ? one : add(Op::both, truth(), all, one);
        first = false;
        left = right;
    }
    return all;
}

// Reads a comparison. a > b becomes b < a, and then `swapped` is set.
std::optional<ExpressionParser::Op> ExpressionParser::comparing(bool& swapped) {
    swapped = false;
    if (take("<=")) return Op::less_equal;
    if (take("<")) return Op::less;
    if (take("==")) return Op::equal;
    if (take("!=")) return Op::unequal;
    if (take("=")) return Op::equal;
    swapped = true;
    if (take(">=")) return Op::less_equal;
    if (take(">")) return Op::less;
    return std::nullopt;
}

std::size_t ExpressionParser::compare(Op op, bool swapped, std::size_t left, std::size_t right,
                                      std::size_t start) {
    const bool ordered = op == Op::less || op == Op::less_equal;
    if (type(left).kind == Kind::truth || type(right).kind == Kind::truth)
        fail(start, "a condition is compared; join conditions with 'and' or 'or'");
    want_alike(left, right, start);
    if (ordered && type(left).kind == Kind::species)
        fail(start, "species have no order; compare them with == or !=");
    return add(op, truth(), swapped ? right : left, swapped ? left : right);
}

std::size_t ExpressionParser::sum() {
    const std::size_t start = at_;
    std::size_t left = product();
    while (true) {
        const bool plus = take("+");
        if (!plus && !take("-")) return left;
        const std::size_t from = at_, right = product();
        want_number(left, start);
        want_number(right, from);
        want_alike(left, right, start);
        left = add(plus ? Op::plus : Op::minus, type(left), left, right);
    }
}

std::size_t ExpressionParser::product() {
    const std::size_t start = at_;
    std::size_t left = negative();
    while (true) {
        const bool times = take("*");
        if (!times && !take("/")) return left;
        const std::size_t from = at_, right = negative();
        want_number(left, start);
        want_number(right, from);
        Powers powers = type(left).powers;
        for (std::size_t k = 0; k < powers.size(); ++k) powers[k] += (times ? 1 : -1) * type(right).powers[k];
        left = add(times ? Op::times : Op::over, number_of(powers), left, right);
    }
}

std::size_t ExpressionParser::negative() {
    if (!take("-")) return power();
    if (++depth_ > deepest) fail(at_, "is nested too deeply");
    const std::size_t from = at_, what = negative();
    --depth_;
    want_number(what, from);
    return add(Op::negative, type(what), what);
}

std::size_t ExpressionParser::power() {
    const std::size_t start = at_, base = primary();
    if (!take("^")) return base;
    skip_spaces();
    const std::size_t from = at_;
    int exponent = 0;
    const auto [end, failure] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), exponent);
    at_ = static_cast<std::size_t>(end - text_.data());
    if (failure != std::errc() || std::abs(exponent) > largest_power)
        fail(from, fmt::format("after ^ stands a whole number from -{0} to {0}", largest_power));
    want_number(base, start);
    Powers powers = type(base).powers;
    for (double& one : powers) one *= exponent;
    return add(Op::power, number_of(powers), base, 0, exponent);
}

std::size_t ExpressionParser::primary() {
    skip_spaces();
    if (at_ == text_.size()) fail(at_, "something is missing at the end");
    const char next = text_[at_];
    if (take("(")) return inside();
    if (next == '"' || next == '\'') return quoted();
    if (is_digit(next) || next == '.') return number();
    if (is_letter(next)) return word();
    fail(at_, fmt::format("'{}' is not expected here", excerpt(text_.substr(at_), 20)));
}

std::size_t ExpressionParser::inside() {
    if (++depth_ > deepest) fail(at_, "is nested too deeply");
    const std::size_t what = either();
    --depth_;
    if (!take(")")) fail(at_, "a ')' is missing");
    return what;
}

std::size_t ExpressionParser::number() {
    double value = 0;
    const auto [end, failure] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (failure != std::errc()) fail(at_, "this number cannot be read");
    at_ = static_cast<std::size_t>(end - text_.data());
    Powers powers{};
    value *= unit_here(powers);
    return add(Op::constant, number_of(powers), 0, 0, value);
}

// Reads a unit and returns its size; 1 where none comes. It has no spaces inside: "2 cm", "1 mm/s", "9.81
// m/s2".
double ExpressionParser::unit_here(Powers& powers) {
    const std::size_t before = at_;
    skip_spaces();
    const std::size_t start = at_;
    std::size_t end = at_;
    while (end < text_.size() && (is_letter(text_[end]) || (end > start && is_digit(text_[end])) ||
                                  (end > start && (text_[end] == '/' || text_[end] == '.') &&
                                   end + 1 < text_.size() && is_letter(text_[end + 1]))))
        ++end;
    const std::string_view text = text_.substr(start, end - start);
    if (text.empty() || contains(joining_words, text)) {
        at_ = before;
        return 1;
    }
    const std::optional<AnyUnit> unit = parse_unit(text);
    if (!unit) fail(start, fmt::format("'{}' is no unit", excerpt(text)));
    at_ = end;
    powers = unit->powers;
    return unit->size;
}

std::size_t ExpressionParser::word() {
    const std::size_t start = at_;
    const std::string name = name_here();
    if (contains(joining_words, name)) fail(start, fmt::format("something is missing before '{}'", name));
    if (contains(functions, name)) return function(name, start);
    skip_spaces();
    if (name == "touches" && text_.substr(at_, 1) == "(") return touches(start);
    return named(name, start);
}

std::size_t ExpressionParser::function(const std::string& name, std::size_t start) {
    if (!take("(")) fail(at_, fmt::format("'{}' wants its value in parentheses", name));
    if (++depth_ > deepest) fail(at_, "is nested too deeply");
    const bool two = name == "min" || name == "max";
    const std::size_t first = sum();
    want_number(first, start);
    std::size_t second = 0;
    if (two) {
        if (!take(",")) fail(at_, fmt::format("'{}' wants two values with a comma between them", name));
        second = sum();
        want_number(second, start);
        want_alike(first, second, start);
    }
    --depth_;
    if (!take(")")) fail(at_, "a ')' is missing");
    if (two) return add(name == "min" ? Op::least : Op::most, type(first), first, second);
    if (name == "abs") return add(Op::absolute, type(first), first);
    Powers powers = type(first).powers;
    for (double& one : powers) one *= 0.5;
    return add(Op::root, number_of(powers), first);
}

// Reads touches(wall), touches("left slant"), touches(big) or touches(12).
std::size_t ExpressionParser::touches(std::size_t start) {
    take("(");
    skip_spaces();
    const bool quotes = at_ < text_.size() && (text_[at_] == '"' || text_[at_] == '\'');
    const std::size_t from = quotes ? at_ + 1 : at_;
    const std::size_t end = text_.find(quotes ? text_[at_] : ')', from);
    if (end == std::string_view::npos)
        fail(start, quotes ? "the closing quote is missing" : "after touches( a ')' is missing");
    std::string_view who = text_.substr(from, end - from);
    while (!quotes && !who.empty() && std::isspace(static_cast<unsigned char>(who.back())))
        who.remove_suffix(1);
    if (who.empty()) fail(start, "touches() wants what is touched, as in touches(wall) or touches(12)");
    at_ = quotes ? end + 1 : end;
    if (!take(")")) fail(at_, "a ')' is missing");
    const std::optional<Vocabulary::Word> word = words_.touching(who);
    if (!word) fail(start, "'touches' is not known here");
    return add_word(*word);
}

std::size_t ExpressionParser::named(const std::string& name, std::size_t start) {
    const std::optional<Vocabulary::Word> word = words_.find(name);
    if (!word) {
        const std::vector<std::string> all = words_.names();
        const std::optional<std::string> meant = nearest_name(name, all);
        fail(start, fmt::format("'{}' is not known; {}", excerpt(name),
                                meant ? fmt::format("did you mean '{}'?", *meant)
                                      : fmt::format("there are {}", fmt::join(all, ", "))));
    }
    return add_word(*word);
}

std::size_t ExpressionParser::add_word(const Vocabulary::Word& word) {
    if (word.constant) return add(Op::constant, word.type, 0, 0, *word.constant);
    auto& columns = into_.columns_;
    const auto known = std::find(columns.begin(), columns.end(), word.column);
    const auto place = static_cast<std::size_t>(known - columns.begin());
    if (known == columns.end()) columns.push_back(word.column);
    return add(Op::column, word.type, place);
}

// Reads a name that is not plain letters: a species called "big beads".
std::size_t ExpressionParser::quoted() {
    const std::size_t start = at_;
    const char quote = text_[at_++];
    const std::size_t end = text_.find(quote, at_);
    if (end == std::string_view::npos) fail(start, "the closing quote is missing");
    const std::string name(text_.substr(at_, end - at_));
    at_ = end + 1;
    return named(name, start);
}

std::size_t ExpressionParser::add(Op op, ValueType type, std::size_t first, std::size_t second,
                                  double value) {
    into_.nodes_.push_back({op, type, value, first, second});
    return into_.nodes_.size() - 1;
}

void ExpressionParser::want_number(std::size_t node, std::size_t start) const {
    if (type(node).kind != Kind::number)
        fail(start, fmt::format("this is {}, and a number is wanted", noun_of(type(node))));
}

void ExpressionParser::want_truth(std::size_t node, std::size_t start) const {
    if (type(node).kind != Kind::truth)
        fail(start, fmt::format("this is {}, and a condition is wanted, as in \"height > 2 cm\"",
                                noun_of(type(node))));
}

void ExpressionParser::want_alike(std::size_t left, std::size_t right, std::size_t start) const {
    const ValueType &a = type(left), &b = type(right);
    if (a.kind == b.kind && same_powers(a.powers, b.powers)) return;
    // 0 needs no unit.
    if (a.kind == Kind::number && b.kind == Kind::number && (is_zero(left) || is_zero(right))) return;
    fail(start, fmt::format("{} and {} do not go together{}", noun_of(a), noun_of(b),
                            is_plain(b.powers) && a.kind == b.kind ? "; write a unit after the number" : ""));
}

bool ExpressionParser::is_zero(std::size_t node) const {
    const auto& it = into_.nodes_[node];
    return it.op == Op::constant && it.value == 0 && is_plain(it.type.powers);
}

void ExpressionParser::skip_spaces() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
}

bool ExpressionParser::take(std::string_view symbol) {
    skip_spaces();
    if (text_.substr(at_, symbol.size()) != symbol) return false;
    at_ += symbol.size();
    return true;
}

bool ExpressionParser::take_word(std::string_view word) {
    skip_spaces();
    const std::size_t start = at_;
    if (name_here() == word) return true;
    at_ = start;
    return false;
}

std::string ExpressionParser::name_here() {
    const std::size_t start = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || (at_ > start && is_digit(text_[at_])))) ++at_;
    return std::string(text_.substr(start, at_ - start));
}

void ExpressionParser::fail(std::size_t start, const std::string& what) const {
    while (start < text_.size() && std::isspace(static_cast<unsigned char>(text_[start]))) ++start;
    throw UserError("character {}: {}", start + 1, what);
}

}  // namespace grainreel
