// The values of a key that a study varies: as they are written, as numbers of an axis, and in ranges.
// Also reads them from a study file, [[vary]], [[variant]] and seeds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/scene/keys/document.hpp"
#include "engine/scene/keys/keys.hpp"
#include "render/app/study/study.hpp"

namespace grainreel {

constexpr std::size_t most_values = 100'000;  // limit for one key

// A number with the unit that follows it: "9 mm" is 9 and "mm".
struct WrittenNumber {
    double number = 0;
    std::string unit;  // empty for none
};
// The number in a value written as TOML; none when it is neither a number nor text that begins with one.
std::optional<WrittenNumber> written_number(const std::string& toml);

// Writes the value as TOML. Whole numbers have no decimal point, so that they can be counts too.
std::string toml_of(const WrittenNumber& value);

struct ValueRange {
    std::string from, to;              // as TOML
    std::optional<std::size_t> count;  // number of values, both ends included
    std::string by;                    // in place of count: the distance between values; else empty
    bool logarithmic = false;          // equal ratios in place of equal distances
};
// The values of a range, each as TOML. Throws UserError, which says what is wrong with the range and what to
// write. The caller adds the place and the names of the keys.
std::vector<std::string> range_values(const ValueRange& range);

// Finds out whether all values are numbers, and which unit they have. It looks at the values as written and
// at the dimension of the key. If all values have the same unit they stay in it; otherwise all are converted
// to SI units.
void make_numeric(Variation& variation, const Key& key);

// These are for read_study(), in the order in which it calls them. Each throws UserError with the place of
// the mistake.

// The name of a key as films write it: "Γ", "d of nut", "friction"; without the table it lies in.
std::string name_in_films(const std::string& key);

// Reads the seeds at that path, given as a number of seeds or a list; none when the key is absent.
Seeds read_seeds(Document& document, const std::string& path);
// Makes all [[variant]] the first variation. To be called before the others are read.
void read_variants(Document& document, Study& study);
// Reads one element of a list of tables, "vary[0]", and adds it to the study.
void read_variation(Document& document, const std::string& table, Study& study);

}  // namespace grainreel
