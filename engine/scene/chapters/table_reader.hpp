// Whoever reads tables of a scene file that the engine only keeps as text, such as [film]. It reads them from
// the same document, so that a mistake is told with its line, and the first one first.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/scene/keys/document.hpp"

namespace grainreel {

class TableReader {
  public:
    virtual ~TableReader() = default;

    // All keys that the file may have, the engine's among them.
    virtual const std::vector<Key>& keys() const = 0;
    // What one species has for it. The engine has read that species.
    virtual void read_species(Document& document, std::size_t species) = 0;
    // Its tables. The engine has read all of its own.
    virtual void read_tables(Document& document) = 0;
    // What can be wrong between keys that are right by themselves. Throws UserError.
    virtual void check() const = 0;
};

}  // namespace grainreel
