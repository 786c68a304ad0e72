#include "render/app/study/file/variations.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/text/toml_text.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

bool is_quoted(const std::string& toml) {
    return toml.size() >= 2 && toml.front() == '"' && toml.back() == '"';
}

WrittenNumber required_number(const std::string& toml, const char* key) {
    const auto value = written_number(toml);
    if (!value || !std::isfinite(value->number))
        throw UserError(
            "'{}' must be a number or a quantity, but is {}; write for example {} = "
            "\"2 mm\"",
            key, toml, key);
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
        throw UserError("'by' never leads from {} to {}; give it the sign of the difference", first, last);
    if (steps >= static_cast<double>(most_values))
        throw UserError("'by' makes more than {} values; make it larger", most_values);
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
        throw UserError("'from' and 'to' are in two units, {} and {}; write both in one", range.from,
                        range.to);
    if (range.count.has_value() != range.by.empty())
        throw UserError("a range has 'count' or 'by', one of them; write for example count = 5");
    if (range.logarithmic && !(range.count && from.number > 0 && to.number > 0))
        throw UserError("a logarithmic range needs 'count', and ends larger than 0");
    if (range.count && from.number == to.number)
        throw UserError("'from' and 'to' are the same value; write values = [...] for one");
    if (range.count) return spaced(from.number, to.number, *range.count, from.unit, range.logarithmic);
    const WrittenNumber by = required_number(range.by, "by");
    if (by.unit != from.unit)
        throw UserError("'from' and 'by' are in two units, {} and {}; write both in one", range.from,
                        range.by);
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

// From here on: reading [[vary]].

namespace {

// The words of a TOML value: "9 mm" for "\"9 mm\"".
std::string words_of(const std::string& toml) {
    const toml::table parsed = toml::parse("value = " + toml);
    return parsed["value"].value_exact<std::string>().value_or(toml);
}

// The key that the path of a variation means ("species.big.diameter"). Throws UserError, which begins with
// `place`, when the scene has no such key.
const Key& key_of_scene(const std::string& scene_text, const std::filesystem::path& scene,
                        const std::string& path, const std::string& place) {
    const std::vector<Key>& keys = filmed_scene_keys();
    Document probe(scene_text, scene.string(), keys);
    probe.set({path + "=0", place});
    probe.check_keys();
    // The key that was set has that place, and so have the tables around it. The longest path, which comes
    // last, is that of the key.
    const Key* key = nullptr;
    for (const auto& [written, where] : probe.written())
        if (where.file == place && find_key(written, keys) != nullptr) key = find_key(written, keys);
    if (key == nullptr)
        throw UserError("{}: '{}' is a table; name one of its own keys", place, excerpt(path));
    return *key;
}

void check_varied_key(const Document& document, const std::string& table, const Variation& variation,
                      const Study& study) {
    if (variation.key == "run.seed")
        document.fail(table + ".key", "is the seed; write seeds = 3 at the top level");
    if (variation.key == "run.threads")
        document.fail(table + ".key",
                      "changes no result: a run gives the same bits on any number of threads; "
                      "vary another key");
    if (study.has_variants())
        for (const Variation::Value& variant : study.variations.front().values)
            for (const Assignment& set : variant.sets)
                if (set.key() == variation.key)
                    document.fail(table + ".key",
                                  fmt::format("varies {}, which the variant \"{}\" sets; leave it out of one",
                                              excerpt(variation.key), excerpt(variant.words)));
    for (const Variation& other : study.variations)
        if (other.key == variation.key)
            document.fail(table + ".key",
                          fmt::format("varies {} a second time; put all its values in one [[vary]]",
                                      excerpt(variation.key)));
}

void read_values(Document& document, const std::string& table, Variation& variation) {
    for (const char* other : {"from", "to", "count", "by", "spacing"})
        document.refuse(table + "." + other, "'values' says what they are");
    const std::vector<std::string> values = document.value_list(table + ".values");
    if (values.empty())
        document.fail(table + ".values",
                      "is an empty list, so the grid would be empty; write for example "
                      "values = [1, 2, 3]");
    if (values.size() > most_values)
        document.fail(table + ".values", fmt::format("are more than {}; leave some out", most_values));
    for (std::size_t i = 0; i < values.size(); ++i)
        variation.values.push_back(
            {values[i], words_of(values[i]), document.place(fmt::format("{}.values[{}]", table, i)), 0});
}

// The two ends of a range in which a value is searched, the smaller one first, and how close it is wanted.
StudySearch read_search(Document& document, const std::string& table, Variation& variation) {
    StudySearch search;
    search.place = document.place(table + ".until");
    search.words = document.required_text(table + ".until");
    for (const char* other : {"values", "count", "by", "spacing"})
        document.refuse(table + "." + other, "'until' finds the values between 'from' and 'to'");
    for (const char* wanted : {"from", "to", "within"})
        if (!document.has(table + "." + wanted)) document.fail_missing(table + "." + wanted);
    std::vector<WrittenNumber> ends;
    try {
        for (const char* name : {"from", "to", "within"})
            ends.push_back(required_number(document.value(fmt::format("{}.{}", table, name)), name));
    } catch (const UserError& mistake) {
        throw UserError("{}: {}", search.place, mistake.what());
    }
    if (ends[0].unit != ends[1].unit || ends[0].unit != ends[2].unit)
        document.fail(table + ".within", "has another unit than 'from' or 'to'; write all three in one");
    if (ends[0].number == ends[1].number)
        document.fail(table + ".from", "is the same value as 'to'; write two ends");
    if (!(ends[2].number > 0)) document.fail(table + ".within", "must be larger than 0");
    if (ends[0].number > ends[1].number) std::swap(ends[0], ends[1]);
    for (std::size_t i = 0; i < 2; ++i) {
        const std::string toml = toml_of(ends[i]);
        variation.values.push_back({toml, words_of(toml), document.place(table + ".from"), 0});
    }
    search.within = ends[2].number;
    search.written_unit = ends[0].unit;
    return search;
}

void read_range(Document& document, const std::string& table, Variation& variation) {
    ValueRange range;
    if (!document.has(table + ".from") || !document.has(table + ".to"))
        throw UserError(
            "{}: [[vary]] lacks 'values', or 'from' and 'to'; write for example values = "
            "[1, 2, 3]",
            document.place(table));
    range.from = document.value(table + ".from");
    range.to = document.value(table + ".to");
    range.by = document.value(table + ".by");
    if (const auto count = document.integer(table + ".count")) range.count = static_cast<std::size_t>(*count);
    range.logarithmic = document.text(table + ".spacing") == "logarithmic";
    const std::string place = document.place(table + ".from");
    try {
        for (const std::string& value : range_values(range))
            variation.values.push_back({value, words_of(value), place, 0});
    } catch (const UserError& mistake) {
        throw UserError("{}: {}", place, mistake.what());
    }
}

}  // namespace

std::string name_in_films(const std::string& key) {
    const std::string last = name_of(key), table = parent_of(key);
    if (key == "drive.g_level") return "Γ";
    if (key == "drive.frequency") return "f";
    if (key == "drive.amplitude") return "a";
    std::string words = last;
    std::replace(words.begin(), words.end(), '_', ' ');
    if (table.starts_with("species."))
        return fmt::format("{} of {}", last == "diameter" ? "d" : words,
                           table.substr(std::size("species.") - 1));
    for (const char* const prefixed : {"contact.wall", "container.outlet", "container.tray"})
        if (table == prefixed) return name_of(table) + " " + words;
    return words;
}

void read_variation(Document& document, const std::string& table, Study& study) {
    Variation variation;
    variation.key = document.required_text(table + ".key");
    variation.place = document.place(table + ".key");
    check_varied_key(document, table, variation, study);
    const Key& key = key_of_scene(study.scene_text, study.scene, variation.key, variation.place);
    const auto own = document.text(table + ".label");
    variation.label = own.value_or(variation.key);
    variation.shown = own.value_or(name_in_films(variation.key));
    std::optional<StudySearch> search;
    if (document.has(table + ".until"))
        search = read_search(document, table, variation);
    else
        document.refuse(table + ".within", "there is no 'until'");
    if (search)
        study.search = std::move(search);
    else if (document.has(table + ".values"))
        read_values(document, table, variation);
    else
        read_range(document, table, variation);
    make_numeric(variation, key);
    if (study.search && !variation.numeric)
        document.fail(table + ".until", "needs a key of numbers; vary another one");
    study.variations.push_back(std::move(variation));
}

// From here on: reading seeds and [[variant]].

namespace {

constexpr std::int64_t most_seeds = 100'000;

Variation::Value read_variant(Document& document, const std::string& table, const Variation& others) {
    Variation::Value variant;
    variant.place = document.place(table + ".name");
    variant.words = document.required_text(table + ".name");
    if (variant.words.empty())
        document.fail(table + ".name", "is empty; write a word or two, such as \"half the step\"");
    for (const Variation::Value& other : others.values)
        if (other.words == variant.words)
            document.fail(table + ".name",
                          fmt::format("gives a second variant the name \"{}\"; choose another",
                                      excerpt(variant.words)));
    if (!document.has(table + ".set")) document.fail_missing(table + ".set");
    const std::vector<std::string> sets = document.name_list(table + ".set");
    for (std::size_t i = 0; i < sets.size(); ++i)
        variant.sets.push_back({sets[i], document.place(fmt::format("{}.set[{}]", table, i))});
    variant.seeds = read_seeds(document, table + ".seeds");
    return variant;
}

}  // namespace

Seeds read_seeds(Document& document, const std::string& path) {
    Seeds seeds;
    if (!document.has(path)) return seeds;
    if (document.is_array(path)) {
        for (const std::int64_t seed : document.integer_list(path))
            seeds.push_back(static_cast<std::uint64_t>(seed));
        if (seeds.empty()) document.fail(path, "is an empty list; write for example seeds = 3");
    } else {
        const std::int64_t count = *document.integer(path);
        if (count < 1 || count > most_seeds)
            document.fail(path,
                          fmt::format("must be a whole number from 1 to {}, or a list of seeds", most_seeds));
        for (std::int64_t seed = 1; seed <= count; ++seed) seeds.push_back(static_cast<std::uint64_t>(seed));
    }
    const std::set<std::uint64_t> different(seeds.begin(), seeds.end());
    if (different.size() < seeds.size()) document.fail(path, "has a seed twice; remove one");
    return seeds;
}

void read_variants(Document& document, Study& study) {
    Variation variants;
    variants.key = variants.label = variants.shown = variant_axis;
    for (std::size_t i = 0; i < document.size("variant"); ++i)
        variants.values.push_back(read_variant(document, fmt::format("variant[{}]", i), variants));
    if (variants.values.empty()) return;
    variants.place = document.place("variant[0]");
    study.variations.push_back(std::move(variants));
}

}  // namespace grainreel
