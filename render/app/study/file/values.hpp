// The values that a study gives a key: as they are written, as numbers of an axis, and in ranges.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/scene/keys/keys.hpp"
#include "render/app/study/study.hpp"

namespace grainreel {

constexpr std::size_t most_values = 100'000;  // of one key

// A number with the unit that stands after it: "9 mm" is 9 and "mm".
struct WrittenNumber {
    double number = 0;
    std::string unit;  // empty for none
};
// The number in a value as TOML writes it; none where it is no number, nor text that begins with one.
std::optional<WrittenNumber> written_number(const std::string& toml);

// As TOML: whole numbers without a point, so that they suit counts too.
std::string toml_of(const WrittenNumber& value);

struct ValueRange {
    std::string from, to;              // as TOML
    std::optional<std::size_t> count;  // of values, both ends included ...
    std::string by;                    // ... or the distance between them; empty for none
    bool logarithmic = false;          // equal ratios in place of equal distances
};
// Each as TOML. Throws UserError, whose line lacks the place and the names of the keys: what is wrong with
// the range, and what to write.
std::vector<std::string> range_values(const ValueRange& range);

// Whether all values are numbers, in which unit, and which; all from what is written and from the dimension
// of the key. Values in one unit stay in it; others are all taken in SI.
void make_numeric(Variation& variation, const Key& key);

}  // namespace grainreel
