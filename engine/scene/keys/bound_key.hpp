// A key bound to the member of a struct. One entry gives its name and text, how it is read and written, its
// value when the scene says nothing, and when other keys make it useless.
//
//   quantity("zoom", &Camera::zoom, Dimension::number, magnification, initial(), "Over the automatic
//   framing.")
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/keys/document.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/text/toml_text.hpp"

namespace grainreel::keys {

// The fallback that stands for the member's initial value.
inline Fallback initial() {
    return {"", ""};
}

// A value as documented: numbers without ".0".
template <class V>
std::string initial_text(const V& value) {
    return as_toml(value);
}
std::string initial_text(double value);
std::string initial_text(const Vec3& value);

// Each of these leaves the value unchanged where the key is not there.
void read_value(Document& document, const std::string& path, double& value);
void read_value(Document& document, const std::string& path, bool& value);
void read_value(Document& document, const std::string& path, int& value);
void read_value(Document& document, const std::string& path, std::int64_t& value);
void read_value(Document& document, const std::string& path, std::uint64_t& value);
void read_value(Document& document, const std::string& path, std::string& value);
void read_value(Document& document, const std::string& path, Vec3& value);
template <class V>
void read_value(Document& document, const std::string& path, std::optional<V>& value) {
    if (!document.has(path)) return;
    value.emplace();
    read_value(document, path, *value);
}

template <class T>
struct BoundKey {
    using Read = std::function<void(Document&, const Scene&, const std::string& path, T&)>;
    using Write = std::function<std::string(const T&, const Scene&)>;
    using Useless = std::function<const char*(const T&)>;
    using Usual = std::function<void(T&, const Scene&)>;

    Key key;                     // its path is the name inside a table
    Keys parts;                  // keys of a value that may be a table itself
    bool must_be_there = false;  // whether the key must be there wherever it means something
    Read read;
    Write write;                                     // value as TOML; empty: not written
    std::function<void(const T& from, T& to)> copy;  // copies this one member
    Useless useless;  // why the key means nothing, given the values of others; null if it has a meaning
    Usual usual;      // sets the member when the scene says nothing, from the values of others
    std::function<bool(const T&)> unwritten;
    int turn = 0, line = 0;  // order of reading and of writing; keys with the same number go as listed

    BoundKey needed() const {
        return changed([](BoundKey& k) { k.must_be_there = true; });
    }
    BoundKey excludes(std::vector<std::string> names) const {
        return changed([&](BoundKey& k) { k.key.excludes = std::move(names); });
    }
    BoundKey owns(std::vector<std::string> names) const {
        return changed([&](BoundKey& k) { k.key.owns = std::move(names); });
    }
    BoundKey decides_nothing() const {
        return changed([](BoundKey& k) { k.key.decides = false; });
    }
    BoundKey often_chosen() const {
        return changed([](BoundKey& k) { k.key.often_chosen = true; });
    }
    BoundKey useless_for(Useless reason) const {
        return changed([&](BoundKey& k) { k.useless = std::move(reason); });
    }
    BoundKey usually(Usual value) const {
        return changed([&](BoundKey& k) { k.usual = std::move(value); });
    }
    BoundKey unwritten_if(std::function<bool(const T&)> is) const {
        return changed([&](BoundKey& k) { k.unwritten = std::move(is); });
    }
    BoundKey never_written() const {
        return unwritten_if([](const T&) { return true; });
    }
    BoundKey read_at(int when) const {
        return changed([&](BoundKey& k) { k.turn = when; });
    }
    BoundKey written_at(int where) const {
        return changed([&](BoundKey& k) { k.line = where; });
    }
    BoundKey placed_at(int place) const { return read_at(place).written_at(place); }
    // Adds that the value may be a table with the keys of `table`.
    template <class Table>
    BoundKey holding(const Table& table) const {
        return changed([&](BoundKey& k) { table.list(k.parts, k.key.path); });
    }

