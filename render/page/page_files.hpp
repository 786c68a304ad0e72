// The files of render/page/html, which the build puts into the program.
#pragma once

#include <string_view>

namespace grainreel {

// Page, parts and style are as they lie there; script: all scripts joined, uPlot first. The build makes it
// (embed_page.cmake).
struct PageFiles {
    std::string_view page, body, variant, bed, charts, fields, live, style, script;
};
const PageFiles& page_files();

}  // namespace grainreel
