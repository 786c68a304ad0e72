// Turns the columns of a file into grains in SI. The meaning of the columns is found once for a file and used
// for all its frames.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/foreign/gaps.hpp"
#include "engine/files/foreign/grain_shapes.hpp"
#include "engine/files/foreign/names.hpp"
#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/frames/state_archive.hpp"
#include "engine/scene/text/units.hpp"
#include "engine/state/contact.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

// The types of a run in the order of the species, by the words that the files have for them ("1", "big").
class TypeList {
  public:
    // Adds a word if it is new. Numbers come first, by rising value, and then words.
    void add(const std::string& word);
    // The place of a word in the list; none where it is unknown.
    std::optional<std::size_t> place(const std::string& word) const;
    const std::vector<std::string>& words() const { return words_; }

  private:
    std::vector<std::string> words_;
};

// The word for a value in a column of types: "1" for 1.0, or the column's own word.
std::string type_word(const RawColumn& column, double value);

class GrainMeaning {
  public:
    // frame: the first of the file that has rows. All frames must begin with its columns; frame() and
    // add_types() throw UserError where one does not. file: for messages. Throws
    // UserError where the file has no places, where no radius is known, and where the options do not fit.
    GrainMeaning(const RawFacts& facts, const RawFrame& frame, const ReadingOptions& options,
                 std::string file);

    bool has_ids() const { return id_.has_value(); }
    bool has_velocities() const { return velocity_[0] && velocity_[1]; }
    // Discs in a plane turn about z alone.
    bool has_spins() const { return spin_[2] && (flat_ || (spin_[0] && spin_[1])); }
    bool has_orientations() const {
        return quaternion_[0] && quaternion_[1] && quaternion_[2] && quaternion_[3];
    }
    // Whether grains are drawn as ellipsoids or superquadrics: some are, their axes are known, and the user
    // names no radius.
    bool has_shapes() const { return has_shapes_; }
    // Whether grains have masses of their own; only if the user says no density.
    bool has_masses() const { return (density_ || mass_) && !options_.density; }
    const UnitSystem& units() const { return units_; }
    // What was guessed, a line for each guess.
    const std::vector<std::string>& guesses() const { return guesses_; }

    // Adds the types of a frame to the list.
    void add_types(const RawFrame& raw, TypeList& types) const;
    // The grains of a frame by rising id, in SI. place: "run.dump: frame 3", for messages. Throws UserError
    // for a radius that is not positive, a place that is not finite, an id that comes twice or is not a whole
    // number, a type that is not in the list, and for places and radii that no bed has. A number of a
    // velocity or spin that is none, or that no bed has, becomes NaN, and so does a mass. gaps: gets what is
    // not known.
    State frame(const RawFrame& raw, const TypeList& types, const std::string& place, Gaps& gaps) const;
    // Mean density of each type in kg/m3 from columns of density or mass; NaN where it is not known.
    std::vector<double> densities(const RawFrame& raw, const TypeList& types) const;
    // The smallest id of a frame with grains.
    double least_id(const RawFrame& raw) const;
    // The box of a frame in m.
    std::optional<WorldCell> cell(const RawFrame& raw) const;

  private:
    using Column = std::optional<std::size_t>;

    // The size in SI of the unit in a column's name, as in "x [mm]". None where there is none, where it
    // measures something else, and where the user says the units of the file.
    std::optional<double> unit_in_name(Column column, Dimension dimension);
    void find_places(const RawTable& table);
    void find_radius(const RawTable& table);
    Vec3 place_of(const RawFrame& raw, std::size_t row) const;
    void tell_of_unwrapped(const RawFrame& frame);
    void tell_of_shapes();
    bool is_radius_said() const;
    void refuse_words(const RawTable& table) const;
    void add_grain(const RawFrame& raw, std::size_t row, const std::string& place, State& state,
                   Gaps& gaps) const;
    void add_shape(const RawTable& table, std::size_t row, const std::string& place, State& state) const;
    double mass_in(const RawTable& table, std::size_t row, double radius) const;
    double radius_of(const RawFrame& raw, std::size_t row, const std::string& place) const;
    std::string type_of(const RawFrame& raw, std::size_t row) const;
    void check_flat(const RawFrame& frame) const;
    void check_columns(const RawTable& table, const std::string& place) const;

    double value(const RawTable& table, Column column, std::size_t row) const {
        return table.columns[*column].values[row];
    }

    std::string file_;
    ReadingOptions options_;
    RawFacts facts_;
    UnitSystem units_;
    std::vector<std::string> names_;  // names of the columns of the first frame that has rows
    Column id_, type_, radius_, density_, mass_;
    bool is_diameter_ = false;
    double radius_unit_ = 1, place_unit_ = 1;  // m
    std::array<Column, 3> place_{}, velocity_{}, spin_{};
    std::array<double, 3> velocity_unit_{};  // m/s
    std::array<bool, 3> scaled_{};
    std::array<bool, 3> unwrapped_{};     // places that went on where a grain left a periodic box
    bool flat_ = false;                   // there is no column of z
    std::array<Column, 4> quaternion_{};  // w x y z
    ShapeColumns shapes_;
    bool has_shapes_ = false;
    std::vector<std::string> guesses_;
};

// The contacts of a frame by ids, with forces in N; wall k is -1 - k. None where the table has no pairs of
// ids. Contacts whose ids or force are no numbers are left out.
std::optional<std::vector<Link>> touches_of(const RawFrame& raw, const ReadingOptions& options,
                                            const UnitSystem& units, const std::string& file);

}  // namespace grainreel
