// Reads what a study has besides its grid: seeds, and [[variant]].
#include <set>

#include <fmt/format.h>

#include "engine/base/text.hpp"
#include "render/app/study/file/read_parts.hpp"

namespace grainreel {
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
    variants.key = variants.label = variant_axis;
    for (std::size_t i = 0; i < document.size("variant"); ++i)
        variants.values.push_back(read_variant(document, fmt::format("variant[{}]", i), variants));
    if (variants.values.empty()) return;
    variants.place = document.place("variant[0]");
    study.variations.push_back(std::move(variants));
}

}  // namespace grainreel
