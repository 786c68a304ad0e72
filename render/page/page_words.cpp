#include "render/page/page_words.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/base/error.hpp"
#include "render/page/embed.hpp"
#include "render/page/page_words_table.hpp"

namespace grainreel {

namespace {

const PageRow* row_of(std::string_view english) {
    const auto row = std::find_if(page_rows.begin(), page_rows.end(),
                                  [&](const PageRow& one) { return english == one.english; });
    return row == page_rows.end() ? nullptr : &*row;
}

// The film's word with that English text, as a pattern with {1} ...
std::string word_of_film(const Wording& film, std::string_view english) {
    for (int k = 0; k < static_cast<int>(Word::end_of_table); ++k)
        if (english == english_of(static_cast<Word>(k)))
            return film(static_cast<Word>(k), {"{1}", "{2}", "{3}"});
    return "";
}

// The words with parts in place of {1}, {2} ...
std::string filled_in(const std::string& words, const std::vector<std::string>& parts) {
    std::string text;
    for (std::size_t k = 0; k < words.size(); ++k) {
        const bool part = words[k] == '{' && k + 2 < words.size() && words[k + 2] == '}';
        const auto number = part ? static_cast<std::size_t>(words[k + 1] - '1') : parts.size();
        if (number >= parts.size()) {
            text += words[k];
            continue;
        }
        text += parts[number];
        k += 2;
    }
    return text;
}

}  // namespace

std::string PageWords::pattern(std::string_view english) const {
    if (const std::string word = word_of_film(film_, english); !word.empty()) return word;
    const PageRow* row = film_.language == Language::en ? nullptr : row_of(english);
    return row ? row->others[static_cast<std::size_t>(film_.language) - 1] : std::string(english);
}

std::string PageWords::operator()(std::string_view english,
                                  std::initializer_list<std::string_view> parts) const {
    return filled_in(pattern(english), {parts.begin(), parts.end()});
}

std::string PageWords::operator()(const PageNote& note) const {
    std::vector<std::string> parts;
    for (const PageNote& part : note.parts) parts.push_back((*this)(part));
    return filled_in(pattern(note.english), parts);
}

std::string PageNote::in_english() const {
    return PageWords({})(*this);
}

std::string PageWords::in(std::string_view html) const {
    std::string result;
    for (std::size_t open = html.find("[["); open != std::string_view::npos; open = html.find("[[")) {
        const std::size_t close = html.find("]]", open);
        GRAINREEL_CHECK(close != std::string_view::npos);
        result += html.substr(0, open);
        result += html_text((*this)(html.substr(open + 2, close - open - 2)));
        html.remove_prefix(close + 2);
    }
    return result += html;
}

std::string PageWords::with_words(std::string facts) const {
    nlohmann::json words = nlohmann::json::object();
    const auto take = [&](const char* english) {
        if (std::string text = pattern(english); text != english) words[english] = std::move(text);
    };
    for (const PageRow& row : page_rows) take(row.english);
    for (int k = 0; k < static_cast<int>(Word::end_of_table); ++k) take(english_of(static_cast<Word>(k)));
    if (words.empty()) return facts;
    const std::string text = words.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return facts.insert(1, fmt::format("\"words\":{},", text));
}

std::string PageWords::on_own() const {
    return film_.language == Language::en ? "" : fmt::format(" lang=\"{}\"", code());
}

const char* PageWords::code() const {
    for (const auto& [word, language] : language_words())
        if (language == film_.language) return word.c_str();
    return "en";
}

}  // namespace grainreel
