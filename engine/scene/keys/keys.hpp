// Keys of a scene file: what a key is, how lists of keys are made and searched, paths of keys, the words of
// choices, and assignments from the command line. The reader, the search for the nearest key and the table in
// docs/reference/scenes.md use one list, scene_keys(). Another kind of file (a study) has its own list. New
// keys are added in engine/scene/chapters, not here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/scene/text/units.hpp"

namespace grainreel {

enum class KeyKind {
    quantity,      // a number in SI or a string with a unit
    integer,       // a whole number
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
    names_or_all,  // ["small", ...] or true
    integer_list,  // [3, 14, ...]
    seeds,         // a whole number or a list of them
    value,         // a number, or text that may be a quantity
    value_list,    // anything, several times
};

// The largest number of characters of a text. Drawing characters takes time in every picture, and a picture
// has room for far fewer.
constexpr std::size_t kMostLetters = 1000;

// The allowed numbers, ends included unless `open`.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool open = false;      // low itself is not allowed
    bool infinite = false;  // inf is allowed
    bool small = false;     // values below the dimension's least (units.hpp) are allowed
    bool contains(double value) const;
    std::string text() const;  // "larger than 0", "from 0 to 51"; empty when anything goes
};

struct Key {
    std::string path;  // "species[].count": [] stands for any element
    KeyKind kind = KeyKind::quantity;
    Dimension dimension = Dimension::number;
    Range range;
    std::vector<std::string> choices;  // the words of a choice, or those that each name of a list may be
    std::size_t most_letters = kMostLetters;  // for a text
    std::string fallback;       // default as a scene would write it; empty when no value stands for it
    std::string fallback_note;  // default in words: "required", "one period"
    std::string about;
    // Names of other keys in the same table. When the command line sets a key, the file loses what the key
    // excludes, what excludes the key and, when its value changes, what belonged to its former value
    // (`owns`).
    std::vector<std::string> excludes, owns;
    bool decides = true;        // decides the future of a run, so a run that goes on must have the same value
    bool often_chosen = false;  // often chosen by the plan, for reasons that other keys give

    std::string example() const;  // a valid value, as a scene would write it
    Range bounds() const;         // the part of the range within the dimension's bounds
};

const std::vector<Key>& scene_keys();

// The key at a path with or without indices ("species[1].count"), or nullptr.
const Key* find_key(std::string_view path, const std::vector<Key>& keys = scene_keys());
// The names in the same table that a key or a table excludes, or that exclude it.
std::vector<std::string> rivals_of(std::string_view path, const std::vector<Key>& keys = scene_keys());
// Whether a path is a table ("drive", "species[0]", "contact.wall"), or an array of tables ("species").
bool is_table_path(std::string_view path, const std::vector<Key>& keys = scene_keys());
bool is_table_array_path(std::string_view path, const std::vector<Key>& keys = scene_keys());

// Advice for somebody who wrote an unknown key: "did you mean 'frequency'?", "it belongs in [drive]", or
// the keys that exist there.
std::string advice_for_unknown_key(std::string_view path, const std::vector<Key>& keys = scene_keys());

// "[drive]", "[[species]]", "the top level": the table that a path lies in, as a scene would write it.
std::string table_of(std::string_view path);

// The table of all keys in Markdown, as in docs/reference/scenes.md and docs/reference/studies.md.
std::string key_table_markdown(const std::vector<Key>& keys = scene_keys());

// Paths of keys as text, "species[1].count".

inline std::string join_path(std::string_view table, std::string_view name) {
    return table.empty() ? std::string(name) : std::string(table) + "." + std::string(name);
}

inline std::string parent_of(std::string_view path) {
    const auto dot = path.rfind('.');
    return dot == std::string_view::npos ? std::string() : std::string(path.substr(0, dot));
}

// The last name: "count".
inline std::string name_of(std::string_view path) {
    const auto dot = path.rfind('.');
    return std::string(dot == std::string_view::npos ? path : path.substr(dot + 1));
}

