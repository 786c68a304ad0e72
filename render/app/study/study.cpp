#include "render/app/study/study.hpp"

#include <algorithm>

namespace grainreel {
namespace {

// Whether `asked` is true for the seeds of the study or of one of its variants.
template <typename Asked>
bool any_seeds(const Study& study, const Asked& asked) {
    if (asked(study.seeds)) return true;
    if (!study.has_variants()) return false;
    const std::vector<Variation::Value>& variants = study.variations.front().values;
    return std::any_of(variants.begin(), variants.end(),
                       [&](const Variation::Value& variant) { return asked(variant.seeds); });
}

}  // namespace

Assignments Variation::assignments(std::size_t number) const {
    const Value& value = values[number];
    if (key == variant_axis) return value.sets;
    return {{key + "=" + value.toml, value.place}};
}

const Seeds& Study::seeds_of(const std::vector<std::size_t>& at) const {
    if (!has_variants()) return seeds;
    const Variation::Value& variant = variations.front().values[at.front()];
    return variant.seeds.empty() ? seeds : variant.seeds;
}

std::size_t Study::seed_count(const std::vector<std::size_t>& at) const {
    return std::max<std::size_t>(1, seeds_of(at).size());
}

bool Study::has_seeds() const {
    return any_seeds(*this, [](const Seeds& some) { return !some.empty(); });
}

bool Study::has_intervals() const {
    return any_seeds(*this, [](const Seeds& some) { return some.size() > 1; });
}

}  // namespace grainreel
