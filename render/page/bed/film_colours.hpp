// The colours that the film gives to grains, as numbers for the grains of the page.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/files/frames/state_archive.hpp"
#include "engine/state/contact.hpp"
#include "render/picture/base/colour_scale.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/grains/shown_grains.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The film's colours on the page's grains: a byte for the quantity of film.colour of each grain at each
// moment.
class FilmColours {
  public:
    // For a film whose grains are coloured by a quantity (film_has_scale). start: time in s of the film's
    // first picture; a grain's start height is its height at that time. The run must outlive this object.
    FilmColours(const FilmedScene& scene, const StateArchive& run, const Clock& clock, double start);

    // Colours of the grains at a moment of the run, in the frame's order: 0 when the quantity is not known,
    // else 1 to 255 from the low end of the film's range to its high end. If the film's scale has bands, each
    // value counts as the middle of its band. touches: those of the moment, if they are known.
    std::vector<std::uint8_t> of(std::size_t index, Shot& frame,
                                 const std::optional<std::vector<Link>>& touches);

    bool wants_touches() const { return by_ == GrainValue::coordination || by_ == GrainValue::contact_force; }

  private:
    bool add_displacement(std::size_t index, Shot& frame) const;
    std::uint8_t byte_of(double value) const;

    const StateArchive& run_;
    const Clock clock_;
    const GrainValue by_;
    const double depth_, frequency_;  // period of a periodic container in m; frequency of the drive in Hz
    const ColourScale scale_;
    const std::vector<std::size_t> species_;  // those that are coloured; the others have byte 0. Empty: all
    Quantities quantities_;
};

// Whether a colour bar stands beside the film's grains.
inline bool film_has_scale(const FilmedScene& scene) {
    return scene.film.shows.colour.by != GrainValue::species;
}

}  // namespace grainreel