// The words that a scene uses for each value of a choice.

template <class T>
using ChoiceWords = std::vector<std::pair<std::string, T>>;

template <class T>
const std::string& word_of(T value, const ChoiceWords<T>& words) {
    std::size_t k = 0;
    while (words[k].second != value) ++k;
    return words[k].first;
}

template <class T>
std::vector<std::string> all_of(const ChoiceWords<T>& words) {
    std::vector<std::string> all;
    for (const auto& word : words) all.push_back(word.first);
    return all;
}

}  // namespace grainreel

// Functions that make the entries of the list of keys. Internal.

namespace grainreel::keys {

struct Fallback {
    std::string literal, note;
};
inline Fallback required() {
    return {"", "required"};
}
inline Fallback literal(const char* text) {
    return {text, ""};
}
inline Fallback note(const char* text) {
    return {"", text};
}

inline constexpr double most_grains = 2147483647;

inline const Range any{};
inline const Range positive{0, std::numeric_limits<double>::infinity(), true, false};
inline const Range positive_or_tiny{0, std::numeric_limits<double>::infinity(), true, false, true};
inline const Range not_negative{0, std::numeric_limits<double>::infinity(), false, false};
inline const Range not_negative_or_infinite{0, std::numeric_limits<double>::infinity(), false, true};
inline const Range share{0, 1, true, false};

inline Key entry(std::string path, KeyKind kind, Fallback fallback, const char* about) {
    Key key;
    key.path = std::move(path);
    key.kind = kind;
    key.fallback = std::move(fallback.literal);
    key.fallback_note = std::move(fallback.note);
    key.about = about;
    return key;
}

inline Key quantity(std::string path, Dimension dimension, const Range& range, Fallback fallback,
                    const char* about) {
    Key key = entry(std::move(path), KeyKind::quantity, std::move(fallback), about);
    key.dimension = dimension;
    key.range = range;
    return key;
}

inline Key integer(std::string path, double low, double high, Fallback fallback, const char* about) {
    Key key = entry(std::move(path), KeyKind::integer, std::move(fallback), about);
    key.range = {low, high, false, false};
    return key;
}

inline Key choice(std::string path, std::vector<std::string> choices, Fallback fallback, const char* about) {
    Key key = entry(std::move(path), KeyKind::choice, std::move(fallback), about);
    key.choices = std::move(choices);
    return key;
}

inline Key of_dimension(Key key, Dimension dimension, const Range& range) {
    key.dimension = dimension;
    key.range = range;
    return key;
}

inline Key of_choices(Key key, std::vector<std::string> choices) {
    key.choices = std::move(choices);
    return key;
}

inline Key of_length(Key key, std::size_t most_letters) {
    key.most_letters = most_letters;
    return key;
}

using Keys = std::vector<Key>;

}  // namespace grainreel::keys
namespace grainreel {

// A key that `resume --accept` changed at a step of a run. Earlier checkpoints have the value from before.
struct AcceptedKey {
    std::int64_t step = 0;
    std::string key, then, now;  // values as TOML; empty where the key is not there
};

// A value that takes precedence over that of a scene file, and the option that gave it.
struct Assignment {
    Assignment(std::string assignment, std::string said_by = "")
        : text(std::move(assignment)), option(std::move(said_by)) {}
    Assignment(const char* assignment) : text(assignment) {}

    std::string text;    // "drive.frequency=30 Hz"
    std::string option;  // option that the user typed, "--size"; empty for --set

    std::string key() const;    // "drive.frequency"
    std::string value() const;  // "30 Hz"
    std::string place() const;  // for messages: "--size", "--set drive.frequency"
};

// Assignments from the command line; the later of two to one key wins.
class Assignments : public std::vector<Assignment> {
  public:
    using std::vector<Assignment>::vector;
    Assignments(const std::vector<std::string>& all) : std::vector<Assignment>(all.begin(), all.end()) {}
};

}  // namespace grainreel
