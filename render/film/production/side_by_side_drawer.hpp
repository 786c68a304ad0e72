// A film's drawer whose pictures show several scenes beside each other.
#pragma once

#include <vector>

#include "render/film/production/film_maker.hpp"
#include "render/picture/panels/side_by_side.hpp"

namespace grainreel {

// film: size, title and background of the whole. clock: the panel whose time is shown. segments: of the film,
// one a picture.
DrawerMaker side_by_side_drawer(const std::vector<Panel>& panels, const Film& film, int raster_threads,
                                gl::Provider provider, std::size_t clock, std::vector<std::size_t> segments);

}  // namespace grainreel
