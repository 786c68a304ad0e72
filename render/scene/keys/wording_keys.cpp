// The keys of [film.wording]: a scene's own words in place of the fixed ones.
#include <fmt/format.h>

#include "engine/scene/keys/bound_key.hpp"
#include "render/scene/keys/film_keys.hpp"
#include "render/scene/wording.hpp"

namespace grainreel {
namespace {

constexpr std::size_t most_letters = 200;

std::string path_of(Word word) {
    return fmt::format("film.wording.{}", name_of(word));
}

template <class Each>
void for_each_word(const Each& each) {
    for (int k = 0; k < static_cast<int>(Word::end_of_table); ++k) each(static_cast<Word>(k));
}

std::string braces(int parts) {
    std::string text;
    for (int k = 1; k <= parts; ++k) text += fmt::format("{}{{{}}}", k > 1 ? " and " : "", k);
    return text;
}

}  // namespace

void list_wording(keys::Keys& all) {
    for_each_word([&](Word word) {
        Key key = keys::entry(path_of(word), KeyKind::text, {quoted(english_of(word)), ""}, "");
        key.most_letters = most_letters;
        all.push_back(std::move(key));
    });
}

void read_wording(Document& document, FilmedScene& scene) {
    for_each_word([&](Word word) {
        const std::string path = path_of(word);
        const auto text = document.text(path);
        if (!text) return;
        const int parts = parts_in(english_of(word));
        if (parts_in(*text) != parts)
            document.fail(path, parts == 0 ? "has a brace, but nothing is put in; take it out"
                                           : fmt::format("must have {} like \"{}\", but is {}", braces(parts),
                                                         english_of(word), document.written_value(path)));
        // The table's own text changes nothing, and is not kept.
        const Wording table{scene.film.wording.language, {}};
        if (*text != table(word, {"{1}", "{2}"})) scene.film.wording.own.push_back({word, *text});
    });
}

void write_wording(SceneText& out, const FilmedScene& scene) {
    if (scene.film.wording.own.empty()) return;
    out.table("film.wording");
    for (const OwnWord& own : scene.film.wording.own) out.put(name_of(own.word), quoted(own.text));
}

}  // namespace grainreel
