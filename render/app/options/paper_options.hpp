// Charts for print: --charts, --as, --width-mm and --dpi.
#pragma once

#include <filesystem>
#include <optional>

#include <CLI/App.hpp>

#include "render/app/print/paper.hpp"

namespace grainreel {

struct PaperOptions {
    std::optional<std::filesystem::path> folder;  // none: no charts are wanted
    Paper paper;
};

// Gives --charts, which the other options need. about: of --charts.
CLI::Option* add_paper(CLI::App& verb, PaperOptions& options, const char* about);

// Throws UserError where the folder of charts is a file, and where there would be too many pixels.
void check_paper(const PaperOptions& options);

}  // namespace grainreel
