// The one list of keys that a scene file may have. The reader, the search for the nearest key and the table
// in docs/reference/scenes.md all live on it. Another kind of file (a study) has a list of its own.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/text/units.hpp"

namespace grainreel {

enum class KeyKind {
    quantity,      // a number in SI or a string with a unit
    integer,       //
    flag,          // true or false
    text,          // any words
    choice,        // one of `choices`
    colour,        // "#rrggbb" or a name
    vector,        // [x, y, z]
    gravity,       // a quantity or a vector of them
    diameter,      // a length, or a table with min and max, or with mean and deviation
    picture_size,  // "1920x1080" or [1920, 1080]
    species_pair,  // ["small", "big"] or ["small", "wall"]
    speed_table,   // [[speed, number], ...]
    interval,      // [low, high] of a quantity that another key names
    name_list,     // ["small", ...]
    integer_list,  // [3, 14, ...]
    seeds,         // a whole number or a list of them
    value,         // a number, or text that may be a quantity
    value_list,    // anything, several times
};

// The most letters of a text. Letters cost time on every picture, and a picture holds far fewer.
constexpr std::size_t kMostLetters = 1000;

// What numbers may be, ends included unless `open`.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool open = false;      // low itself is not allowed
    bool infinite = false;  // inf is allowed
    bool small = false;     // so is less than the least of the dimension (units.hpp)
    bool contains(double value) const;
    std::string text() const;  // "larger than 0", "from 0 to 51"; empty when anything goes
};

struct Key {
    std::string path;  // "species[].count": [] stands for any element
    KeyKind kind = KeyKind::quantity;
    Dimension dimension = Dimension::number;
    Range range;
    std::vector<std::string> choices;         // of a choice, or of each name in a list
    std::size_t most_letters = kMostLetters;  // of a text
    std::string fallback;                     // as a scene would write it; empty when there is no such value
    std::string fallback_note;                // in words instead: "required", "one period"
    std::string about;
    // Names beside it in its table. Setting a key on the command line takes out of the file what the key
    // excludes, what excludes the key, and, when its value changes, what belongs to that value.
    std::vector<std::string> excludes, owns;
    bool decides = true;        // the future of a run, so that a run that goes on must have the same
    bool often_chosen = false;  // by the plan, for reasons that other keys give

    std::string example() const;  // a value that is right, as a scene would write it
    Range bounds() const;         // what the dimension's bounds leave of the range
};

const std::vector<Key>& scene_keys();

// The key at a path with or without indices ("species[1].count"), or nullptr.
const Key* find_key(std::string_view path, const std::vector<Key>& keys = scene_keys());
// The names beside a key or a table that it excludes, or that exclude it.
std::vector<std::string> rivals_of(std::string_view path, const std::vector<Key>& keys = scene_keys());
// Whether a path is a table ("drive", "species[0]", "contact.wall"), or an array of tables ("species").
bool is_table_path(std::string_view path, const std::vector<Key>& keys = scene_keys());
bool is_table_array_path(std::string_view path, const std::vector<Key>& keys = scene_keys());

// What to tell somebody who wrote an unknown key: "did you mean 'frequency'?", "it belongs in [drive]", or
// the keys that exist there.
std::string advice_for_unknown_key(std::string_view path, const std::vector<Key>& keys = scene_keys());

// "[drive]", "[[species]]", "the top level": the table that a path lies in, as a scene would write it.
std::string table_of(std::string_view path);

// The table of all keys in Markdown, as in docs/reference/scenes.md and docs/reference/studies.md.
std::string key_table_markdown(const std::vector<Key>& keys = scene_keys());

}  // namespace grainreel
