#include "render/app/study/file/values.hpp"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/scene/text/toml_text.hpp"

namespace grainreel {
namespace {

bool is_quoted(const std::string& toml) {
    return toml.size() >= 2 && toml.front() == '"' && toml.back() == '"';
}

WrittenNumber required_number(const std::string& toml, const char* key) {
    const auto value = written_number(toml);
    if (!value || !std::isfinite(value->number))
        throw UserError(
            fmt::format("'{}' must be a number or a quantity, but is {}; write for example {} = "
                        "\"2 mm\"",
                        key, toml, key));
    return *value;
}

std::vector<std::string> spaced(double first, double last, std::size_t count, const std::string& unit,
                                bool logarithmic) {
    std::vector<std::string> values;
    for (std::size_t i = 0; i < count; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(count - 1);
        const double value =
            logarithmic ? first * std::pow(last / first, share) : first + share * (last - first);
        values.push_back(toml_of({value, unit}));
    }
    return values;
}

std::vector<std::string> stepped(double first, double last, double by, const std::string& unit) {
    constexpr double rounding = 1e-9;  // share of a step: 0.1 + 0.1 + 0.1 counts as 0.3
    const double steps = std::floor((last - first) / by + rounding);
    if (!(by != 0 && steps >= 0))
        throw UserError(
            fmt::format("'by' never leads from {} to {}; give it the sign of the difference", first, last));
    if (steps >= static_cast<double>(most_values))
        throw UserError(fmt::format("'by' makes more than {} values; make it larger", most_values));
    std::vector<std::string> values;
    for (double i = 0; i <= steps; ++i) values.push_back(toml_of({first + i * by, unit}));
    return values;
}

bool takes_numbers(const Key& key) {
    switch (key.kind) {
        case KeyKind::quantity:
        case KeyKind::integer:
        case KeyKind::gravity:
        case KeyKind::diameter:
            return true;
        default:
            return false;
    }
}

}  // namespace

std::optional<WrittenNumber> written_number(const std::string& toml) {
    const std::string text = is_quoted(toml) ? toml.substr(1, toml.size() - 2) : toml;
    WrittenNumber value;
    const char* const end = text.data() + text.size();
    const char* const begin = text.data() + (!text.empty() && text.front() == '+' ? 1 : 0);
    const auto read = std::from_chars(begin, end, value.number);
    if (read.ec != std::errc()) return std::nullopt;
    value.unit.assign(read.ptr, end);
    value.unit.erase(0, value.unit.find_first_not_of(' '));
    value.unit.erase(value.unit.find_last_not_of(' ') + 1);
    if (!is_quoted(toml) && !value.unit.empty()) return std::nullopt;  // the value is a date
    return value;
}

std::string toml_of(const WrittenNumber& value) {
    constexpr double most_whole = 1e15;
    const bool whole = value.number == std::round(value.number) && std::abs(value.number) < most_whole;
    // Twelve digits are written, so that 0.1 + 0.2 gives 0.3.
    const std::string number = whole ? fmt::format("{:.0f}", value.number == 0 ? 0.0 : value.number)
                                     : fmt::format("{:.12g}", value.number);
    return value.unit.empty() ? number : quoted(number + " " + value.unit);
}

std::vector<std::string> range_values(const ValueRange& range) {
    const WrittenNumber from = required_number(range.from, "from"), to = required_number(range.to, "to");
    if (from.unit != to.unit)
        throw UserError(fmt::format("'from' and 'to' are in two units, {} and {}; write both in one",
                                    range.from, range.to));
    if (range.count.has_value() != range.by.empty())
        throw UserError("a range has 'count' or 'by', one of them; write for example count = 5");
    if (range.logarithmic && !(range.count && from.number > 0 && to.number > 0))
        throw UserError("a logarithmic range needs 'count', and ends larger than 0");
    if (range.count && from.number == to.number)
        throw UserError("'from' and 'to' are the same value; write values = [...] for one");
    if (range.count) return spaced(from.number, to.number, *range.count, from.unit, range.logarithmic);
    const WrittenNumber by = required_number(range.by, "by");
    if (by.unit != from.unit)
        throw UserError(fmt::format("'from' and 'by' are in two units, {} and {}; write both in one",
                                    range.from, range.by));
    return stepped(from.number, to.number, by.number, from.unit);
}

void make_numeric(Variation& variation, const Key& key) {
    std::vector<WrittenNumber> numbers;
    bool one_unit = true;
    for (const Variation::Value& value : variation.values) {
        const auto number = takes_numbers(key) ? written_number(value.toml) : std::nullopt;
        if (!number) return;
        numbers.push_back(*number);
        one_unit = one_unit && number->unit == numbers.front().unit;
    }
    const std::string si = key.dimension == Dimension::number ? "" : text_of(key.dimension).unit;
    variation.numeric = true;
    variation.unit = one_unit && !numbers.front().unit.empty() ? numbers.front().unit : si;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        Variation::Value& value = variation.values[i];
        const bool in_si = numbers[i].unit.empty();
        value.number = one_unit || in_si ? numbers[i].number : parse_quantity(value.words, key.dimension);
    }
}

}  // namespace grainreel
