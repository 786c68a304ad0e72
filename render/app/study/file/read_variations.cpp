// Reads what a study varies: [[vary]].
#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "render/app/study/file/read_parts.hpp"
#include "render/app/study/file/values.hpp"
#include "render/scene/read_scene.hpp"

namespace grainreel {
namespace {

// The words of a TOML value: "9 mm" for "\"9 mm\"".
std::string words_of(const std::string& toml) {
    const toml::table parsed = toml::parse("value = " + toml);
    return parsed["value"].value_exact<std::string>().value_or(toml);
}

// The key behind the path of a variation ("species.big.diameter"). Throws UserError, which begins with
// `place`, when the scene has no such key.
const Key& key_of_scene(const std::string& scene_text, const std::filesystem::path& scene,
                        const std::string& path, const std::string& place) {
    const std::vector<Key>& keys = filmed_scene_keys();
    Document probe(scene_text, scene.string(), keys);
    probe.set({path + "=0", place});
    probe.check_keys();
    // The key that was set is the one with that place; the tables around it have shorter paths.
    const Key* key = nullptr;
    for (const auto& [written, where] : probe.written())
        if (where.file == place && find_key(written, keys) != nullptr) key = find_key(written, keys);
    if (key == nullptr)
        throw UserError(fmt::format("{}: '{}' is a table; name one of its own keys", place, excerpt(path)));
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

void read_range(Document& document, const std::string& table, Variation& variation) {
    ValueRange range;
    if (!document.has(table + ".from") || !document.has(table + ".to"))
        throw UserError(
            fmt::format("{}: [[vary]] lacks 'values', or 'from' and 'to'; write for example values = "
                        "[1, 2, 3]",
                        document.place(table)));
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
        throw UserError(fmt::format("{}: {}", place, mistake.what()));
    }
}

}  // namespace

void read_variation(Document& document, const std::string& table, Study& study) {
    Variation variation;
    variation.key = document.required_text(table + ".key");
    variation.place = document.place(table + ".key");
    check_varied_key(document, table, variation, study);
    const Key& key = key_of_scene(study.scene_text, study.scene, variation.key, variation.place);
    variation.label = document.text(table + ".label").value_or(variation.key);
    if (document.has(table + ".values"))
        read_values(document, table, variation);
    else
        read_range(document, table, variation);
    make_numeric(variation, key);
    study.variations.push_back(std::move(variation));
}

}  // namespace grainreel
