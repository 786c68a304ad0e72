// Lays the grains over what is behind them and under what is before them.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/team.hpp"
#include "render/draw/picture.hpp"
#include "render/draw/view.hpp"
#include "render/spheres/layer.hpp"

namespace grainreel {

// behind, before: as OpenGL gives them, rows from the bottom; all of the port's size; colours multiplied by
// alpha. The result goes into the port's part of the picture.
void compose(const std::vector<std::uint32_t>& behind, const Layer& grains,
             const std::vector<std::uint32_t>& before, const Rectangle& port, Picture& picture, Team& team);

// From colours multiplied by their alpha, as layers have them, to plain ones, as pictures have them.
void divide_by_alpha(Picture& picture, const Rectangle& port);

}  // namespace grainreel
