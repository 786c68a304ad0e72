// The files of render/page/html, which the build puts into the program.
#pragma once

#include <string>
#include <string_view>

#include <fmt/format.h>

namespace grainreel {

// Page, parts and style are as they lie there. The scripts are joined by the build (embed_page.cmake), uPlot
// first.
struct PageFiles {
    std::string_view page, body, variant, bed, charts, fields, live, style;
    std::string_view script_before, mesh_script, script_after;

    // One script; only a page of a scene with meshes needs the part that draws them.
    std::string script(bool meshes) const {
        return fmt::format("{}{}{}", script_before, meshes ? mesh_script : "", script_after);
    }
};
const PageFiles& page_files();

}  // namespace grainreel
