#include "render/scene/keys/word_kinds.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"

namespace grainreel {
namespace {

struct WordKind {
    const char* name;
    bool WordKinds::*member;
};
constexpr WordKind word_kinds[] = {
    {"title", &WordKinds::title},       {"legend", &WordKinds::legend},    {"time", &WordKinds::time},
    {"cycle", &WordKinds::cycle},       {"dial", &WordKinds::dial},        {"drive", &WordKinds::drive},
    {"playback", &WordKinds::playback}, {"scale", &WordKinds::scale},      {"arrows", &WordKinds::arrows},
    {"counts", &WordKinds::counts},     {"captions", &WordKinds::captions}};

std::vector<std::string> word_kind_names() {
    std::vector<std::string> names;
    for (const WordKind& kind : word_kinds) names.emplace_back(kind.name);
    return names;
}

void read_word_kinds(Document& document, const Scene&, const std::string& path, Film& film) {
    film.word_kinds = {};
    if (!document.has(path)) return;
    for (const WordKind& kind : word_kinds) film.word_kinds.*kind.member = false;
    const std::vector<std::string> names = document.name_list(path);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto* const kind = std::find_if(std::begin(word_kinds), std::end(word_kinds),
                                              [&](const WordKind& known) { return known.name == names[i]; });
        if (kind == std::end(word_kinds))
            throw UserError(fmt::format("{}: 'show' has \"{}\", which is none of the words: {}",
                                        document.place(fmt::format("{}[{}]", path, i)), excerpt(names[i]),
                                        fmt::join(word_kind_names(), ", ")));
        film.word_kinds.*kind->member = true;
    }
}

std::string word_kinds_text(const Film& film, const Scene&) {
    std::vector<std::string> names;
    for (const WordKind& kind : word_kinds)
        if (film.word_kinds.*kind.member) names.push_back(quoted(kind.name));
    return toml_list(names);
}

}  // namespace

keys::BoundKey<Film> word_kinds_key() {
    using namespace keys;
    return bound_by<Film>(
               of_choices(entry("show", KeyKind::name_list, note("all of them"),
                                "Words and signs that the film has; [] for none. `words` says where."),
                          word_kind_names()),
               read_word_kinds, word_kinds_text)
        .unwritten_if([](const Film& film) { return film.word_kinds == WordKinds(); });
}

}  // namespace grainreel
