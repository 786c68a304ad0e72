// The table of how fast grains flow out of hoppers, beside what Beverloo's law expects.
#pragma once

#include <string>
#include <vector>

#include "render/page/facts/run_names.hpp"
#include "render/page/page_words.hpp"

namespace grainreel {

// A row for each run from which grains flow; empty where there is none. RunToName::given is the name of the
// row, which a page of one run does not show.
std::string outflow_html(const std::vector<RunToName>& runs, const PageWords& say);

}  // namespace grainreel