  private:
    template <class Change>
    BoundKey changed(const Change& change) const {
        BoundKey copy_of_this = *this;
        change(copy_of_this);
        return copy_of_this;
    }
};

template <class T>
BoundKey<T> bound_by(Key key, typename BoundKey<T>::Read read, typename BoundKey<T>::Write write) {
    BoundKey<T> bound;
    bound.must_be_there = key.fallback_note == required().note;
    bound.key = std::move(key);
    bound.read = std::move(read);
    bound.write = std::move(write);
    return bound;
}

template <class T, class V>
BoundKey<T> bound(Key key, V T::*member) {
    if (key.fallback.empty() && key.fallback_note.empty()) key.fallback = initial_text(T{}.*member);
    const Dimension dimension = key.dimension;
    BoundKey<T> result = bound_by<T>(
        std::move(key),
        [member](Document& document, const Scene&, const std::string& path, T& into) {
            read_value(document, path, into.*member);
        },
        [member, dimension](const T& from, const Scene&) { return as_toml(from.*member, dimension); });
    result.copy = [member](const T& from, T& to) { to.*member = from.*member; };
    return result;
}

template <class T, class V>
BoundKey<T> quantity(const char* name, V T::*member, Dimension dimension, const Range& range,
                     Fallback fallback, const char* about) {
    return bound(quantity(name, dimension, range, std::move(fallback), about), member);
}

template <class T, class V>
BoundKey<T> integer(const char* name, V T::*member, double low, double high, Fallback fallback,
                    const char* about) {
    return bound(integer(name, low, high, std::move(fallback), about), member);
}

template <class T>
BoundKey<T> flag(const char* name, bool T::*member, Fallback fallback, const char* about) {
    return bound(entry(name, KeyKind::flag, std::move(fallback), about), member);
}

template <class T>
BoundKey<T> text(const char* name, std::string T::*member, Fallback fallback, const char* about) {
    return bound(entry(name, KeyKind::text, std::move(fallback), about), member);
}

// A key for a Vec3, or for one that may be missing.
template <class T, class V>
BoundKey<T> vector(const char* name, V T::*member, Dimension dimension, Fallback fallback,
                   const char* about) {
    return bound(of_dimension(entry(name, KeyKind::vector, std::move(fallback), about), dimension, any),
                 member);
}

template <class T, class V>
BoundKey<T> choice(const char* name, V T::*member, const ChoiceWords<V>& words, Fallback fallback,
                   const char* about) {
    if (fallback.literal.empty() && fallback.note.empty())
        fallback.literal = quoted(word_of(T{}.*member, words));
    BoundKey<T> result = bound_by<T>(
        choice(name, all_of(words), std::move(fallback), about),
        [member, words](Document& document, const Scene&, const std::string& path, T& into) {
            const auto word = document.text(path);
            for (const auto& [said, value] : words)
                if (word && *word == said) into.*member = value;
        },
        [member, words](const T& from, const Scene&) { return quoted(word_of(from.*member, words)); });
    result.copy = [member](const T& from, T& to) { to.*member = from.*member; };
    return result;
}

// The keys of one table, bound to one struct.
template <class T>
class KeyTable {
  public:
    KeyTable(std::initializer_list<BoundKey<T>> keys) : listed_(keys), read_(listed_), written_(listed_) {
        std::stable_sort(read_.begin(), read_.end(),
                         [](const auto& a, const auto& b) { return a.turn < b.turn; });
        std::stable_sort(written_.begin(), written_.end(),
                         [](const auto& a, const auto& b) { return a.line < b.line; });
    }

    // Adds its keys to the list of all keys. `inherited` is a text that replaces each key's default.
    void list(Keys& all, const std::string& table, const char* inherited = nullptr) const {
        const auto add = [&](Key key) {
            key.path = join_path(table, key.path);
            if (inherited != nullptr) key.fallback.clear(), key.fallback_note = inherited;
            all.push_back(std::move(key));
        };
        for (const BoundKey<T>& bound : listed_) {
            add(bound.key);
            for (const Key& part : bound.parts) add(part);
        }
    }

    // Throws UserError as Document does, and where a needed key is missing.
    void read(Document& document, const Scene& scene, const std::string& table, T& into) const {
        for (const BoundKey<T>& bound : read_) {
            const std::string path = join_path(table, bound.key.path);
            if (const char* reason = bound.useless ? bound.useless(into) : nullptr) {
                document.refuse(path, reason);
                continue;
            }
            const bool there = document.has(path);
            if (!there && bound.must_be_there) document.fail_missing(path);
            if (!there && bound.usual) bound.usual(into, scene);
            bound.read(document, scene, path, into);
        }
    }

    void write(SceneText& out, const Scene& scene, const T& from) const {
        for (const auto& [name, value] : values(scene, from)) out.put(name, value);
    }

    // "{ min = 0.001, max = 0.002 }"
    std::string inline_text(const Scene& scene, const T& from) const {
        std::string text;
        for (const auto& [name, value] : values(scene, from))
            text += (text.empty() ? "" : ", ") + name + " = " + value;
        return "{ " + text + " }";
    }

    // Reads a list of tables, [[name]]; each adds an element to `into`.
    void read_elements(Document& document, const Scene& scene, const std::string& name,
                       std::vector<T>& into) const {
        for (std::size_t i = 0; i < document.size(name); ++i) {
            T element;
            read(document, scene, name + "[" + std::to_string(i) + "]", element);
            into.push_back(std::move(element));
        }
    }

    void write_elements(SceneText& out, const Scene& scene, const std::string& name,
                        const std::vector<T>& from) const {
        for (const T& element : from) {
            out.element(name);
            write(out, scene, element);
        }
    }

    const std::vector<BoundKey<T>>& in_order_of_reading() const { return read_; }

  private:
    // Names and values of the keys that are written, in order.
    std::vector<std::pair<std::string, std::string>> values(const Scene& scene, const T& from) const {
        std::vector<std::pair<std::string, std::string>> all;
        for (const BoundKey<T>& bound : written_) {
            const bool useless = bound.useless && bound.useless(from) != nullptr;
            if (!useless && !(bound.unwritten && bound.unwritten(from)))
                all.emplace_back(bound.key.path, bound.write(from, scene));
        }
        return all;
    }

    std::vector<BoundKey<T>> listed_, read_, written_;
};

}  // namespace grainreel::keys
