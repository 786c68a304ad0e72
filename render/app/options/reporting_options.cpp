#include <map>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "render/app/options/option_groups.hpp"

namespace grainreel {
namespace {

using Form = ReporterOptions::Form;

Form progress_form(const std::string& word) {
    const std::map<std::string, Form> forms = {
        {"auto", Form::automatic}, {"json", Form::json}, {"none", Form::none}};
    const auto found = forms.find(word);
    if (found == forms.end()) {
        throw UserError(fmt::format("--progress {}: no such form; choose auto, json or none", excerpt(word)));
    }
    return found->second;
}

}  // namespace

void add_reporting(CLI::App& verb, ReporterOptions& report) {
    verb.add_option_function<std::string>(
            "--progress", [&report](const std::string& word) { report.form = progress_form(word); },
            "auto (a line that redraws on a terminal and comes now and then in a pipe), json (an object a "
            "line) or "
            "none [auto]")
        ->type_name("FORM");
    verb.add_flag("--quiet", report.quiet, "Say nothing on stderr but errors");
    verb.add_flag("--verbose", report.verbose, "Say more on stderr");
}

}  // namespace grainreel
