// The film's colours on the page's grains: the quantity of film.colour, a byte a grain and moment.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/files/frames/frame_archive.hpp"
#include "render/film/sources/frame_source.hpp"
#include "render/picture/base/colour_scale.hpp"
#include "render/picture/grains/grain_colours.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class FilmColours {
  public:
    // start: s, of the film's first picture, from which start heights count. The run outlives it. For a film
    // whose grains are coloured by a quantity (film_has_scale).
    FilmColours(const FilmedScene& scene, const FrameArchive& run, const Clock& clock, double start);

    // Colours of the grains of a moment of the run, in the frame's order: 0 where the quantity is not known,
    // else 1 to 255 from the low end of the film's range to its high end, of bands their middle. touches: of
    // that moment, where they are known.
    std::vector<std::uint8_t> of(std::size_t index, Frame& frame,
                                 const std::optional<std::vector<Touch>>& touches);

    bool wants_touches() const { return by_ == GrainValue::coordination || by_ == GrainValue::contact_force; }

  private:
    bool add_displacement(std::size_t index, Frame& frame) const;
    std::uint8_t byte_of(double value) const;

    const FrameArchive& run_;
    const Clock clock_;
    const GrainValue by_;
    const double depth_, frequency_;  // m, of a periodic container; Hz
    const ColourScale scale_;
    Quantities quantities_;
};

// Whether a colour bar stands beside the film's grains.
inline bool film_has_scale(const FilmedScene& scene) {
    return scene.film.shows.colour.by != GrainValue::species;
}

}  // namespace grainreel
