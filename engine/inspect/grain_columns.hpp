// What can be asked of a grain: the names that expressions, histograms and tables use.
#pragma once

#include <string>
#include <vector>

#include "engine/inspect/expression.hpp"
#include "engine/inspect/snapshot.hpp"
#include "engine/scene/text/units.hpp"

namespace grainreel {

struct GrainColumn {
    std::string name;
    Dimension dimension;
    std::string about;
    bool is_species = false;
    bool needs_contacts = false;
    double (*of)(const Snapshot& snapshot,
                 std::size_t grain);  // SI; NaN when it is not known; null for sums of contacts
};

// All of them, those of contacts too.
const std::vector<GrainColumn>& grain_columns();

// Column by number, of all grains of the frame.
std::vector<double> values_of(const Snapshot& snapshot, int column);

// The columns, and the names of the scene's species.
class GrainVocabulary final : public Vocabulary {
  public:
    explicit GrainVocabulary(const Snapshot& snapshot) : snapshot_(snapshot) {}
    // Throws UserError for a column that needs contacts when the snapshot has none.
    std::optional<Word> find(std::string_view name) const override;
    std::vector<std::string> names() const override;

  private:
    const Snapshot& snapshot_;
};

// The grains for which a condition holds, as places in the frame. Throws UserError when `text` is no
// condition.
std::vector<std::size_t> grains_where(const Snapshot& snapshot, std::string_view text);

}  // namespace grainreel
