// The reader's chapters. Internal.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/scene/text/document.hpp"

namespace grainreel {

void read_species(Document& document, Scene& scene);
void read_contact(Document& document, Scene& scene);  // after the species
void read_container(Document& document, Scene& scene);
void read_exact(Document& document, Scene& scene);  // after the species
void size_empty_space(Scene& scene);                // when all else is read
void read_drive(Document& document, Scene& scene);  // after gravity
void read_start(Document& document, Scene& scene);
void read_run(Document& document, Scene& scene);   // with [output]; after the contacts
void read_film(Document& document, Scene& scene);  // after drive and run

// What can be wrong between keys that are right by themselves. Throws UserError.
void check_scene(const Scene& scene);

// The value that a choice stands for.
template <class T>
T chosen(Document& document, const std::string& path, const std::vector<std::pair<std::string, T>>& meanings,
         T fallback) {
    const auto word = document.text(path);
    for (const auto& meaning : meanings)
        if (word && meaning.first == *word) return meaning.second;
    return fallback;
}

}  // namespace grainreel
