// What the list of keys is put together from. Internal.
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/keys/keys.hpp"

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
