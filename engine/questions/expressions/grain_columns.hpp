// What can be asked of a grain: the names that expressions, histograms and tables use.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/numbers.hpp"
#include "engine/questions/expressions/expression.hpp"
#include "engine/questions/snapshot.hpp"
#include "engine/scene/text/units.hpp"

namespace grainreel {

// The value of a column for a grain of which it is not known.

// Places, in the frame, of the grains that are asked for.
using GrainList = std::vector<std::size_t>;

struct GrainColumn {
    std::string name;
    Dimension dimension;
    std::string about;
    // Gives one value (SI) for each grain of the list; NaN when it is not known.
    std::vector<double> (*of)(const Snapshot& snapshot, const GrainList& grains);
    Needs needs = Needs::nothing;
    bool is_species = false;
    bool costly = false;        // looks for neighbours, or for the surface of the bed
    std::string coloured_as{};  // word of film.colour.by that shows the same; empty for none
    std::string also{};         // a second name, under which film.colour.by knows it
};

// All columns.
const std::vector<GrainColumn>& grain_columns();
// The columns of each group.
std::vector<GrainColumn> motion_columns();
std::vector<GrainColumn> bed_columns();
std::vector<GrainColumn> contact_columns();

// Gap (m) between surfaces below which grains are neighbours, as in the observer `unlike_neighbours`.
double gap_of_neighbours(const Scene& scene);

// The number of the column with this name. Throws UserError where there is none, or where the snapshot
// cannot give it.
int column_called(const Snapshot& snapshot, const std::string& name);
// Values of the column with this number: for these grains, or for all grains of the frame.
std::vector<double> values_of(const Snapshot& snapshot, int column, const GrainList& grains);
std::vector<double> values_of(const Snapshot& snapshot, int column);

// What the columns named in a text need of a snapshot, each once. The text may be an expression.
std::vector<Needs> needs_of(std::string_view text);

// The words of expressions: the columns, and the names of the scene's species.
class GrainVocabulary final : public Vocabulary {
  public:
    explicit GrainVocabulary(const Snapshot& snapshot) : snapshot_(snapshot) {}
    // Throws UserError for a column that needs what the snapshot lacks.
    std::optional<Word> find(std::string_view name) const override;
    std::vector<std::string> names() const override;
    std::optional<Word> touching(std::string_view who) const override;

  private:
    const Snapshot& snapshot_;
};

// Whether the mass of any grain is known. Files of other programs may say no density.
bool masses_known(const Snapshot& snapshot);

// The grains for which a condition holds. Throws UserError where the expression is no condition.
GrainList grains_where(const Snapshot& snapshot, const Expression& condition);

// Makes a column from a function of one grain.
template <double (*value)(const Snapshot&, std::size_t)>
std::vector<double> of_each(const Snapshot& snapshot, const GrainList& grains) {
    std::vector<double> values;
    for (const std::size_t grain : grains) values.push_back(value(snapshot, grain));
    return values;
}

// The condition touches(...): whether a grain has a contact that carries force with what is named.

// `who` is "wall" for any wall, a species, a wall or mesh as contacts name it ("left slant"), or a grain's
// id. Returns the number of a column beyond grain_columns(), whose values are 1 and 0. Throws UserError where
// the scene has nothing of this name, and where the snapshot's contacts are not known.
int touches_column(const Snapshot& snapshot, std::string_view who);

bool is_touches_column(int number);
// One value for each grain of the list.
std::vector<double> values_of_touches(const Snapshot& snapshot, int number, const GrainList& grains);

}  // namespace grainreel
