// The fixed words of pages in four languages: headings, buttons, and what scripts say. A page has the
// language of its film (film.lang). Words that films have too are the film's, so those of [film.wording] hold
// here as well.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/scene/wording.hpp"

namespace grainreel {

// A sentence with its parts, which may be such texts themselves. The terminal tells it in English, and a page
// in its own language.
struct PageNote {
    PageNote() = default;
    PageNote(std::string text, std::vector<PageNote> its_parts = {})
        : english(std::move(text)), parts(std::move(its_parts)) {}
    bool empty() const { return english.empty(); }
    std::string in_english() const;

    std::string english;          // a text of the table, or one that is the same in all languages
    std::vector<PageNote> parts;  // in place of {1}, {2} ...
};

class PageWords {
  public:
    explicit PageWords(Wording film) : film_(std::move(film)) {}

    // The words for an English text, with `parts` in place of {1}, {2} ... A text that neither table has
    // stays English.
    std::string operator()(std::string_view english,
                           std::initializer_list<std::string_view> parts = {}) const;
    std::string operator()(const PageNote& note) const;
    // A template of the page in this language: each [[text]] in it is replaced by its words.
    std::string in(std::string_view html) const;
    // The page's facts, a JSON object, and the words that differ from English, by their English text. Scripts
    // take theirs from it.
    std::string with_words(std::string facts) const;

    const char* code() const;  // "de", the name of the language in HTML
    // An attribute for elements whose text is English on every page; empty on English pages.
    const char* on_english() const { return film_.language == Language::en ? "" : " lang=\"en\""; }
    // An attribute for elements inside those that are in the page's language.
    std::string on_own() const;

  private:
    std::string pattern(std::string_view english) const;
    const Wording film_;
};

}  // namespace grainreel
