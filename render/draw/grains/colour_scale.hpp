// From a quantity's value to a colour, and the words and ticks that the colour bar needs.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/film/film_shows.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class ColourScale {
  public:
    explicit ColourScale(const GrainColouring& colouring);

    // sRGB; value: SI. Held at the ends beyond the range.
    Colour at(double value) const;
    // The same by where in the range it is, 0 to 1.
    Colour at_share(double share) const;

    // How many bands of one colour each; 0: colours change smoothly.
    int bands() const { return bands_; }
    double low() const { return colouring_.range[0]; }  // SI
    double high() const { return colouring_.range[1]; }
    double unit_size() const { return unit_size_; }  // SI in one of the unit shown
    std::string title() const;                       // "speed (m/s)"

  private:
    GrainColouring colouring_;
    int bands_;
    double unit_size_;
};

}  // namespace grainreel
