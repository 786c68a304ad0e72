#include "render/app/options/paper_options.hpp"

#include <string>

#include <fmt/format.h>
#include <CLI/Validators.hpp>

#include "engine/base/error.hpp"
#include "render/app/options/number_range.hpp"
#include "render/app/options/option_groups.hpp"

namespace grainreel {

CLI::Option* add_paper(CLI::App& verb, PaperOptions& options, const char* about) {
    const auto take = [&options](const std::string& folder) {
        check_typed("--charts", folder);
        options.folder = folder;
    };
    CLI::Option* charts =
        verb.add_option_function<std::string>("--charts", take, about)->type_name("DIR")->check(not_empty());
    verb.add_option("--as", options.paper.forms, "With --charts: pdf, svg, png, or several with commas [pdf]")
        ->delimiter(',')
        ->check(CLI::IsMember({"pdf", "svg", "png"}))
        ->needs(charts)
        ->type_name("FORM");
    verb.add_option("--width-mm", options.paper.width_mm,
                    "With --charts: width on paper; letters have 8 points at any width [85]")
        ->check(number_within(40, 1000))
        ->needs(charts)
        ->type_name("MM");
    verb.add_option("--dpi", options.paper.dpi, "With --charts: pixels an inch of png [300]")
        ->check(number_within(50, 2400))
        ->needs(charts)
        ->type_name("N");
    return charts;
}

void check_paper(const PaperOptions& options) {
    std::error_code ignored;
    if (options.folder && std::filesystem::exists(*options.folder, ignored) &&
        !std::filesystem::is_directory(*options.folder, ignored))
        throw UserError(fmt::format("--charts {}: is a file; name a folder", options.folder->string()));
    constexpr double inch = 25.4, most_pixels = 20000;
    if (options.paper.width_mm / inch * options.paper.dpi > most_pixels)
        throw UserError(fmt::format(
            "--dpi {}: a chart {} mm wide would have more than {} pixels across; lower one of them",
            options.paper.dpi, options.paper.width_mm, most_pixels));
}

}  // namespace grainreel
